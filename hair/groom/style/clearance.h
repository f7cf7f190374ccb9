#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
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

// Leads strands round the mesh. From the root on, a segment that would end nearer to its surface
// than `clearance`, or inside, is turned along the surface, in its own direction and that of the
// segment above, and the rest of the strand moves with it. Near the root, at the arc length s, 0.3
// s is enough. Segments keep their lengths, and strands that are clear of the mesh keep every bit.
// For an open mesh, inside means behind the nearest triangle.
Groom keepClear(Groom groom, const Mesh& mesh, double clearance);

// Does the same for the points of one strand, root first, and returns whether they moved. `surface`
// is the mesh's.
bool keepClear(
    std::vector<glm::dvec3>& points, const Mesh& mesh, const NearestSurface& surface,
    double clearance);

// Returns the unit vector away from the part of a mesh's surface next to a point. It points
// outward on either side of the surface.
glm::dvec3 outwardOf(const Mesh& mesh, const NearestSurface& surface, const glm::dvec3& point);

}  // namespace hair::groom
