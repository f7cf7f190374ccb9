#include "benchmarks/viewer/tools/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace benchmarks {

namespace {

constexpr CameraPreset kPresets[] = {
    {"Front", {0, 0.1f, 1}, 1.0f},         {"Side", {1, 0.1f, 0}, 1.0f},
    {"Back", {0, 0.1f, -1}, 1.0f},         {"Top", {0, 1, 0.25f}, 1.0f},
    {"Close-up", {0.5f, 0.25f, 1}, 0.25f}, {"Far", {0, 0.1f, 1}, 9.0f}};

// Angle to /camera/up that is kept.
constexpr float kClosest = 0.02f;

struct Frame {
    glm::vec3 right, up, back;
};

glm::vec3 upOf(const hair::CameraSettings& camera) {
    const float length = glm::length(camera.up);
    return length > 0.0f ? camera.up / length : glm::vec3{0, 1, 0};
}

// Across `up`, of any direction.
glm::vec3 across(glm::vec3 up) {
    return glm::normalize(
        glm::cross(up, std::abs(up.z) < 0.9f ? glm::vec3{0, 0, 1} : glm::vec3{1, 0, 0}));
}

Frame frameOf(const hair::CameraSettings& camera) {
    const glm::vec3 up = upOf(camera);
    glm::vec3 back = camera.position - camera.target;
    back = glm::length(back) > 0.0f ? glm::normalize(back) : glm::cross(across(up), up);
    const glm::vec3 side = glm::cross(up, back);
    const glm::vec3 right = glm::length(side) > 1e-4f ? glm::normalize(side) : across(up);
    return {right, glm::normalize(glm::cross(back, right)), back};
}

float distanceOf(const hair::CameraSettings& camera) {
    return glm::length(camera.position - camera.target);
}

// Height of the plane through the target that the picture shows, m.
float visibleHeight(const hair::CameraSettings& camera) {
    return 2.0f * distanceOf(camera) * std::tan(glm::radians(camera.field_of_view) / 2.0f);
}

// From which a sphere's outline fills the picture's shorter side; beyond 90 degrees as at 90: the
// camera would be at its surface.
float fittingDistance(const hair::CameraSettings& camera, float radius, float aspect) {
    const float half = std::tan(glm::radians(std::min(camera.field_of_view, 90.0f)) / 2.0f);
    return radius / std::sin(std::atan(half * std::min(aspect, 1.0f)));
}

// Within what the picture shows at all.
float allowedDistance(const hair::CameraSettings& camera, float distance) {
    return std::clamp(
        distance, 2.0f * camera.near_plane,
        std::max(2.0f * camera.near_plane, 0.5f * camera.far_plane));
}

}  // namespace

std::span<const CameraPreset> cameraPresets() { return kPresets; }

void orbit(hair::CameraSettings& camera, glm::vec2 pixels, float height) {
    const glm::vec2 angles = pixels * (std::numbers::pi_v<float> / height);
    const glm::vec3 up = upOf(camera);
    const Frame frame = frameOf(camera);
    const float angle = std::acos(std::clamp(glm::dot(frame.back, up), -1.0f, 1.0f));
    const float wanted =
        std::clamp(angle - angles.y, kClosest, std::numbers::pi_v<float> - kClosest);
    const glm::vec3 arm = glm::angleAxis(wanted - angle, frame.right) * frame.back;
    camera.position = camera.target + glm::angleAxis(-angles.x, up) * arm *
                                          std::max(distanceOf(camera), 2.0f * camera.near_plane);
}

void pan(hair::CameraSettings& camera, glm::vec2 pixels, float height) {
    const Frame frame = frameOf(camera);
    const glm::vec2 metres = pixels * (visibleHeight(camera) / height);
    const glm::vec3 shift = frame.up * metres.y - frame.right * metres.x;
    camera.position += shift;
    camera.target += shift;
}

void zoom(hair::CameraSettings& camera, float steps) {
    const float wanted = allowedDistance(camera, distanceOf(camera) * std::pow(0.9f, steps));
    camera.position = camera.target + frameOf(camera).back * wanted;
}

void fly(hair::CameraSettings& camera, glm::vec3 distances) {
    const Frame frame = frameOf(camera);
    const glm::vec3 shift =
        distanceOf(camera) *
        (frame.right * distances.x + frame.up * distances.y - frame.back * distances.z);
    camera.position += shift;
    camera.target += shift;
}

void frameSphere(hair::CameraSettings& camera, glm::vec3 center, float radius, float aspect) {
    const glm::vec3 back = frameOf(camera).back;
    camera.target = center;
    camera.position = center + back * allowedDistance(camera, fittingDistance(camera, radius, aspect));
}

void look(
    hair::CameraSettings& camera, const CameraPreset& preset, glm::vec3 center, float radius,
    float aspect) {
    const float height = fittingDistance(camera, radius, aspect) - radius;
    camera.up = {0, 1, 0};
    camera.target = center;
    camera.position = center + glm::normalize(preset.direction) *
                                   allowedDistance(camera, radius + height * preset.height);
}

void focus(hair::CameraSettings& camera, glm::vec3 point) {
    const glm::vec3 arm = camera.position - point;
    const float distance = glm::length(arm);
    if (distance < 2.0f * camera.near_plane) return;
    if (glm::length(glm::cross(arm / distance, upOf(camera))) < std::sin(kClosest)) return;
    camera.target = point;
}

}  // namespace benchmarks
