#include "benchmarks/viewer/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

#include "hair/rendering/lights.h"

namespace benchmarks::viewer {
namespace {

// Returns the distance along the ray, m, by Möller and Trumbore 1997, Fast, minimum storage
// ray/triangle intersection.
std::optional<double>
hitTriangle(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 p = glm::cross(ray.direction, c - a);
    const double determinant = glm::dot(b - a, p);
    if (determinant == 0.0) return {};
    const glm::dvec3 s = ray.from - a;
    const glm::dvec3 q = glm::cross(s, b - a);
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(ray.direction, q) / determinant;
    const double distance = glm::dot(c - a, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= 0.0) return {};
    return distance;
}

// Returns the smaller root of x^2 + 2 b x + c if it is positive.
std::optional<double> firstRoot(double b, double c) {
    const double square = b * b - c;
    if (square < 0.0) return {};
    const double root = -b - std::sqrt(square);
    if (root <= 0.0) return {};
    return root;
}

std::optional<double> hitSphere(const Ray& ray, const glm::dvec3& center, double radius) {
    const glm::dvec3 arm = ray.from - center;
    return firstRoot(glm::dot(arm, ray.direction), glm::dot(arm, arm) - radius * radius);
}

std::optional<double>
hitCylinder(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, double radius) {
    const double length = glm::length(b - a);
    if (length == 0.0) return {};
    const glm::dvec3 axis = (b - a) / length;
    const auto across = [&](const glm::dvec3& v) { return v - axis * glm::dot(v, axis); };
    const glm::dvec3 direction = across(ray.direction), arm = across(ray.from - a);
    const double square = glm::dot(direction, direction);
    if (square < 1e-12) return {};  // parallel to the axis: the ray meets an end first
    const auto root = firstRoot(
        glm::dot(arm, direction) / square, (glm::dot(arm, arm) - radius * radius) / square);
    if (!root) return {};
    const double along = glm::dot(ray.from + ray.direction * *root - a, axis);
    if (along < 0.0 || along > length) return {};
    return root;
}

double distanceToSegment(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 line = b - a;
    const double square = glm::dot(line, line);
    const double share =
        square > 0.0 ? std::clamp(glm::dot(point - a, line) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - a - line * share);
}

}  // namespace

// ---- The view -----------------------------------------------------------------------------------

PictureView::PictureView(
    const hair::CameraSettings& camera, const hair::RenderSettings& render, const PictureRect& rect)
    : rect_(rect),
      projection_(hair::rendering::viewProjection(
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

// ---- What is under a pixel ----------------------------------------------------------------------

Sphere sphereRound(std::span<const glm::vec3> points) {
    glm::vec3 low = points.front(), high = points.front();
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    Sphere sphere{(low + high) / 2.0f};
    for (const glm::vec3& point : points)
        sphere.radius = std::max(sphere.radius, glm::length(point - sphere.center));
    return sphere;
}

std::optional<GuideVertex> pickVertex(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach, float depth_scale) {
    std::optional<GuideVertex> best;
    float lowest = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < guides.size(); ++i) {
        const std::size_t vertex = i % vertices_per_guide;
        if (vertex == 0) continue;
        const auto shown = view.pixel(guides[i]);
        if (!shown) continue;
        const float distance = glm::length(*shown - pixel);
        if (distance > reach) continue;
        const float cost = distance / reach + view.depth(guides[i]) / depth_scale;
        if (cost >= lowest) continue;
        lowest = cost;
        best = {
            static_cast<std::uint32_t>(i / vertices_per_guide), static_cast<std::uint32_t>(vertex)};
    }
    return best;
}

std::optional<glm::vec3> pickHair(
    const PictureView& view, std::span<const glm::vec3> guides, std::uint32_t vertices_per_guide,
    glm::vec2 pixel, float reach) {
    std::optional<glm::vec3> best;
    for (std::size_t i = 0; i + 1 < guides.size(); ++i) {
        if ((i + 1) % vertices_per_guide == 0) continue;  // a tip and the next root
        const auto a = view.pixel(guides[i]);
        const auto b = view.pixel(guides[i + 1]);
        if (!a || !b) continue;
        const glm::vec2 line = *b - *a;
        const float square = glm::dot(line, line);
        const float share =
            square > 0.0f ? std::clamp(glm::dot(pixel - *a, line) / square, 0.0f, 1.0f) : 0.0f;
        if (glm::length(pixel - *a - line * share) > reach) continue;
        // Perspective: equal steps along a line are shorter in the picture the farther away they
        // are.
        const float near = view.depth(guides[i]), far = view.depth(guides[i + 1]);
        const float along = share * near / (share * near + (1.0f - share) * far);
        const glm::vec3 point = glm::mix(guides[i], guides[i + 1], along);
        if (!best || view.depth(point) < view.depth(*best)) best = point;
    }
    return best;
}

std::optional<double> pickMesh(
    const Ray& ray, const hair::groom::Mesh& mesh, const hair::simulation::RigidMotion& moved) {
    const glm::dquat back = glm::conjugate(moved.rotation);
    const Ray local{back * (ray.from - moved.translation), back * ray.direction};
    std::optional<double> nearest;
    for (const auto& [a, b, c] : mesh.triangles) {
        const auto hit =
            hitTriangle(local, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
        if (hit && (!nearest || *hit < *nearest)) nearest = hit;
    }
    return nearest;
}

std::optional<double>
pickCapsule(const Ray& ray, const glm::vec3& a, const glm::vec3& b, float radius) {
    if (distanceToSegment(ray.from, a, b) <= double{radius}) return {};
    std::optional<double> nearest;
    for (const auto& hit :
         {hitSphere(ray, a, double{radius}), hitSphere(ray, b, double{radius}),
          hitCylinder(ray, a, b, double{radius})})
        if (hit && (!nearest || *hit < *nearest)) nearest = hit;
    return nearest;
}

}  // namespace benchmarks::viewer
