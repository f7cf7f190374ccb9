#include "benchmarks/viewer/tools/camera_tool.h"

#include <algorithm>
#include <array>
#include <optional>

#include <imgui.h>

#include <glm/geometric.hpp>

#include "benchmarks/assets.h"
#include "benchmarks/viewer/tools/field_limits.h"
#include "benchmarks/viewer/tools/handles.h"
#include "benchmarks/viewer/tools/picking.h"

namespace benchmarks {

namespace {

constexpr float kPictureOfZoom = 20.0f;  // steps of zoom for a drag as long as the picture is high
constexpr float kZoomSpeed = 8.0f;  // steps per s while a key is down
constexpr float kFlySpeed = 0.8f;  // distances to the target per s
constexpr float kFaster = 4.0f;  // with shift
constexpr double kPause = 0.3;  // s within which moves are one edit
constexpr float kLongest = 0.1f;  // s that a slow frame counts: nobody wants to leap

// 1 while a key of the one sort is down, -1 while one of the other is.
float direction(std::array<ImGuiKey, 2> forward, std::array<ImGuiKey, 2> backward) {
    const auto down = [](std::array<ImGuiKey, 2> keys) {
        return ImGui::IsKeyDown(keys[0]) || ImGui::IsKeyDown(keys[1]) ? 1.0f : 0.0f;
    };
    return down(forward) - down(backward);
}

bool differs(const hair::CameraSettings& a, const hair::CameraSettings& b) {
    return a.position != b.position || a.target != b.target || a.up != b.up;
}

// Where no scene could have it, it stays.
void keepAllowed(hair::CameraSettings& camera, const hair::CameraSettings& before) {
    using S = hair::CameraSettings;
    if (allowed(&S::position, camera.position) != camera.position ||
        allowed(&S::target, camera.target) != camera.target)
        camera = before;
}

}  // namespace

std::optional<glm::vec3>
pointUnder(const PictureView& view, glm::vec2 pixel, float reach, const Player& player) {
    const hair::Settings& settings = player.settings();
    const Case& played = player.played();
    std::optional<glm::vec3> point;
    if (settings.render.hair)
        point = pickHair(view, played.guides(), played.groom().vertices_per_strand, pixel, reach);
    if (!settings.render.head) return point;
    const std::optional<hair::Mesh> mesh = loadMesh(settings, player.directory());
    if (!mesh) return point;
    const Ray ray = view.ray(pixel);
    const auto hit = pickMesh(ray, *mesh, played.head());
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

// Of two pictures it is the one under the mouse; where that is elsewhere, the first.
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
    const Pointer& pointer, Left left, bool held, hair::Settings& settings, const Player& player) {
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
        const auto point = pointUnder(pointer.view, pointer.at, Handles::reach(), player);
        if (point) focus(camera, *point);
    }
    keepAllowed(camera, before);
    edit.changed = differs(camera, before);
    return edit;
}

}  // namespace benchmarks
