#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace hair {

// A unit vector perpendicular to `v`: its cross product with the axis it has least of (x before y
// before z where they tie). (0, 1, 0) for v = 0. The same choice as in
// shaders/common/quaternion.glsl.
inline glm::dvec3 perpendicular(const glm::dvec3& v) {
    const glm::dvec3 size = glm::abs(v);
    glm::dvec3 axis{0.0, 0.0, 1.0};
    if (size.x <= size.y && size.x <= size.z)
        axis = {1.0, 0.0, 0.0};
    else if (size.y <= size.z)
        axis = {0.0, 1.0, 0.0};
    const glm::dvec3 normal = glm::cross(v, axis);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3{0.0, 1.0, 0.0};
}

}  // namespace hair
