#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/axis.h"
#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"
#include "benchmarks/table.h"

namespace benchmarks {
namespace {

// Inside a table's cell: no line ends, and nothing that begins a column or markup.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (std::string_view("\\`*_[]<>|#").find(c) != std::string_view::npos) result += '\\';
        result += c == '\n' || c == '\r' ? ' ' : c;
    }
    return result;
}

void addCell(std::string& line, const std::string& text) { line += ' ' + text + " |"; }

const MetricId kRate = ofFrame(Measured::rate);

// Frames per second and the times of the frame and of each pass, in the order in which they first
// occur.
std::vector<MetricId> columnMetrics(const Json& report) {
    std::vector<MetricId> metrics;
    for (const Reading& reading : readings(report)) {
        const MetricId& id = reading.metric.id;
        const bool shown = id == kRate || isFrameOrPassTime(id);
        if (shown && std::ranges::find(metrics, id) == metrics.end()) metrics.push_back(id);
    }
    return metrics;
}

std::string columnTitle(const MetricId& metric) {
    if (metric == kRate) return "FPS";
    return (isPassTime(metric) ? metric.pass() : "frame") + " (ms)";
}

std::string aboutTheRun(const Json& report) {
    const Json& environment = report.at("environment");
    std::string text = "**" + escaped(cellText(report.at("scene"), "path")) + "**";
    for (const auto& [group, member] :
         {std::pair{"device", "name"},
          {"device", "driver"},
          {"device", "driver_version"},
          {"host", "processor"},
          {"build", "commit"}})
        if (const std::string value = cellText(environment.at(group), member); !value.empty())
            text += ", " + escaped(value);
    return text + "\n\n";
}

}  // namespace

std::string markdown(const Json& report) {
    const std::vector<std::string> pointers = axisPointers(report);
    const std::vector<MetricId> metrics = columnMetrics(report);
    std::string titles = "|";
    std::string rule = "|";
    for (const std::string& label : axisLabels(pointers)) addCell(titles, escaped(label));
    for (const MetricId& metric : metrics) addCell(titles, escaped(columnTitle(metric)));
    addCell(titles, "status");
    for (std::size_t i = 0; i < pointers.size(); ++i) rule += " --- |";
    for (std::size_t i = 0; i < metrics.size(); ++i) rule += " ---: |";
    std::string text = aboutTheRun(report) + titles + '\n' + rule + " --- |\n";
    for (const Json& result : report.at("cases")) {
        std::string line = "|";
        for (const std::string& pointer : pointers)
            addCell(line, escaped(cellText(result.at("axes"), pointer)));
        std::vector<MetricReading> measured;
        if (result.contains("metrics")) measured = readMetrics(result);
        for (const MetricId& metric : metrics) {
            const MetricReading* const reading = findMetric(measured, metric);
            addCell(line, reading ? shortNumber(reading->median) : "");
        }
        const std::string reason = cellText(result, "reason");
        addCell(line, escaped(cellText(result, "status") + (reason.empty() ? "" : ": " + reason)));
        text += line + '\n';
    }
    return text;
}

}  // namespace benchmarks
