#pragma once

#include <filesystem>
#include <vector>

#include "engine/image_file.h"
#include "hair/groom/mesh/gltf_model.h"
#include "hair/groom/mesh/mesh.h"

namespace hair {

struct GltfMaterials {
    std::vector<Material> materials;  // of triangles without one, then the file's
    std::vector<engine::Pixels> pictures;
};

// glTF 2.0, section 3.9: base colour, metallic, roughness, normals, alpha mode, double sided; other
// parts and extensions of materials are ignored. BLEND is read as MASK at one half. What has no
// material is matt grey. Textures, where they are wanted, have to be on TEXCOORD_0 without
// KHR_texture_transform. Throws engine::Error that names the material and the image.
GltfMaterials
readMaterials(const tinygltf::Model& model, Textures textures, const std::filesystem::path& folder);

}  // namespace hair
