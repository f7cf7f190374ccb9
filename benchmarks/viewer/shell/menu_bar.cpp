#include "benchmarks/viewer/shell/menu_bar.h"

#include <imgui.h>

namespace benchmarks {

namespace {

// Those before which a menu has a line.
bool startsGroup(Action action) {
    switch (action) {
    case Action::copy_axes:
    case Action::screenshot:
    case Action::quit:
    case Action::view_front:
    case Action::show_head:
    case Action::panel_scene:
    case Action::left_column:
    case Action::dark_theme:
    case Action::larger:
    case Action::present_fifo:
        return true;
    default:
        return false;
    }
}

bool item(const ActionRow& row, const ActionState& state) {
    const bool chosen = ImGui::MenuItem(row.name, row.keys, state.checked, state.enabled);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayNormal | ImGuiHoveredFlags_AllowWhenDisabled))
        ImGui::SetTooltip("%s", row.help);
    return chosen;
}

}  // namespace

std::vector<Action> menuBar(const std::function<ActionState(Action)>& state) {
    std::vector<Action> chosen;
    if (!ImGui::BeginMainMenuBar()) return chosen;
    for (const auto& rows : actionMenus()) {
        if (!ImGui::BeginMenu(rows.front().menu)) continue;
        for (const ActionRow& row : rows) {
            if (startsGroup(row.action)) ImGui::Separator();
            if (item(row, state(row.action))) chosen.push_back(row.action);
        }
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
    return chosen;
}

}  // namespace benchmarks
