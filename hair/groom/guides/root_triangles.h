#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"

namespace hair::groom {

// Returns the triangles between the roots of guides that come without them (thesis 2.3.2). They
// are Delaunay on the surface that the roots lie on, counter-clockwise seen from the outer side.
// Triangles that are much longer than their neighbours are left out, so that a face or a parting
// stays free. The roots lie on `mesh`, which may be null. One guide gives the triangle {0, 0, 0}
// and two {0, 1, 1}: all strands between them.
std::vector<std::array<std::uint32_t, 3>> triangulateRoots(const Groom& guides, const Mesh* mesh);

// Returns the mesh's unit normals at the points of its surface that are nearest to the roots.
std::vector<glm::vec3> rootNormals(const Groom& guides, const Mesh& mesh);

}  // namespace hair::groom
