#include "benchmarks/viewer/view_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

#include "benchmarks/measure/case.h"
#include "benchmarks/scene/assets.h"

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

// ---- Lights -------------------------------------------------------------------------------------

namespace {

constexpr float kHandleDistance = 0.8f;  // in radii of the groom
constexpr float kRingRadius = 0.95f;
constexpr float kLightArrow = 0.35f;  // length of an arrow towards the middle, in radii
constexpr int kRing = 1;  // the gizmo's ring about +y
constexpr float kMostStrength = 3.0f;  // at the end of the slider
constexpr float kFarthest = 10.0f;  // m, at the end of the slider

// Returns the groom at rest, moved with the head.
Sphere lightedGroom(const Shown& played) {
    Sphere groom = played.rest;
    groom.center = played.head(groom.center);
    return groom;
}

bool isDirectional(const hair::LightSettings& light) {
    return light.type == hair::LightType::directional;
}

glm::vec3 handleOf(const hair::LightSettings& light, const Sphere& groom) {
    return groom.center + kHandleDistance * groom.radius * lightDirection(light, groom);
}

Gizmo environmentRing(const Sphere& groom) {
    Gizmo ring{.origin = groom.center, .size = kRingRadius * groom.radius};
    for (int axis = 0; axis < 3; ++axis)
        ring.turn_axes[static_cast<std::size_t>(axis)] = moveAxis(axis);
    return ring;
}

std::vector<glm::vec2> ringPixels(const PictureView& view, const Gizmo& ring) {
    std::vector<glm::vec2> pixels;
    for (const glm::vec3& point : ringArc(view, ring, kRing))
        if (const auto shown = view.pixel(point)) pixels.push_back(*shown);
    return pixels;
}

bool isOnRing(const std::vector<glm::vec2>& ring, glm::vec2 at) {
    for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
        const glm::vec2 line = ring[i + 1] - ring[i];
        const float square = glm::dot(line, line);
        const float share =
            square > 0.0f ? std::clamp(glm::dot(at - ring[i], line) / square, 0.0f, 1.0f) : 0.0f;
        if (glm::length(at - ring[i] - share * line) < 0.5f * Handles::reach()) return true;
    }
    return false;
}

std::string textOf(const hair::LightSettings& light, std::size_t index) {
    std::array<char, 80> text{};
    std::snprintf(
        text.data(), text.size(), "light %zu, strength %.3g", index,
        static_cast<double>(light.strength));
    return text.data();
}

}  // namespace

// ---- Where light comes from ---------------------------------------------------------------------

glm::vec3 lightDirection(const hair::LightSettings& light, const Sphere& groom) {
    const glm::vec3 to = isDirectional(light) ? -light.direction : light.position - groom.center;
    const float length = glm::length(to);
    return length > 0.0f ? to / length : glm::vec3{0, 1, 0};
}

std::optional<float> lightDistance(const hair::LightSettings& light, const Sphere& groom) {
    if (isDirectional(light)) return std::nullopt;
    return glm::distance(light.position, groom.center);
}

void setLightDirection(
    hair::LightSettings& light, const Sphere& groom, const glm::vec3& direction) {
    const float length = glm::length(direction);
    if (length == 0.0f) return;
    const glm::vec3 unit = direction / length;
    if (const auto distance = lightDistance(light, groom))
        light.position = allowed(&hair::LightSettings::position, groom.center + *distance * unit);
    if (isDirectional(light) || light.type == hair::LightType::rectangle)
        light.direction = allowed(&hair::LightSettings::direction, -unit);
}

void setLightDistance(hair::LightSettings& light, const Sphere& groom, float distance) {
    if (isDirectional(light)) return;
    light.position = allowed(
        &hair::LightSettings::position, groom.center + distance * lightDirection(light, groom));
}

void turnEnvironment(hair::RenderSettings& render, float degrees) {
    render.environment_turn = allowed(
        &hair::RenderSettings::environment_turn,
        std::remainder(render.environment_turn + degrees, 360.0f));
}

// ---- The tool -----------------------------------------------------------------------------------

Edit LightTool::dragLight(const Pointer& pointer, hair::Settings& settings, const Sphere& groom) {
    Edit edit{.changed = false, .continues = true};
    if (selected_ < settings.shading.lights.size() && pointer.at != drag_->from) {
        const glm::vec3 to =
            drag_->handle + pointer.view.dragged(drag_->handle, drag_->from, pointer.at);
        hair::LightSettings& light = settings.shading.lights[selected_];
        const hair::LightSettings before = light;
        setLightDirection(light, groom, to - groom.center);
        edit.changed = light.position != before.position || light.direction != before.direction;
    }
    if (!pointer.holds) drag_.reset();
    return edit;
}

