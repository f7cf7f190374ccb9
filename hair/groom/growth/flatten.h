#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/groom/growth/scalp.h"

namespace hair {

// A map from the scalp to the plane: the direction in which a point is seen from `centre`,
// projected stereographically from the direction opposite `axis`. Circles on the sphere of
// directions stay circles, so a Delaunay triangulation in the plane is one on the sphere.
// Orientation is that seen from outside. (Snyder 1987, Map projections, USGS professional paper
// 1395, section 21.)
struct Flattening {
    glm::dvec3 centre{0.0};
    glm::dvec3 axis{0.0, 0.0, 1.0};   // unit length; maps to the origin
    glm::dvec3 right{1.0, 0.0, 0.0};  // unit length, at right angles; maps to +x
    glm::dvec3 up{0.0, 1.0, 0.0};     // axis x right; maps to +y

    glm::dvec2 operator()(const glm::vec3& position) const;
};

// The axis is the scalp's mean normal. The centre lies on the line along it through the scalp's
// centroid, where the scalp is seen most squarely: at the centre of curvature of a spherical cap.
// Throws engine::Error if from no such centre the whole scalp is seen from its inner side.
Flattening flatten(const Scalp& scalp);

}  // namespace hair
