#include "benchmarks/viewer/timings/pass_table.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "benchmarks/table.h"
#include "benchmarks/viewer/timings/figure_table.h"
#include "benchmarks/viewer/timings/share_bar.h"
#include "benchmarks/viewer/timings/sparkline.h"

namespace benchmarks {

namespace {

constexpr float kLeastHistory = 4.0f;  // letters' heights that a history takes at least

std::string percent(double share) {
    char text[16];
    std::snprintf(text, sizeof text, share < 0.0995 ? "%.1f %%" : "%.0f %%", 100.0 * share);
    return text;
}

// Which columns there is room for.
struct Layout {
    bool compared = false;
    bool history = false;
    bool share = false;

    int columns() const { return 2 + (compared ? 2 : 0) + (history ? 1 : 0) + (share ? 1 : 0); }
};

Layout layoutFor(const PassRows& rows, bool compared) {
    const auto width = [](const char* text) {
        return ImGui::CalcTextSize(text).x + 2.0f * ImGui::GetStyle().CellPadding.x;
    };
    float name = width(rows.sum.name.c_str());
    for (const TimeSeries& pass : rows.passes) name = std::max(name, width(pass.name.c_str()));
    float room = ImGui::GetContentRegionAvail().x - name - width("0.0000");
    if (compared) room -= width("0.0000") + width("B / A");
    Layout layout{.compared = compared};
    const float history = std::max(kLeastHistory * ImGui::GetFontSize(), width("history"));
    layout.history = room >= history;
    if (layout.history) room -= history;
    layout.share = room >= width("100 %");
    return layout;
}

std::string seriesText(const TimeSeries& series) {
    const Summary& times = series.summary;
    std::string text = "median " + shortNumber(times.median) + " ms of " +
                       std::to_string(times.count) + " frames, MAD " + shortNumber(times.mad) +
                       " ms\nfrom " + shortNumber(times.minimum) + " to " +
                       shortNumber(times.maximum) + " ms";
    text += series.high ? "\n1 % high: 1 % of the frames took longer than " +
                              shortNumber(*series.high) + " ms"
                        : "\n1 % high: known from 100 frames on";
    return text;
}

void history(const TimeSeries& series, ImU32 color) {
    const ImVec2 size(
        std::max(ImGui::GetContentRegionAvail().x, 1.0f), ImGui::GetTextLineHeight() * 1.2f);
    const std::optional<std::size_t> at =
        sparkline(("##history of " + series.name).c_str(), series.times, size, color);
    if (!at) return;
    std::string text = series.name;
    if (!series.numbers.empty()) text += ", frame " + std::to_string(series.numbers[*at]);
    text += ": " + shortNumber(series.times[*at]) + " ms\n" + seriesText(series);
    ImGui::SetTooltip("%s", text.c_str());
}

struct Row {
    const TimeSeries& series;
    const TimeSeries* compared;
    std::optional<double> share;
    ImU32 color;
    std::string help;
};

void show(const Row& row, const Layout& layout) {
    const double median = row.series.summary.median;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.series.name.c_str());
    std::string help = row.help + seriesText(row.series);
    if (row.share) help += "\n" + percent(*row.share) + " of all passes";
    helpMarker(help.c_str());
    if (row.share) shareBar(*row.share, row.color);
    if (layout.history) {
        ImGui::TableNextColumn();
        history(row.series, row.color);
    }
    ImGui::TableNextColumn();
    rightText(shortNumber(median));
    if (layout.share) {
        ImGui::TableNextColumn();
        if (row.share) rightText(percent(*row.share));
    }
    if (!layout.compared) return;
    ImGui::TableNextColumn();
    if (row.compared) rightText(shortNumber(row.compared->summary.median));
    ImGui::TableNextColumn();
    if (row.compared && median > 0.0) rightText(shortNumber(row.compared->summary.median / median));
}

void titles(const Layout& layout) {
    ImGui::TableNextRow();
    const auto title = [](const char* text) {
        ImGui::TableNextColumn();
        rightText(text);
    };
    ImGui::TableNextColumn();
    ImGui::TextDisabled("pass");
    if (layout.history) title("history");
    title(layout.compared ? "A ms" : "ms");
    if (layout.share) title("share");
    if (!layout.compared) return;
    title("B ms");
    title("B / A");
}

bool beginTable(const char* id, const Layout& layout) {
    if (!ImGui::BeginTable(id, layout.columns(), ImGuiTableFlags_SizingFixedFit)) return false;
    // Names are as wide as they are where a history takes the rest of the room.
    ImGui::TableSetupColumn(
        "", layout.history ? ImGuiTableColumnFlags_WidthFixed : ImGuiTableColumnFlags_WidthStretch);
    if (layout.history) ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    return true;
}

void bar(const PassRows& rows) {
    std::vector<Share> shares;
    for (std::size_t i = 0; i < rows.passes.size(); ++i)
        shares.push_back({rows.passes[i].name, rows.passes[i].summary.median, seriesColor(i)});
    stackedBar("##passes", shares, "ms");
}

}  // namespace

void passTable(const PassRows& rows, const PassRows* compared, const TimeSeries* ui) {
    bar(rows);
    const Layout layout = layoutFor(rows, compared != nullptr);
    const ImU32 plain = ImGui::GetColorU32(ImGuiCol_Text);
    if (!beginTable("##pass table", layout)) return;
    titles(layout);
    for (std::size_t i = 0; i < rows.passes.size(); ++i) {
        const TimeSeries& pass = rows.passes[i];
        show(
            {pass, compared ? compared->find(pass.name) : nullptr, rows.share(pass), seriesColor(i),
             "by itself, between full barriers\n"},
            layout);
    }
    show(
        {rows.sum, compared ? &compared->sum : nullptr, std::nullopt, plain,
         "the passes of each frame added up\n"},
        layout);
    if (ui) {
        ImGui::TableNextRow(ImGuiTableRowFlags_None, ImGui::GetFontSize() * 0.4f);
        ImGui::TableNextColumn();
        ImGui::Separator();
        show(
            {*ui, nullptr, std::nullopt, ImGui::GetColorU32(ImGuiCol_TextDisabled),
             "what the window itself costs the device: widgets and copies of the pictures. It is "
             "in no other figure\n"},
            layout);
    }
    ImGui::EndTable();
}

}  // namespace benchmarks
