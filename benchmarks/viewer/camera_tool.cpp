#include "benchmarks/viewer/camera_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"
#include "benchmarks/viewer/gizmo.h"

namespace benchmarks::viewer {
namespace {

// ---- Cameras ------------------------------------------------------------------------------------

constexpr CameraPreset kPresets[] = {
    {"Front", {0, 0.1f, 1}, 1.0f},         {"Side", {1, 0.1f, 0}, 1.0f},
    {"Back", {0, 0.1f, -1}, 1.0f},         {"Top", {0, 1, 0.25f}, 1.0f},
    {"Close-up", {0.5f, 0.25f, 1}, 0.25f}, {"Far", {0, 0.1f, 1}, 9.0f}};

// rad: smallest angle between the view and /camera/up.
constexpr float kClosest = 0.02f;

struct Frame {
    glm::vec3 right, up, back;
};

glm::vec3 upOf(const hair::CameraSettings& camera) {
    const float length = glm::length(camera.up);
    return length > 0.0f ? camera.up / length : glm::vec3{0, 1, 0};
}

// Returns some unit vector perpendicular to `up`.
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

// Returns the height that the picture shows of the plane through the target, m.
float visibleHeight(const hair::CameraSettings& camera) {
    return 2.0f * distanceOf(camera) * std::tan(glm::radians(camera.field_of_view) / 2.0f);
}

// Returns the distance from which a sphere's outline fills the picture's shorter side. A field of
// view above 90 degrees counts as 90; otherwise the camera would reach the sphere's surface.
float fittingDistance(const hair::CameraSettings& camera, float radius, float aspect) {
    const float half = std::tan(glm::radians(std::min(camera.field_of_view, 90.0f)) / 2.0f);
    return radius / std::sin(std::atan(half * std::min(aspect, 1.0f)));
}

// Clamps a distance so that the target lies well between the near and the far plane.
float allowedDistance(const hair::CameraSettings& camera, float distance) {
    return std::clamp(
        distance, 2.0f * camera.near_plane,
        std::max(2.0f * camera.near_plane, 0.5f * camera.far_plane));
}

// ---- Mouse and keys -----------------------------------------------------------------------------

constexpr float kPictureOfZoom = 20.0f;  // zoom steps for a drag over the picture's height
constexpr float kZoomSpeed = 8.0f;  // zoom steps per s while a key is down
constexpr float kFlySpeed = 0.8f;  // distances to the target per s
constexpr float kFaster = 4.0f;  // factor with Shift
constexpr double kPause = 0.3;  // s within which moves are one edit
constexpr float kLongest = 0.1f;  // s; limits a slow frame, so that the camera does not leap

// Returns 1 while a `forward` key is down, -1 while a `backward` key is, 0 for both or neither.
float direction(std::array<ImGuiKey, 2> forward, std::array<ImGuiKey, 2> backward) {
    const auto down = [](std::array<ImGuiKey, 2> keys) {
        return ImGui::IsKeyDown(keys[0]) || ImGui::IsKeyDown(keys[1]) ? 1.0f : 0.0f;
    };
    return down(forward) - down(backward);
}

bool differs(const hair::CameraSettings& a, const hair::CameraSettings& b) {
    return a.position != b.position || a.target != b.target || a.up != b.up;
}

// Undoes a move to a position that scenes do not allow.
void keepAllowed(hair::CameraSettings& camera, const hair::CameraSettings& before) {
    using S = hair::CameraSettings;
    if (allowed(&S::position, camera.position) != camera.position ||
        allowed(&S::target, camera.target) != camera.target)
        camera = before;
}

}  // namespace

// ---- Cameras ------------------------------------------------------------------------------------

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
    camera.position =
        center + back * allowedDistance(camera, fittingDistance(camera, radius, aspect));
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

// ---- Mouse and keys -----------------------------------------------------------------------------

std::optional<glm::vec3>
pointUnder(const PictureView& view, glm::vec2 pixel, float reach, const Shown& played) {
    const hair::Settings& settings = played.settings;
    std::optional<glm::vec3> point;
    if (settings.render.hair)
        point = pickHair(view, played.guides, played.vertices_per_guide, pixel, reach);
    if (!settings.render.head) return point;
    const std::optional<hair::groom::Mesh> mesh = scene::loadMesh(settings, played.directory);
    if (!mesh) return point;
    const Ray ray = view.ray(pixel);
    const auto hit = pickMesh(ray, *mesh, played.head);
    if (!hit) return point;
    const glm::vec3 skin = ray.from + ray.direction * *hit;
    if (!point || view.depth(skin) < view.depth(*point)) return skin;
    return point;
}

Edit CameraTool::mouse(const Pointer& pointer, Left left, hair::CameraSettings& camera) const {
    const ImGuiIO& io = ImGui::GetIO();
    if (pointer.moved == glm::vec2(0.0f)) return {.changed = false, .continues = true};
    const float height = pointer.view.rect().size.y;
    const bool others =
        ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    const bool is_left = pointer.holds && left == Left::camera;
    if (others || (is_left && io.KeyShift))
        pan(camera, pointer.moved, height);
    else if (is_left && io.KeyCtrl)
        zoom(camera, -pointer.moved.y / height * kPictureOfZoom);
    else if (is_left)
        orbit(camera, pointer.moved, height);
    return {.changed = true, .continues = true};
}

// Whether keys move this picture's camera: the one under the mouse, or the first one if the mouse
// is elsewhere.
bool CameraTool::takesKeys(const Pointer& pointer) {
    const int frame = ImGui::GetFrameCount();
    if (pointer.hovers) {
        hovered_in_ = frame;
        return true;
    }
    if (!ImGui::IsWindowFocused() || hovered_in_ >= frame - 1 || keyed_in_ == frame) return false;
    keyed_in_ = frame;
    return true;
}

Edit CameraTool::keys(const Pointer& pointer, hair::CameraSettings& camera) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || io.KeyCtrl || io.KeyAlt || io.KeySuper) return {};
    if (!takesKeys(pointer)) return {};
    const float seconds = std::min(io.DeltaTime, kLongest);
    const glm::vec3 way{
        direction({ImGuiKey_D, ImGuiKey_RightArrow}, {ImGuiKey_A, ImGuiKey_LeftArrow}),
        direction({ImGuiKey_E, ImGuiKey_E}, {ImGuiKey_Q, ImGuiKey_Q}),
        direction({ImGuiKey_W, ImGuiKey_UpArrow}, {ImGuiKey_S, ImGuiKey_DownArrow})};
    const float nearer = std::clamp(
        direction({ImGuiKey_Equal, ImGuiKey_KeypadAdd}, {ImGuiKey_Minus, ImGuiKey_KeypadSubtract}) +
            direction({ImGuiKey_PageUp, ImGuiKey_PageUp}, {ImGuiKey_PageDown, ImGuiKey_PageDown}),
        -1.0f, 1.0f);
    if (way == glm::vec3(0.0f) && nearer == 0.0f) return {};
    fly(camera, way * (kFlySpeed * (io.KeyShift ? kFaster : 1.0f) * seconds));
    if (nearer != 0.0f) zoom(camera, nearer * kZoomSpeed * seconds);
    return {.changed = true, .continues = true};
}

bool CameraTool::isMoving() const { return ImGui::GetTime() < moving_until_; }

Edit CameraTool::update(
    const Pointer& pointer, Left left, bool held, hair::Settings& settings, const Shown& played) {
    hair::CameraSettings& camera = settings.camera;
    const hair::CameraSettings before = camera;
    Edit edit = keys(pointer, camera);
    if (pointer.hovers && ImGui::GetIO().MouseWheel != 0.0f) {
        zoom(camera, ImGui::GetIO().MouseWheel);
        edit.continues = true;
    }
    if (edit.continues) moving_until_ = ImGui::GetTime() + kPause;
    if (held) edit |= mouse(pointer, left, camera);
    if (pointer.hovers && left == Left::camera &&
        ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        const auto point = pointUnder(pointer.view, pointer.at, Handles::reach(), played);
        if (point) focus(camera, *point);
    }
    keepAllowed(camera, before);
    edit.changed = differs(camera, before);
    return edit;
}

}  // namespace benchmarks::viewer
