#include "benchmarks/viewer/timeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace benchmarks::viewer {
namespace {

constexpr double kAtLeast = 2.0;  // s, minimum length of the bar
constexpr double kMostFrames = 1e6;
constexpr float kNarrowest = 8.0f;  // letters

// Returns a simulated time in frames: frame 0 ends after the first frame's time.
float framesAt(const hair::Settings& settings, float time) {
    return static_cast<float>(
        std::min(double{time} / double{settings.run.frame_time} - 1.0, kMostFrames));
}

}  // namespace

std::vector<TimelineMark> timelineMarks(const hair::Settings& settings) {
    std::vector<TimelineMark> marks;
    if (settings.run.frame_time <= 0.0f) return marks;
    for (const hair::Keyframe& key : settings.simulation.motion.keyframes) {
        const float at = framesAt(settings, key.time);
        marks.push_back({TimelineMark::Kind::keyframe, at, at});
    }
    for (const hair::PullSettings& pull : settings.simulation.pulls)
        if (!pull.path.empty())
            marks.push_back(
                {TimelineMark::Kind::pull, framesAt(settings, pull.path.front().time),
                 framesAt(settings, pull.path.back().time)});
    return marks;
}

std::uint32_t
timelineEnd(const hair::Settings& settings, std::uint32_t frame, std::uint32_t furthest) {
    double end = std::max(frame, furthest);
    if (settings.run.frame_time > 0.0f)
        end = std::max(end, std::ceil(kAtLeast / double{settings.run.frame_time} - 1.0));
    end = std::max(end, 1.0);
    for (const TimelineMark& mark : timelineMarks(settings))
        end = std::max(end, std::ceil(double{mark.to}));
    return static_cast<std::uint32_t>(std::min(end, kMostFrames));
}

void timeline(PlayState& state, const Shown& shown) {
    state.furthest = std::max(state.furthest, shown.frame);
    const float letter = ImGui::GetFontSize();
    const ImVec2 room{ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight()};
    if (room.x < kNarrowest * letter) return;
    const std::uint32_t end = timelineEnd(shown.settings, shown.frame, state.furthest);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##timeline", room);
    const bool held = ImGui::IsItemActive();
    const bool hovered = ImGui::IsItemHovered();

    const float margin = 0.4f * letter;
    const float width = room.x - 2.0f * margin;
    const auto at = [&](float frame) {
        const float share = std::clamp(frame / static_cast<float>(end), 0.0f, 1.0f);
        return corner.x + margin + share * width;
    };
    const float share = (ImGui::GetIO().MousePos.x - corner.x - margin) / width;
    const auto under = static_cast<std::uint32_t>(
        std::lround(std::clamp(share, 0.0f, 1.0f) * static_cast<float>(end)));
    if (held) {
        state.playing = false;
        state.scrub = under;
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto color = [](ImGuiCol of, float alpha) { return ImGui::GetColorU32(of, alpha); };
    const float middle = corner.y + 0.5f * room.y;
    const float half = 0.16f * room.y;
    list.AddRectFilled(
        {at(0.0f), middle - half}, {at(static_cast<float>(end)), middle + half},
        color(ImGuiCol_FrameBg, 1.0f), half);
    const float now = at(static_cast<float>(shown.frame));
    list.AddRectFilled(
        {at(0.0f), middle - half}, {now, middle + half}, color(ImGuiCol_SliderGrab, 0.5f), half);
    for (const TimelineMark& mark : timelineMarks(shown.settings)) {
        if (mark.kind == TimelineMark::Kind::pull) {
            list.AddRectFilled(
                {at(mark.from), middle + half + 1.0f},
                {std::max(at(mark.to), at(mark.from) + 2.0f), middle + half + 0.22f * letter},
                color(ImGuiCol_PlotHistogram, 1.0f));
            continue;
        }
        const float x = at(mark.from), size = 0.22f * letter;
        list.AddQuadFilled(
            {x, middle - size}, {x + size, middle}, {x, middle + size}, {x - size, middle},
            color(ImGuiCol_Text, 0.8f));
    }
    // The target frame and the shown frame.
    if (state.scrub)
        list.AddLine(
            {at(static_cast<float>(*state.scrub)), corner.y},
            {at(static_cast<float>(*state.scrub)), corner.y + room.y}, color(ImGuiCol_Text, 0.5f));
    list.AddRectFilled(
        {now - 0.14f * letter, corner.y + 1.0f}, {now + 0.14f * letter, corner.y + room.y - 1.0f},
        color(held || hovered ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab, 1.0f), 2.0f);
    if (!hovered && !held) return;
    std::array<char, 128> text{};
    if (state.scrub && *state.scrub != shown.frame)
        std::snprintf(
            text.data(), text.size(), "plays to frame %u: at %u", *state.scrub, shown.frame);
    else
        std::snprintf(
            text.data(), text.size(), "frame %u of %u, %.3f s; drag to play to another", under, end,
            (static_cast<double>(under) + 1.0) * double{shown.settings.run.frame_time});
    ImGui::SetTooltip("%s", text.data());
}

}  // namespace benchmarks::viewer
