#include "benchmarks/viewer/shell/help_panel.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include <imgui.h>

#include "benchmarks/viewer/shell/action.h"

namespace benchmarks {

namespace {

struct Gesture {
    const char* what;
    const char* does;
};
// What no action does.
constexpr std::array kMouse{
    Gesture{"Left drag", "camera: orbits; other tools: moves their handles"},
    Gesture{"Right or middle drag", "pans"},
    Gesture{"M + drag", "moves magnified pictures (1:1, 2x, 4x, 8x)"},
    Gesture{"Wheel, Page Up, Page Down", "zooms"},
    Gesture{"Double click", "looks at what is under the mouse"},
    Gesture{"W A S D Q E, arrows", "fly, while the mouse is over the picture"},
};
constexpr std::array kWidgets{
    Gesture{"Drag a number", "changes it; Alt: slowly, Shift: fast"},
    Gesture{"Double click, Ctrl+click", "types it"},
    Gesture{"Drop a file", "scene, screenshot, groom, mesh or environment"},
};

void line(const char* what, const char* does) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(what);
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(does);
    ImGui::PopTextWrapPos();
}

bool beginPart(const char* title) {
    ImGui::SeparatorText(title);
    if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_RowBg)) return false;
    const float letter = ImGui::GetFontSize();
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 13.0f * letter);
    ImGui::TableSetupColumn("what it does", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void gestures(const char* title, std::span<const Gesture> rows) {
    if (!beginPart(title)) return;
    for (const Gesture& row : rows) line(row.what, row.does);
    ImGui::EndTable();
}

void keysOf(std::span<const ActionRow> rows) {
    if (std::ranges::none_of(rows, [](const ActionRow& row) { return row.keys[0] != 0; })) return;
    if (!beginPart(rows.front().menu)) return;
    for (const ActionRow& row : rows)
        if (row.keys[0] != 0) line(row.keys, (std::string(row.name) + ": " + row.help).c_str());
    ImGui::EndTable();
}

}  // namespace

void helpPanel(bool& open) {
    if (!open) return;
    const ImVec2 room = ImGui::GetMainViewport()->Size;
    const float letter = ImGui::GetFontSize();
    ImGui::SetNextWindowSize(
        {std::min(44.0f * letter, room.x - 2.0f * letter),
         std::min(40.0f * letter, room.y - 4.0f * letter)});
    ImGui::SetNextWindowPos({room.x * 0.5f, room.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoCollapse |
                                        ImGuiWindowFlags_NoSavedSettings;
    if (ImGui::Begin("Keys and mouse", &open, kFlags)) {
        gestures("Mouse in the picture", kMouse);
        gestures("Widgets", kWidgets);
        for (const auto& rows : actionMenus()) keysOf(rows);
    }
    ImGui::End();
    if (ImGui::IsKeyPressed(ImGuiKey_Escape)) open = false;
}

}  // namespace benchmarks
