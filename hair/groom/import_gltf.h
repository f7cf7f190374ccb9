#pragma once

#include <filesystem>

#include "hair/groom/mesh.h"

namespace hair {

// glTF 2.0, .glb or .gltf, with the node transforms of the default scene applied. Reads triangle
// lists, POSITION, NORMAL, indices, material names and base colour factors; ignores images, skins
// and animation. Refuses other primitive modes, sparse accessors and required extensions that
// change the geometry.
Mesh importGltf(const std::filesystem::path& path);

}  // namespace hair
