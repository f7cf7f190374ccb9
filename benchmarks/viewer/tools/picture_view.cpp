#include "benchmarks/viewer/tools/picture_view.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "hair/rendering/camera.h"

namespace benchmarks {

PictureView::PictureView(
    const hair::CameraSettings& camera, const hair::RenderSettings& render, const PictureRect& rect)
    : rect_(rect),
      projection_(hair::viewProjection(
          camera, static_cast<float>(render.width) / static_cast<float>(render.height))),
      inverse_(glm::inverse(projection_)), eye_(camera.position),
      right_(glm::normalize(glm::cross(camera.target - camera.position, camera.up))),
      back_(glm::normalize(camera.position - camera.target)),
      pixels_at_one_(rect.size.y / (2.0f * std::tan(glm::radians(camera.field_of_view) / 2.0f))) {
    up_ = glm::cross(back_, right_);
}

std::optional<glm::vec2> PictureView::pixel(const glm::vec3& point) const {
    const glm::dvec4 clip = projection_ * glm::dvec4(point, 1.0);
    if (clip.w <= 0.0 || clip.z < 0.0) return {};
    const glm::vec2 share = (glm::dvec2(clip) / clip.w + 1.0) / 2.0;
    return rect_.corner + share * rect_.size;
}

Ray PictureView::ray(glm::vec2 pixel) const {
    const glm::dvec2 unit = 2.0 * glm::dvec2(rect_.share(pixel)) - 1.0;
    const glm::dvec4 point = inverse_ * glm::dvec4(unit, 0.0, 1.0);  // on the near plane
    const glm::dvec3 eye = eye_;
    return {eye, glm::normalize(glm::dvec3(point) / point.w - eye)};
}

glm::vec3 PictureView::onPlane(glm::vec2 pixel, const glm::vec3& through) const {
    const Ray line = ray(pixel);
    const glm::dvec3 normal = back_;
    return line.from + line.direction * (glm::dot(normal, glm::dvec3(through) - line.from) /
                                         glm::dot(normal, line.direction));
}

glm::vec3 PictureView::dragged(const glm::vec3& point, glm::vec2 from, glm::vec2 to) const {
    return onPlane(to, point) - onPlane(from, point);
}

float PictureView::pixelsPerMetre(const glm::vec3& at) const {
    const float distance = depth(at);
    return distance > 0.0f ? pixels_at_one_ / distance : 0.0f;
}

float PictureView::depth(const glm::vec3& point) const { return glm::dot(eye_ - point, back_); }

}  // namespace benchmarks
