#include "benchmarks/viewer/timings/figure_table.h"

#include <imgui.h>

#include "benchmarks/table.h"

namespace benchmarks {

std::string numberText(std::optional<double> number) { return number ? shortNumber(*number) : "-"; }

void helpMarker(const char* help) {
    if (*help == 0) return;
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_DelayShort) && ImGui::BeginTooltip()) {
        ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24.0f);
        ImGui::TextUnformatted(help);
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

void rightText(const std::string& text) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0.0f) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    ImGui::TextUnformatted(text.c_str());
}

FigureTable::FigureTable(const char* id, Columns columns, const char* title) : columns_(columns) {
    const int count = columns == Columns::compared ? 4 : 2;
    open_ = ImGui::BeginTable(id, count, ImGuiTableFlags_SizingFixedFit);
    if (!open_) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (int i = 1; i < count; ++i) ImGui::TableSetupColumn("");
    if (columns == Columns::one && *title == 0) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", title);
    if (columns == Columns::one) return;
    for (const char* side : {"A", "B", "B / A"}) {
        ImGui::TableNextColumn();
        rightText(side);
    }
}

FigureTable::~FigureTable() {
    if (open_) ImGui::EndTable();
}

void FigureTable::row(
    const char* name, const char* help, std::optional<double> a, std::optional<double> b) {
    row(name, help, numberText(a), numberText(b));
    if (!open_ || columns_ == Columns::one) return;
    ImGui::TableNextColumn();
    rightText(a && b && *a > 0.0 ? shortNumber(*b / *a) : "-");
}

void FigureTable::row(
    const char* name, const char* help, const std::string& a, const std::string& b) {
    if (!open_) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(name);
    ImGui::PopTextWrapPos();
    helpMarker(help);
    ImGui::TableNextColumn();
    rightText(a);
    if (columns_ == Columns::one) return;
    ImGui::TableNextColumn();
    rightText(b);
}

}  // namespace benchmarks
