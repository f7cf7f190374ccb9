#pragma once

#include <filesystem>

#include "engine/image_file.h"
#include "hair/groom/mesh/gltf_model.h"

namespace hair {

// Image `index` of a model that was loaded with GltfImages::named: a PNG or JPEG in a buffer, in
// base 64, or in a file of `folder`. Throws engine::Error "image 2 'skin': reason".
engine::Pixels
decodeGltfImage(const tinygltf::Model& model, int index, const std::filesystem::path& folder);

}  // namespace hair
