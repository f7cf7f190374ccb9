#include "benchmarks/viewer/timings/memory_table.h"

#include <algorithm>
#include <optional>

#include <imgui.h>

#include "benchmarks/memory_metrics.h"
#include "benchmarks/quantity_text.h"
#include "benchmarks/viewer/timings/figure_table.h"
#include "benchmarks/viewer/timings/share_bar.h"

namespace benchmarks {

namespace {

double bytesOf(const Metric& metric) { return metric.samples.front(); }

void line(
    const std::string& name, const char* help, double bytes, std::optional<double> share = {}) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.c_str());
    helpMarker(help);
    if (share) shareBar(*share, seriesColor(0));
    ImGui::TableNextColumn();
    rightText(sizeText(static_cast<std::uint64_t>(bytes)));
}

}  // namespace

void memoryTable(const engine::MemoryLedger& ledger) {
    std::vector<Metric> purposes = memoryMetrics(ledger);
    double window = 0.0, scene = 0.0;
    std::erase_if(purposes, [&](const Metric& metric) {
        if (metric.id.what != Measured::purpose) return true;
        const bool is_window = metric.id.part == "window";
        (is_window ? window : scene) += bytesOf(metric);
        return is_window;
    });
    std::ranges::sort(purposes, std::ranges::greater{}, bytesOf);
    if (!ImGui::BeginTable("##memory", 2, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (const Metric& metric : purposes)
        line(metric.id.part, "", bytesOf(metric), bytesOf(metric) / scene);
    line(
        "all of these",
        "Device memory that buffers and images hold, of both sides where two are compared", scene);
    line("window", "What the window itself holds: its picture, and copies of those in it", window);
    ImGui::EndTable();
}

void countTable(
    const std::vector<std::pair<std::string, std::uint64_t>>& counts,
    const std::vector<std::pair<std::string, std::uint64_t>>* compared) {
    FigureTable table(
        "##counts", compared ? FigureTable::Columns::compared : FigureTable::Columns::one);
    for (const auto& [name, count] : counts) {
        std::string text = name, other;
        std::ranges::replace(text, '_', ' ');
        if (compared)
            for (const auto& [other_name, other_count] : *compared)
                if (other_name == name) other = countText(other_count);
        table.row(text.c_str(), "", countText(count), other);
    }
}

}  // namespace benchmarks
