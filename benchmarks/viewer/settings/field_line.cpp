#include "benchmarks/viewer/settings/field_line.h"

#include <imgui.h>

namespace benchmarks {

namespace {

constexpr float kNameShare = 0.46f;  // of the line

float resetWidth() { return ImGui::GetFrameHeight(); }

// Not every font has the arrow.
const char* resetLabel() { return ImGui::GetFont()->FindGlyphNoFallback(0x21ba) ? "↺" : "x"; }

void explain(const FieldText& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 28.0f);
    ImGui::TextUnformatted(text.help.c_str());
    if (!text.range.empty()) ImGui::TextDisabled("%s", text.range.c_str());
    ImGui::TextDisabled("%s", text.pointer.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void showName(const FieldText& text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.name.c_str());
    explain(text);
    if (text.unit.empty()) return;
    ImGui::SameLine();
    ImGui::TextDisabled("%s", text.unit.c_str());
}

// At the right end of the line that the last item is on.
bool reset(const FieldText& text, float end) {
    ImGui::SameLine(end - resetWidth());
    const std::string label = std::string(resetLabel()) + "##" + text.pointer + "/reset";
    const bool pressed = ImGui::Button(label.c_str(), {resetWidth(), 0.0f});
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort)) ImGui::SetTooltip("as it was");
    return pressed;
}

}  // namespace

bool fieldLine(
    const FieldText& text, FieldShape shape, FieldMark mark, const std::function<void()>& widget) {
    const bool changed = mark == FieldMark::changed;
    const float start = ImGui::GetCursorPosX();
    const float room = ImGui::GetContentRegionAvail().x;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float name = ImGui::CalcTextSize(text.name.c_str()).x + 2.0f * gap;
    const bool above =
        shape == FieldShape::below || (shape == FieldShape::beside && name > room * kNameShare);
    bool is_reset = false;
    if (changed)
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
    if (shape != FieldShape::check) showName(text);
    if (changed && shape != FieldShape::check) ImGui::PopStyleColor();
    if (above) {
        if (changed) is_reset = reset(text, start + room);
        ImGui::SetNextItemWidth(-1.0f);
    } else if (shape == FieldShape::beside) {
        ImGui::SameLine(start + room * kNameShare);
        ImGui::SetNextItemWidth(changed ? -resetWidth() - gap : -1.0f);
    }
    widget();
    if (changed && shape == FieldShape::check) ImGui::PopStyleColor();
    explain(text);
    if (changed && !above) is_reset = reset(text, start + room);
    return is_reset;
}

}  // namespace benchmarks
