#include <array>
#include <cstdio>
#include <optional>

#include "benchmarks/columns.h"
#include "benchmarks/lod_report.h"
#include "benchmarks/table.h"

namespace benchmarks {

namespace {

std::string fixed(double number, const char* format) {
    char text[32];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string percent(double ratio) { return fixed(100.0 * ratio, "%+.2f"); }

// Pictures' errors are small beside 1: thousandths of the range.
std::string thousandths(std::optional<double> value) {
    return value ? fixed(1000.0 * *value, "%.2f") : "-";
}

std::vector<Column> columns(const std::vector<LodStep>& steps) {
    std::vector<Column> all{{"distance, m"},     {"level"},       {"strands"},   {"error, 1/1000"},
                            {"popping, 1/1000"}, {"coverage, %"}, {"change, %"}, {"strands, ms"},
                            {"full, ms"},        {"frame, ms"},   {"full, ms"}};
    for (const LodStep& step : steps) {
        const double change =
            step.full_coverage > 0.0 ? step.coverage / step.full_coverage - 1.0 : 0.0;
        const std::array cells{
            fixed(step.distance, "%.3f"),
            fixed(step.mean_level, "%.2f"),
            step.strands ? std::to_string(*step.strands) : "-",
            thousandths(step.error),
            thousandths(step.popping),
            fixed(100.0 * step.coverage, "%.2f"),
            percent(change),
            shortNumber(step.time.strands),
            shortNumber(step.full_time.strands),
            shortNumber(step.time.frame),
            shortNumber(step.full_time.frame)};
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i]);
    }
    return all;
}

}  // namespace

std::string lodTable(const LodReport& report) {
    const std::vector<Column> all = columns(report.steps);
    std::string text;
    for (std::size_t row = 0; row <= report.steps.size(); ++row) text += columnsLine(all, row);
    if (report.steps.empty()) return text;
    const LodTotals totals = totalsOf(report.steps);
    text += "\nworst popping: " + thousandths(totals.worst_popping) +
            " thousandths\ncoverage change: mean " + percent(totals.mean_coverage_change) +
            " %, worst " + percent(totals.worst_coverage_change) + " %\nspeed-up: strands " +
            shortNumber(totals.strands_speed_up) + ", frame " + shortNumber(totals.frame_speed_up) +
            '\n';
    return text;
}

}  // namespace benchmarks
