#include "benchmarks/viewer/shell/status_line.h"

#include <algorithm>

#include <imgui.h>

namespace benchmarks {

namespace {

float widthOf(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

// As much of it as there is room for, in bytes; never a part of a character.
std::string cut(const std::string& text, float room) {
    if (widthOf(text) <= room) return text;
    std::size_t length = text.size();
    const auto fits = [&] { return widthOf(text.substr(0, length) + "...") <= room; };
    while (length > 0 && !fits()) {
        --length;
        while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0u) == 0x80u) --length;
    }
    return text.substr(0, length) + "...";
}

void cutText(const std::string& text, float room, ImGuiCol color) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(color));
    ImGui::TextUnformatted(cut(text, room).c_str());
    ImGui::PopStyleColor();
    if (widthOf(text) > room && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

void statusLine(const StatusText& status) {
    ImGui::AlignTextToFramePadding();
    const float gap = 1.5f * ImGui::GetFontSize();
    const float room = ImGui::GetContentRegionAvail().x;
    const float picture = widthOf(status.picture);
    // The device's name gives way first.
    float device = std::min(widthOf(status.device), 0.3f * room);
    float left = std::max(room - picture - device - 2.0f * gap, 0.0f);
    if (widthOf(status.text) > left) {
        left = std::max(room - picture - gap, 0.0f);
        device = 0.0f;
    }
    const float start = ImGui::GetCursorPosX();
    const ImGuiCol color = status.tone == StatusText::Tone::hint      ? ImGuiCol_TextDisabled
                           : status.tone == StatusText::Tone::problem ? ImGuiCol_PlotHistogram
                                                                      : ImGuiCol_Text;
    cutText(status.text, left, color);
    if (device > 0.0f) {
        ImGui::SameLine(start + left + gap);
        cutText(status.device, device, ImGuiCol_TextDisabled);
    }
    ImGui::SameLine(start + room - picture);
    cutText(status.picture, picture, ImGuiCol_TextDisabled);
}

}  // namespace benchmarks
