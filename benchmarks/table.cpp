#include "benchmarks/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/axis.h"
#include "benchmarks/columns.h"
#include "benchmarks/metric.h"

namespace benchmarks {
namespace {

constexpr std::size_t kLongestReason = 45;

// ---- What a case says -----------------------------------------------------------------------

// The member's value; null where it is absent.
const Json& member(const Json& object, const std::string& name) {
    static const Json absent;
    const auto found = object.find(name);
    return found == object.end() ? absent : *found;
}

// Empty where it is absent.
std::string text(const Json& object, const std::string& name) {
    const Json& value = member(object, name);
    return value.is_string() ? value.get<std::string>() : std::string();
}

std::string medianCell(const Json& result, const MetricId& metric) {
    const Json& median = member(member(member(result, "metrics"), metric.name()), "median");
    return median.is_number() ? shortNumber(median.get<double>()) : "-";
}

std::string countCell(const Json& result, const std::string& name) {
    const Json& count = member(member(result, "counts"), name);
    return count.is_number() ? count.dump() : "-";
}

// The first line, cut at a word.
std::string shortened(const std::string& reason) {
    const std::string first = reason.substr(0, reason.find('\n'));
    if (first.size() <= kLongestReason) return first;
    const std::size_t space = first.rfind(' ', kLongestReason);
    return first.substr(0, space == std::string::npos ? kLongestReason : space) + "...";
}

std::string statusCell(const Json& result) {
    std::string cell = text(result, "status");
    if (const std::size_t warnings = member(member(result, "trust"), "warnings").size();
        warnings > 0)
        cell += ", " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
    const std::string reason = text(result, "reason");
    return reason.empty() ? cell : cell + ": " + shortened(reason);
}

// ---- Columns --------------------------------------------------------------------------------

// Pointers of the axes that have more than one value in the report, in the sweep's order.
std::vector<std::string> varyingAxes(const Json& cases) {
    std::vector<std::string> pointers;
    std::map<std::string, std::set<std::string>> values;
    for (const Json& result : cases)
        for (const auto& [pointer, value] : member(result, "axes").items()) {
            if (values[pointer].empty()) pointers.push_back(pointer);
            values[pointer].insert(value.dump());
        }
    std::erase_if(pointers, [&](const std::string& each) { return values[each].size() < 2; });
    return pointers;
}

std::vector<MetricId> passTimes(const Json& cases) {
    std::vector<MetricId> times;
    for (const Json& result : cases)
        for (const auto& [name, metric] : member(result, "metrics").items())
            if (const MetricId id = metricNamed(name);
                isPassTime(id) && std::ranges::find(times, id) == times.end())
                times.push_back(id);
    return times;
}

template <class Cell>
Column column(std::string title, const Json& cases, Cell&& cell) {
    Column column{.title = std::move(title)};
    for (const Json& result : cases) column.cells.push_back(cell(result));
    return column;
}

std::vector<Column> columns(const Json& report) {
    std::vector<Column> all;
    const Json& cases = member(report, "cases");
    std::vector<std::string> pointers;
    // A suite's scenes vary different things: only names tell their cases apart.
    if (member(member(member(report, "scene"), "document"), "suite").is_null())
        pointers = varyingAxes(cases);
    const std::vector<std::string> labels = axisLabels(pointers);
    for (std::size_t i = 0; i < pointers.size(); ++i)
        all.push_back(column(labels[i], cases, [&](const Json& result) {
            const Json& value = member(member(result, "axes"), pointers[i]);
            return value.is_null() ? std::string("-") : valueLabel(value);
        }));
    if (pointers.empty()) {
        all.push_back(
            column("case", cases, [](const Json& result) { return text(result, "name"); }));
        all.back().numeric = false;
    }
    const auto addMedian = [&](std::string title, const MetricId& metric) {
        all.push_back(column(std::move(title), cases, [&](const Json& result) {
            return medianCell(result, metric);
        }));
    };
    addMedian("fps", ofFrame(Measured::rate));
    addMedian("frame ms", ofFrame(Measured::time));
    for (const MetricId& time : passTimes(cases)) addMedian(time.pass() + " ms", time);
    const MetricId flip = ofImage(Measured::flip);
    if (std::ranges::any_of(cases, [&](const Json& result) {
            return !member(member(result, "metrics"), flip.name()).is_null();
        }))
        addMedian("FLIP", flip);
    all.push_back(
        column("strands", cases, [](const Json& result) { return countCell(result, "strands"); }));
    all.push_back(column("status", cases, statusCell));
    all.back().numeric = false;
    return all;
}

// ---- Text -----------------------------------------------------------------------------------

std::string header(const Json& report) {
    const Json& device = member(member(report, "environment"), "device");
    std::string line = text(device, "name");
    if (line.empty()) line = "unknown device";
    if (const std::string type = text(device, "type"); !type.empty()) line += " (" + type + ")";
    if (const std::string driver = text(device, "driver"); !driver.empty()) line += ", " + driver;
    if (const std::string version = text(device, "driver_version"); !version.empty())
        line += ' ' + version;
    if (const std::string api = text(device, "api_version"); !api.empty())
        line += ", Vulkan " + api;
    if (const std::string path = text(member(report, "scene"), "path"); !path.empty())
        line += "; " + path;
    return line + '\n';
}

}  // namespace

std::string shortNumber(double number) {
    const double size = std::abs(number);
    int decimals = 0;
    if (size > 0.0 && size < 100.0)
        decimals = std::min(6, 2 - static_cast<int>(std::floor(std::log10(size))));
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, number);
    return text;
}

std::string table(const Json& report) {
    std::string lines = header(report);
    const std::vector<Column> all = columns(report);
    for (std::size_t row = 0; row <= member(report, "cases").size(); ++row)
        lines += columnsLine(all, row);
    return lines;
}

}  // namespace benchmarks
