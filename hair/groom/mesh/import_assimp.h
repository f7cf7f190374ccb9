#pragma once

#include <filesystem>

#include "hair/groom/mesh/mesh.h"

namespace hair {

// Whatever assimp reads, with node transforms applied, polygons triangulated, points and lines left
// out. Parts are the nodes that hold triangles, by their names or those of their meshes: objects
// and groups in most formats. Vertex groups are the bones. Texture coordinates are the first set, 0
// for parts without. Of materials, the diffuse colour and its texture where that is a file.
Mesh importAssimp(const std::filesystem::path& path, Textures textures);

}  // namespace hair
