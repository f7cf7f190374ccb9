#include "benchmarks/viewer/shell/columns.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace benchmarks {

namespace {

constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;

ImGuiCol backgroundOf(Surface surface) {
    switch (surface) {
    case Surface::stage:
        return ImGuiCol_ScrollbarBg;
    case Surface::bar:
        return ImGuiCol_MenuBarBg;
    default:
        return ImGuiCol_WindowBg;
    }
}

// A bar has one line of widgets, in the middle of its height.
ImVec2 paddingOf(Surface surface, const Box& box) {
    const ImVec2 usual = ImGui::GetStyle().WindowPadding;
    if (surface == Surface::splitter) return {0.0f, 0.0f};
    if (surface != Surface::bar) return usual;
    return {usual.x, std::max(std::floor((box.height - ImGui::GetFrameHeight()) / 2.0f), 0.0f)};
}

// Heights of a letter that the bar was dragged to the right by.
float splitter(const char* name, const Box& box) {
    float dragged = 0.0f;
    pane(name, box, Surface::splitter, [&] {
        ImGui::InvisibleButton("##bar", {box.width, box.height});
        const bool held = ImGui::IsItemActive();
        const float middle = std::floor(box.x + box.width / 2.0f);
        ImGui::GetWindowDrawList()->AddLine(
            {middle, box.y}, {middle, box.bottom()}, ImGui::GetColorU32(ImGuiCol_Separator));
        if (held || ImGui::IsItemHovered()) {
            ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
            ImGui::GetWindowDrawList()->AddRectFilled(
                {box.x, box.y}, {box.right(), box.bottom()},
                ImGui::GetColorU32(ImGuiCol_SeparatorActive, held ? 1.0f : 0.5f));
        }
        if (held) dragged = ImGui::GetIO().MouseDelta.x / ImGui::GetFontSize();
    });
    return dragged;
}

// From the width that there is: what was not to be had is not what dragging goes on from.
void drag(Column& column, const Box& box, float letters) {
    if (letters == 0.0f) return;
    column.width = std::max(box.width / ImGui::GetFontSize() + letters, kNarrowestColumn);
}

}  // namespace

void pane(const char* name, const Box& box, Surface surface, const std::function<void()>& body) {
    if (box.empty()) return;
    ImGui::SetNextWindowPos({box.x, box.y});
    ImGui::SetNextWindowSize({box.width, box.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2{1.0f, 1.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, paddingOf(surface, box));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(backgroundOf(surface)));
    const bool visible = ImGui::Begin(name, nullptr, kFixed);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(4);
    if (visible) body();
    ImGui::End();
}

void splitters(const Layout& layout, Preferences& preferences) {
    const float left = splitter("Left splitter", layout.left_splitter);
    drag(preferences.left, layout.left, left);
    const float right = splitter("Right splitter", layout.right_splitter);
    drag(preferences.right, layout.right, -right);
}

}  // namespace benchmarks
