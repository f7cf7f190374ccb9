#include "benchmarks/viewer/tools/wind_tool.h"

#include <array>
#include <cstdio>

#include <imgui.h>

#include <glm/geometric.hpp>

#include "benchmarks/viewer/tools/wind_arrow.h"

namespace benchmarks {

namespace {

// The groom at rest, where the head is: its arrow does not sway with the hair.
Sphere groomOf(const Player& player) {
    Sphere groom = sphereRound(player.played().groom().points);
    groom.center = player.played().head()(groom.center);
    return groom;
}

std::string textOf(const hair::WindSettings& wind) {
    std::array<char, 64> text{};
    std::snprintf(
        text.data(), text.size(), "wind %.3g %s", static_cast<double>(windOf(wind)),
        windUnit(wind));
    return text.data();
}

bool same(const hair::WindSettings& a, const hair::WindSettings& b) {
    return a.direction == b.direction && windOf(a) == windOf(b);
}

}  // namespace

Edit WindTool::update(
    const Pointer& pointer, Handles& handles, hair::Settings& settings, const Player& player) {
    const PictureView& view = pointer.view;
    hair::WindSettings& wind = settings.simulation.wind;
    const Sphere groom = groomOf(player);
    const auto held = view.pixel(windTip(wind, groom));
    const bool hot = pointer.hovers && held && glm::length(*held - pointer.at) < Handles::reach();
    if (pointer.pressed && hot) drag_ = {&player, windTip(wind, groom), pointer.at};
    const bool drags = drag_ && drag_->player == &player;
    Edit edit;
    if (drags) {
        const hair::WindSettings before = wind;
        const glm::vec3 by = view.dragged(drag_->tip, drag_->from, pointer.at);
        if (pointer.at != drag_->from) setWindTip(wind, groom, drag_->tip + by);
        edit = {.changed = !same(before, wind), .continues = true};
        if (!pointer.holds) drag_.reset();
    }
    const auto from = view.pixel(groom.center);
    const auto tip = view.pixel(windTip(wind, groom));
    if (from && tip) {
        handles.arrow(*from, *tip, hot || drags ? Handles::kHot : Handles::kPlain);
        handles.label(*tip, textOf(wind));
    }
    if (hot && !drags)
        ImGui::SetTooltip("Drag: turns the wind; a longer arrow is a stronger wind.");
    if (settings.simulation.solver == hair::Solver::none)
        handles.hint("The solver is none: no wind moves this hair.");
    return edit;
}

Edit WindTool::options(OptionsLine& line, hair::Settings& settings) {
    hair::WindSettings& wind = settings.simulation.wind;
    const bool is_drag = wind.mode == hair::WindMode::drag;
    float value = windOf(wind);
    Edit edit;
    if (line.slider(
            "Wind", value, 0.0f, is_drag ? 20.0f : 30.0f, is_drag ? "%.1f m/s" : "%.1f m/s²")) {
        setWind(wind, value);
        edit = {.changed = true, .continues = ImGui::IsItemActive()};
    }
    ImGui::SetItemTooltip(
        is_drag ? "Mean speed of the wind: /simulation/wind/speed"
                : "Acceleration by the wind: /simulation/wind/strength");
    if (line.button("Still air", windOf(wind) > 0.0f, "No wind; the arrow keeps its direction")) {
        setWind(wind, 0.0f);
        edit.changed = true;
    }
    return edit;
}

}  // namespace benchmarks
