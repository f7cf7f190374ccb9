#include <span>

#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"

namespace benchmarks {
namespace {

constexpr const char* kMetricMembers[] = {"unit",   "mode",    "median",         "mad",
                                          "mean",   "minimum", "first_quartile", "third_quartile",
                                          "maximum"};

std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string line(const std::vector<std::string>& cells) {
    std::string text = field(cells.front());
    for (const std::string& cell : std::span(cells).subspan(1)) text += ',' + field(cell);
    return text + '\n';
}

}  // namespace

std::string csv(const Json& report) {
    const std::vector<std::string> pointers = axisPointers(report);
    std::vector<std::string> titles{"case"};
    titles.insert(titles.end(), pointers.begin(), pointers.end());
    titles.insert(titles.end(), {"status", "reason", "metric", "samples"});
    titles.insert(titles.end(), std::begin(kMetricMembers), std::end(kMetricMembers));
    std::string text = line(titles);

    const auto add = [&](const Json& result, const std::string& name, const Json& metric) {
        std::vector<std::string> cells{cellText(result, "name")};
        for (const std::string& pointer : pointers)
            cells.push_back(cellText(result.at("axes"), pointer));
        cells.push_back(cellText(result, "status"));
        cells.push_back(cellText(result, "reason"));
        cells.push_back(name);
        cells.push_back(name.empty() ? "" : std::to_string(metric.at("samples").size()));
        for (const char* member : kMetricMembers) cells.push_back(cellText(metric, member));
        text += line(cells);
    };
    for (const Json& result : report.at("cases")) {
        const Json metrics = result.value("metrics", Json::object());
        for (const auto& [name, metric] : metrics.items()) add(result, name, metric);
        if (metrics.empty()) add(result, "", Json::object());
    }
    return text;
}

}  // namespace benchmarks
