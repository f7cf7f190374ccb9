#include "benchmarks/viewer/play/play_panel.h"

#include <array>

#include <imgui.h>

namespace benchmarks {

namespace {

struct Speed {
    const char* name;
    std::optional<double> speed;  // simulated seconds per second
};
constexpr std::array kSpeeds{
    Speed{"Every frame", std::nullopt},
    Speed{"1/4x", 0.25},
    Speed{"1/2x", 0.5},
    Speed{"1x", 1.0},
    Speed{"2x", 2.0},
    Speed{"4x", 4.0},
};

float letters(float count) { return count * ImGui::GetFontSize(); }

void tip(const char* text) {
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", text);
}

void speedCombo(std::optional<double>& speed) {
    const char* name = "other";
    for (const Speed& each : kSpeeds)
        if (each.speed == speed) name = each.name;
    ImGui::SetNextItemWidth(letters(8.0f));
    if (ImGui::BeginCombo("##speed", name)) {
        for (const Speed& each : kSpeeds)
            if (ImGui::Selectable(each.name, each.speed == speed)) speed = each.speed;
        ImGui::EndCombo();
    }
    tip("simulated time per time; every frame: one for each picture of the window, as fast as they "
        "come.\nThe simulation's steps are the same at any speed");
}

}  // namespace

void playPanel(PlayState& state, std::uint32_t frame, double time) {
    // As wide as the wider of its two names, so that nothing moves when it is pressed.
    if (ImGui::Button(state.playing ? "Pause###play" : "Play###play", {letters(4.5f), 0.0f}))
        state.playing = !state.playing;
    tip("Space");
    ImGui::SameLine();
    ImGui::BeginDisabled(state.playing);
    if (ImGui::Button("Step")) state.step = true;
    ImGui::EndDisabled();
    tip("one frame, while it is paused: .");
    ImGui::SameLine();
    if (ImGui::Button("Restart")) state.seek = 0;
    tip("back to frame 0: Home");
    ImGui::SameLine();
    speedCombo(state.speed);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Frame");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(letters(5.5f));
    std::uint32_t wanted = frame;
    ImGui::InputScalar("##frame", ImGuiDataType_U32, &wanted);
    if (ImGui::IsItemDeactivatedAfterEdit()) state.seek = wanted;
    tip("type another to go there: the scene is played up to it from frame 0 on");
    ImGui::SameLine();
    ImGui::Text("%.3f s", time);
    tip("simulated time at the end of the frame");
}

}  // namespace benchmarks
