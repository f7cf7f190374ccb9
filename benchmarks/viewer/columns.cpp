#include "benchmarks/viewer/columns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <imgui.h>

namespace benchmarks::viewer {
namespace {

// ---- Columns ------------------------------------------------------------------------------------

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

namespace {

// ---- Tabs ---------------------------------------------------------------------------------------

constexpr std::array kTabs{Tab::scene, Tab::files, Tab::timings, Tab::compare, Tab::shaders};
constexpr std::size_t kLeft = 2;  // the first ones are the left column's

}  // namespace

const char* tabName(Tab tab) {
    switch (tab) {
    case Tab::scene:
        return "Scene";
    case Tab::files:
        return "Files";
    case Tab::timings:
        return "Timings";
    case Tab::compare:
        return "Compare";
    case Tab::shaders:
        return "Shaders";
    }
    return "";
}

std::span<const Tab> allTabs() { return kTabs; }
std::span<const Tab> leftTabs() { return allTabs().first(kLeft); }
std::span<const Tab> rightTabs() { return allTabs().subspan(kLeft); }

void Tabs::choose(Tab tab) {
    only = tab;
    (std::ranges::count(leftTabs(), tab) > 0 ? left : right) = tab;
}

bool tabStrip(std::span<const Tab> tabs, Tab& chosen) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float end = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    bool changed = false;
    for (std::size_t i = 0; i < tabs.size(); ++i) {
        const char* const name = tabName(tabs[i]);
        const float width = ImGui::CalcTextSize(name).x + 2.0f * style.FramePadding.x;
        const float gap = style.ItemInnerSpacing.x;
        if (i > 0 && ImGui::GetItemRectMax().x + gap + width <= end) ImGui::SameLine(0.0f, gap);
        const bool is_chosen = tabs[i] == chosen;
        ImGui::PushStyleColor(
            ImGuiCol_Button,
            ImGui::GetStyleColorVec4(is_chosen ? ImGuiCol_TabActive : ImGuiCol_Tab));
        if (ImGui::Button(name) && !is_chosen) {
            chosen = tabs[i];
            changed = true;
        }
        ImGui::PopStyleColor();
    }
    return changed;
}

}  // namespace benchmarks::viewer
