#include "hair/rendering/light_view.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace hair {

namespace {

constexpr float kMostHalfAngle = 75.0f;  // degrees
constexpr float kNearest = 0.01f;        // of the far end
constexpr float kLeastRadius = 0.001f;  // m: nothing to see still gives a view
// Strands turn to a directional light as to a point this many times as far as what it lights is
// wide: 0.001 rad off at most.
constexpr float kFarAway = 1000.0f;

// Length 1; downward where there is none.
glm::vec3 unit(const glm::vec3& direction) {
    const float length = glm::length(direction);
    return length > 0.0f ? direction / length : glm::vec3(0.0f, -1.0f, 0.0f);
}

glm::mat4 looking(const glm::vec3& from, const glm::vec3& axis) {
    const glm::vec3 up = std::abs(axis.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::lookAtRH(from, from + axis, up);
}

LightView
parallelView(const glm::vec3& axis, const ShadowBounds& bounds, float radius, float texels) {
    const Sphere& range = bounds.range;
    const float start = glm::dot(range.centre - bounds.seen.centre, axis) - range.radius;
    const glm::mat4 projection = glm::orthoRH_ZO(
        -radius, radius, -radius, radius, 0.0f, 2.0f * std::max(range.radius, kLeastRadius));
    return {
        .view_projection = projection * looking(bounds.seen.centre + start * axis, axis),
        .eye = bounds.seen.centre - kFarAway * radius * axis,
        .depth_terms = {-projection[2][2], projection[3][2], 0.0f, 1.0f},
        .texel_near = 2.0f * radius / texels,
        .texel_slope = 0.0f};
}

LightView perspectiveView(
    const glm::vec3& eye, const glm::vec3& axis, const Sphere& range, float slope, float texels) {
    const float middle = glm::dot(range.centre - eye, axis);
    const float far = std::max(middle + range.radius, kLeastRadius);
    const float near = std::max(middle - range.radius, kNearest * far);
    const float side = slope * near;
    const glm::mat4 projection = glm::frustumRH_ZO(-side, side, -side, side, near, far);
    return {
        .view_projection = projection * looking(eye, axis),
        .eye = eye,
        .depth_terms = {-projection[2][2], projection[3][2], 1.0f, 0.0f},
        .texel_near = 0.0f,
        .texel_slope = 2.0f * slope / texels};
}

}  // namespace

LightView lightView(
    const LightSettings& light, const ShadowBounds& bounds, std::uint32_t side, float margin) {
    const auto texels = static_cast<float>(side);
    const float widened = texels / (texels - 2.0f * margin);
    const float radius = std::max(bounds.seen.radius, kLeastRadius);
    if (light.type == LightType::directional)
        return parallelView(unit(light.direction), bounds, widened * radius, texels);
    const glm::vec3 to_centre = bounds.seen.centre - light.position;
    const float most = std::sin(glm::radians(kMostHalfAngle));
    const float sine = std::min(radius / std::max(glm::length(to_centre), radius), most);
    const float slope = sine / std::sqrt(1.0f - sine * sine);
    return perspectiveView(light.position, unit(to_centre), bounds.range, widened * slope, texels);
}

}  // namespace hair
