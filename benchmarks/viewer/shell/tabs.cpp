#include "benchmarks/viewer/shell/tabs.h"

#include <algorithm>
#include <array>

#include <imgui.h>

namespace benchmarks {

namespace {

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

}  // namespace benchmarks
