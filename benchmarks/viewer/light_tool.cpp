#include "benchmarks/viewer/light_tool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui.h>

namespace benchmarks::viewer {
namespace {

constexpr float kHandleDistance = 0.8f;  // in radii of the groom
constexpr float kRingRadius = 0.95f;
constexpr float kArrow = 0.35f;  // length of an arrow towards the middle, in radii
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
        const auto tip = view.pixel(at - kArrow * groom.radius * lightDirection(lights[i], groom));
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
