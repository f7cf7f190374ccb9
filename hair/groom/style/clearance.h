#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"

// Keeps strands off the mesh that they grow on.
namespace hair::groom {

// The part of a mesh's surface next to a point.
struct NearGround {
    glm::dvec3 position;
    glm::dvec3 outward;  // unit, toward the point or, from inside, away from it
    double gap;  // negative inside
};

// Returns the ground at `point`. `nearest` is the point of the mesh that is nearest to it.
NearGround groundUnder(const glm::dvec3& point, const MeshPoint& nearest, const Mesh& mesh);

}  // namespace hair::groom
