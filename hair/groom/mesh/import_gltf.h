#pragma once

#include <filesystem>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/named_files.h"

namespace hair::groom {

// Reads glTF 2.0, .glb or .gltf, with the node transforms of the default scene applied. Reads
// triangle lists, strips and fans with POSITION, NORMAL, TEXCOORD_0 and indices. Reads materials'
// base colour, metallic, roughness, normal map, alpha mode and double sided. Parts are the nodes,
// with their own names or else those of their meshes. Vertex groups are the application's own
// attributes of float scalars from 0 to 1, `_SCALP` as "scalp". Other primitives are skipped, and
// meshes of hidden nodes (KHR_node_visibility) are counted in a warning; animation.h reads skins
// and animations. Refuses sparse accessors and required extensions that change the geometry.
Mesh importGltf(
    const std::filesystem::path& path, Textures textures, const NamedFileCheck& check = {});

}  // namespace hair::groom