Edit LightTool::dragEnvironment(
    const Pointer& pointer, hair::Settings& settings, const Gizmo& ring) {
    Edit edit{.changed = false, .continues = true};
    if (pointer.at != turn_->from) {
        const float before = settings.render.environment_turn;
        settings.render.environment_turn = turn_->start;
        turnEnvironment(
            settings.render,
            glm::degrees(turned(pointer.view, ring, kRing, turn_->from, pointer.at)));
        edit.changed = settings.render.environment_turn != before;
    }
    if (!pointer.holds) turn_.reset();
    return edit;
}

Edit LightTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Shown& played) {
    std::vector<hair::LightSettings>& lights = settings.shading.lights;
    const Sphere groom = lightedGroom(played);
    const PictureView& view = pointer.view;
    if (selected_ >= lights.size()) {
        selected_ = 0;
        drag_.reset();
    }
    std::optional<std::size_t> hot;
    float nearest = Handles::reach();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto shown = view.pixel(handleOf(lights[i], groom));
        if (!shown || !pointer.hovers || glm::length(*shown - pointer.at) >= nearest) continue;
        nearest = glm::length(*shown - pointer.at);
        hot = i;
    }
    const bool has_environment = !settings.render.environment.empty();
    const Gizmo gizmo = environmentRing(groom);
    const std::vector<glm::vec2> ring =
        has_environment ? ringPixels(view, gizmo) : std::vector<glm::vec2>();
    const bool is_on_ring = pointer.hovers && !hot && isOnRing(ring, pointer.at);
    if (pointer.pressed && hot) {
        selected_ = *hot;
        drag_ = {&played, handleOf(lights[*hot], groom), pointer.at};
    } else if (pointer.pressed && is_on_ring) {
        turn_ = {&played, pointer.at, settings.render.environment_turn};
    }
    const bool drags = drag_ && drag_->played == &played;
    const bool turns = turn_ && turn_->played == &played;
    Edit edit;
    if (drags) edit = dragLight(pointer, settings, groom);
    if (turns) edit = dragEnvironment(pointer, settings, gizmo);

    if (!ring.empty()) handles.path(ring, is_on_ring || turns ? Handles::kHot : Handles::kFaint);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3 at = handleOf(lights[i], groom);
        const auto from = view.pixel(at);
        const auto tip =
            view.pixel(at - kLightArrow * groom.radius * lightDirection(lights[i], groom));
        if (!from) continue;
        const bool is_hot = (hot == i && !drags) || (drags && i == selected_);
        const Handles::Color color = is_hot           ? Handles::kHot
                                     : i == selected_ ? Handles::kPlain
                                                      : Handles::kFaint;
        if (tip) handles.arrow(*from, *tip, color);
        handles.dot(*from, color);
        if (i == selected_) handles.label(*from, textOf(lights[i], i));
    }
    if (lights.empty() && !has_environment)
        handles.hint("There is no light: add one to /shading/lights.");
    else if (hot && !drags)
        ImGui::SetTooltip("Drag: moves the light round the hair.");
    else if (is_on_ring && !turns)
        ImGui::SetTooltip("Drag: turns the environment.");
    return edit;
}

Edit LightTool::options(OptionsLine& line, hair::Settings& settings, const Shown& played) {
    Edit edit;
    const auto changed = [&] { edit |= {.changed = true, .continues = ImGui::IsItemActive()}; };
    std::vector<hair::LightSettings>& lights = settings.shading.lights;
    for (std::size_t i = 0; lights.size() > 1 && i < lights.size(); ++i)
        if (line.choice(
                ("Light " + std::to_string(i)).c_str(),
                i == selected_ ? OptionsLine::Choice::chosen : OptionsLine::Choice::open,
                "The light that the sliders change"))
            selected_ = i;
    if (selected_ < lights.size()) {
        hair::LightSettings& light = lights[selected_];
        if (lights.size() > 1) line.separator();
        float strength = light.strength;
        if (line.slider("Strength", strength, 0.0f, kMostStrength, "%.2f")) {
            light.strength = allowed(&hair::LightSettings::strength, strength);
            changed();
        }
        const Sphere groom = lightedGroom(played);
        if (const auto distance = lightDistance(light, groom)) {
            float metres = *distance;
            if (line.slider("Distance", metres, 0.1f, kFarthest, "%.2f m")) {
                setLightDistance(light, groom, metres);
                changed();
            }
        }
    }
    if (settings.render.environment.empty()) return edit;
    line.separator();
    float turn = settings.render.environment_turn;
    if (line.slider("Environment", turn, -180.0f, 180.0f, "%.0f°")) {
        settings.render.environment_turn = allowed(&hair::RenderSettings::environment_turn, turn);
        changed();
    }
    return edit;
}

}  // namespace benchmarks::viewer
