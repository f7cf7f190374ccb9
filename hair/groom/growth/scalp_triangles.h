#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hair/groom/mesh/mesh.h"

namespace hair {

// The triangles of what has that name: a material, else a part, else a vertex group, which takes
// the triangles whose three corners have at least half of the full weight; of all that share the
// name. "*" takes every triangle. Throws engine::Error that lists what the mesh has if nothing has
// the name or it has no triangles.
std::vector<std::uint32_t> scalpTriangles(const Mesh& mesh, const std::string& name);

}  // namespace hair
