#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"

namespace hair::groom {

// The triangles between the roots of guides that come without them (thesis 2.3.2): Delaunay on the
// surface that the roots lie on, outer side counter-clockwise, without those that are much longer
// than their neighbours, so that a face or a parting stays free. `mesh`: what the roots lie on, or
// null. One guide gives the triangle {0, 0, 0} and two {0, 1, 1}: all strands between them.
std::vector<std::array<std::uint32_t, 3>> triangulateRoots(const Groom& guides, const Mesh* mesh);

// The mesh's unit normals at the points of its surface that are nearest to the roots.
std::vector<glm::vec3> rootNormals(const Groom& guides, const Mesh& mesh);

}  // namespace hair::groom
