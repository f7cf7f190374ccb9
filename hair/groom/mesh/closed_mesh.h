#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"

namespace hair {

// Directions that tell outside from inside at a triangle's features: with p a point and c the point
// of the surface nearest to it, p is inside where (p - c) . n < 0 for the n of the feature that c
// lies on. Baerentzen and Aanaes 2005, Signed distance computation using the angle weighted
// pseudonormal.
struct Pseudonormals {
    glm::dvec3 face;  // unit length
    std::array<glm::dvec3, 3> edges;  // sum of the two faces' normals; from corner i to the next
    std::array<glm::dvec3, 3> corners;  // sum of the faces' normals times their angles, rad
};

// A surface that bounds a volume: every edge belongs to two triangles that run along it in opposite
// directions. It may have several parts, one in another (a cavity) or apart; that they don't cut
// each other is not checked. No triangle is without area.
struct ClosedMesh {
    std::vector<glm::vec3> positions;  // [vertex], m, each position once
    std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
    std::vector<Pseudonormals> normals;  // [triangle]
};

// Joins vertices with equal positions, and leaves out triangles that have no area. Throws
// engine::Error that says what is wrong and where for a mesh that is not closed, and for one whose
// inside is out.
ClosedMesh closeMesh(const Mesh& mesh);

}  // namespace hair
