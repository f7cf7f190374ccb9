#include "benchmarks/viewer/timings/measured_table.h"

#include <cmath>
#include <string>

#include <imgui.h>

#include "benchmarks/decide/median_interval.h"
#include "benchmarks/quantity_text.h"
#include "benchmarks/statistics.h"
#include "benchmarks/table.h"
#include "benchmarks/viewer/timings/figure_table.h"

namespace benchmarks {

namespace {

constexpr double kAlpha = 0.05;

void sampling(const Sampling& mode) {
    std::string text = mode.mode + ": " + countText(mode.rounds, "round") + ", " +
                       shortNumber(mode.seconds) + " s";
    if (mode.precision && std::isfinite(*mode.precision))
        text += ", +-" + shortNumber(100.0 * *mode.precision) + " %";
    if (mode.steady && !*mode.steady) text += ", not steady";
    ImGui::TextWrapped("%s", text.c_str());
}

}  // namespace

std::string medianText(const Metric& metric) {
    std::string text = shortNumber(summarize(metric.samples).median);
    if (metric.samples.size() < 2) return text;
    const MedianInterval interval =
        medianInterval(metric.samples, kAlpha, effectiveSamples(metric.samples));
    if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
        text += " (" + shortNumber(interval.lower) + " to " + shortNumber(interval.upper) + ")";
    return text;
}

void measuredTable(const CaseResult& result) {
    for (const Sampling& mode : result.sampling) sampling(mode);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled(
        "Medians in ms, rates in 1/s; in brackets where they lie with 95 %% confidence");
    ImGui::PopTextWrapPos();
    {
        FigureTable table("##measured", FigureTable::Columns::one);
        for (const Metric& metric : result.metrics) {
            if (metric.samples.empty() || (metric.unit != "ms" && metric.unit != "1/s")) continue;
            std::string help = modeName(metric.mode);
            if (!help.empty()) help += ", ";
            help +=
                "median in " + metric.unit + " of " + countText(metric.samples.size(), "sample");
            table.row(metric.name().c_str(), help.c_str(), medianText(metric));
        }
    }
    for (const std::string& warning : result.trust.warnings)
        ImGui::TextWrapped("Warning: %s", warning.c_str());
}

}  // namespace benchmarks
