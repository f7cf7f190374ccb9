#include "benchmarks/viewer/tools/options_line.h"

#include <imgui.h>

namespace benchmarks {

namespace {

constexpr const char* kBar = "|";

float spacing() { return ImGui::GetStyle().ItemSpacing.x; }

float buttonWidth(const char* name) {
    return ImGui::CalcTextSize(name, nullptr, true).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

}  // namespace

void OptionsLine::place(float width) {
    if (!is_empty_) {
        ImGui::SameLine();
        const float bar = separates_ ? ImGui::CalcTextSize(kBar).x + spacing() : 0.0f;
        if (ImGui::GetContentRegionAvail().x < bar + width) {
            ImGui::NewLine();
        } else if (separates_) {
            ImGui::TextDisabled("%s", kBar);
            ImGui::SameLine();
        }
    }
    is_empty_ = separates_ = false;
}

bool OptionsLine::button(const char* name, bool enabled, const char* tooltip) {
    place(buttonWidth(name));
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(name);
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_ForTooltip | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", tooltip);
    return pressed;
}

bool OptionsLine::choice(const char* name, Choice choice, const char* tooltip) {
    place(buttonWidth(name));
    const bool chosen = choice == Choice::chosen;
    if (chosen)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(name);
    if (chosen) ImGui::PopStyleColor();
    ImGui::SetItemTooltip("%s", tooltip);
    return pressed;
}

bool OptionsLine::slider(
    const char* name, float& value, float minimum, float maximum, const char* format) {
    const float width = 9.0f * ImGui::GetFontSize();
    place(width + ImGui::CalcTextSize(name).x + ImGui::GetStyle().ItemInnerSpacing.x);
    ImGui::SetNextItemWidth(width);
    return ImGui::SliderFloat(name, &value, minimum, maximum, format);
}

void OptionsLine::separator() { separates_ = true; }

}  // namespace benchmarks
