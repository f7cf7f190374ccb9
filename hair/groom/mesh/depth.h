#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom/mesh/winding_number.h"

namespace hair::groom {

// The depth of points inside a body. For a closed surface, the nearest triangle's pseudonormal
// tells inside from outside. For an open one, a point within the mesh's bounding box is inside
// where the winding number is 1/2 or more. The depth is the distance from the mesh's own triangles,
// except those with the inside on both sides. No cap closes an opening here, so a point near an
// opening counts as deeper than it is for the simulation.
//
// Most of a groom is well outside. For a closed body, a grid remembers its cells that contain no
// part of the mesh and are outside; they answer for all points in them. Not for several threads at
// once; each needs a copy.
class DepthInside {
public:
    explicit DepthInside(BodyMesh mesh);

    // The depth of a point, m; 0 outside.
    double operator()(const glm::dvec3& point);

    // The point of the mesh that is nearest to a point.
    MeshPoint nearest(const glm::dvec3& point) const { return surface_(point); }

private:
    enum class Answer : std::uint8_t { unknown, outside, neither };

    double signedDistance(const glm::dvec3& point) const;
    bool isOutside(const glm::ivec3& cell);

    BodyMesh mesh_;
    NearestSurface surface_;
    std::optional<WindingNumber> winding_;  // of an open mesh
    glm::dvec3 low_;
    glm::dvec3 high_;
    glm::dvec3 cell_;
    std::vector<Answer> outside_;  // [z][y][x]
};

}  // namespace hair::groom
