#include "benchmarks/viewer/picture/choice_buttons.h"

#include <imgui.h>

namespace benchmarks {

void sameLineIfItFits(const char* label) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float width = ImGui::CalcTextSize(label, nullptr, true).x + 2.0f * style.FramePadding.x;
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

bool choiceButton(const char* label, const char* help, Chosen chosen) {
    const bool pressed_in = chosen == Chosen::yes;
    if (pressed_in)
        ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(label);
    if (pressed_in) ImGui::PopStyleColor();
    ImGui::SetItemTooltip("%s", help);
    return pressed;
}

}  // namespace benchmarks
