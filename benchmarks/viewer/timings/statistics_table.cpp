#include "benchmarks/viewer/timings/statistics_table.h"

#include <algorithm>
#include <string>

#include <imgui.h>

#include "benchmarks/quantity_text.h"
#include "benchmarks/viewer/timings/figure_table.h"

namespace benchmarks {

namespace {

// Both are read on dark and on light.
constexpr ImU32 kRight = IM_COL32(46, 160, 67, 255);
constexpr ImU32 kWrong = IM_COL32(218, 54, 51, 255);

void verdict(const Statistic& statistic) {
    if (!statistic.expected) return;
    const bool right = *statistic.expected == statistic.measured;
    ImGui::PushStyleColor(ImGuiCol_Text, right ? kRight : kWrong);
    ImGui::TextUnformatted(right ? "=" : "!=");
    ImGui::PopStyleColor();
    helpMarker(
        right ? "as many as follow from the settings"
              : "another number than follows from the settings");
}

void show(const Statistic& statistic) {
    std::string name = statistic.name;
    std::ranges::replace(name, '_', ' ');
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(name.c_str());
    if (!statistic.note.empty()) ImGui::TextDisabled("%s", statistic.note.c_str());
    ImGui::PopTextWrapPos();
    ImGui::TableNextColumn();
    rightText(countText(statistic.measured));
    if (statistic.expected && *statistic.expected != statistic.measured)
        rightText("not " + countText(*statistic.expected));
    ImGui::TableNextColumn();
    verdict(statistic);
}

}  // namespace

void statisticsTable(const std::vector<Statistic>& statistics) {
    if (!ImGui::BeginTable("##statistics", 3, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (const Statistic& statistic : statistics) show(statistic);
    ImGui::EndTable();
}

}  // namespace benchmarks
