#pragma once

#include <filesystem>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/named_files.h"

namespace hair::groom {

// glTF 2.0, .glb or .gltf, with the node transforms of the default scene applied. Reads triangle
// lists, strips and fans with POSITION, NORMAL, TEXCOORD_0 and indices, and of materials the base
// colour, metallic, roughness, normal map, alpha mode and whether they are double sided. Parts are
// the nodes, named as they or else their meshes are. Vertex groups are the application's own
// attributes of float scalars from 0 to 1, `_SCALP` as "scalp". Skips other primitives; skins and
// animations are animation.h's. Refuses sparse accessors and required extensions that change the
// geometry.
Mesh importGltf(
    const std::filesystem::path& path, Textures textures, const NamedFileCheck& check = {});

}  // namespace hair::groom
