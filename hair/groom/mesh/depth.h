#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/mesh/body_mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom/mesh/winding_number.h"

namespace hair::groom {

// How deep points are inside a body. On which side of a closed surface a point is, the nearest
// triangle's pseudonormal says; of an open one, whether the winding number is 1/2 or more, within
// the box round the mesh. The depth is the distance from the mesh's own triangles, those with the
// inside on both sides apart: no cap closes an opening here, so that a point near one counts as
// deeper than it is for the simulation.
//
// Most of a groom is well outside: of a closed body, cells of a grid that have no part of the mesh
// in them, once found to be outside, answer for all points in them. Not for several threads at
// once; a copy for each.
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
