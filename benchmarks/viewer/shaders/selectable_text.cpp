#include "benchmarks/viewer/shaders/selectable_text.h"

#include <algorithm>

namespace benchmarks {

namespace {

// With line breaks where words go on in the next line.
std::string wrapped(const std::string& text, float width) {
    std::string lines;
    const char* const end = text.data() + text.size();
    for (const char* from = text.data(); from < end;) {
        const char* const line_end = std::find(from, end, '\n');
        const char* to = ImGui::GetFont()->CalcWordWrapPositionA(
            ImGui::GetFontSize() / ImGui::GetFont()->FontSize, from, line_end, width);
        if (to == from && to < line_end) ++to;  // no room for a single letter
        lines.append(from, to);
        from = to;
        if (from < end) lines += '\n';
        if (from == line_end && from < end)
            ++from;
        else
            while (from < line_end && *from == ' ') ++from;
    }
    return lines;
}

}  // namespace

void selectableText(const char* id, const std::string& text, const ImVec4& color) {
    std::string lines = wrapped(text, ImGui::GetContentRegionAvail().x - ImGui::GetFontSize());
    const auto count = static_cast<float>(1 + std::ranges::count(lines, '\n'));
    ImGui::PushStyleColor(ImGuiCol_FrameBg, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0f);
    // A little more than its lines, or it gets a scroll bar.
    ImGui::InputTextMultiline(
        id, lines.data(), lines.size() + 1,
        ImVec2(-1.0f, (count + 0.2f) * ImGui::GetTextLineHeight()),
        ImGuiInputTextFlags_ReadOnly | ImGuiInputTextFlags_NoHorizontalScroll);
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor(2);
}

}  // namespace benchmarks
