#include "benchmarks/report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/backends.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/scene/axis.h"

namespace benchmarks::report {
namespace {

// ---- Columns of a table -------------------------------------------------------------------------

std::string padded(const std::string& text, std::size_t width, bool right) {
    const std::string space(width - std::min(width, text.size()), ' ');
    return right ? space + text : text + space;
}

}  // namespace

std::string columnsLine(const std::vector<Column>& columns, std::size_t row) {
    std::string text;
    for (const Column& column : columns) {
        std::size_t width = column.title.size();
        for (const std::string& cell : column.cells) width = std::max(width, cell.size());
        const std::string& cell = row == 0 ? column.title : column.cells[row - 1];
        text += (&column == &columns.front() ? "" : "  ") + padded(cell, width, column.numeric);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + '\n';
}

namespace {

constexpr std::size_t kLongestReason = 45;

// ---- Cells of a case ----------------------------------------------------------------------------

// The member's value; null where it is absent.
const scene::Json& member(const scene::Json& object, const std::string& name) {
    static const scene::Json absent;
    const auto found = object.find(name);
    return found == object.end() ? absent : *found;
}

// Empty where it is absent.
std::string text(const scene::Json& object, const std::string& name) {
    const scene::Json& value = member(object, name);
    return value.is_string() ? value.get<std::string>() : std::string();
}

std::string medianCell(const scene::Json& result, const MetricId& metric) {
    const scene::Json& median = member(member(member(result, "metrics"), metric.name()), "median");
    return median.is_number() ? shortNumber(median.get<double>()) : "-";
}

std::string countCell(const scene::Json& result, const std::string& name) {
    const scene::Json& count = member(member(result, "counts"), name);
    return count.is_number() ? count.dump() : "-";
}

// The first line, cut at a word.
std::string shortened(const std::string& reason) {
    const std::string first = reason.substr(0, reason.find('\n'));
    if (first.size() <= kLongestReason) return first;
    const std::size_t space = first.rfind(' ', kLongestReason);
    return first.substr(0, space == std::string::npos ? kLongestReason : space) + "...";
}

std::string statusCell(const scene::Json& result) {
    std::string cell = text(result, "status");
    if (const std::size_t warnings = member(member(result, "trust"), "warnings").size();
        warnings > 0)
        cell += ", " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
    const std::string reason = text(result, "reason");
    return reason.empty() ? cell : cell + ": " + shortened(reason);
}

// ---- Columns of a report ------------------------------------------------------------------------

// Pointers of the axes that have more than one value in the report, in the sweep's order.
std::vector<std::string> varyingAxes(const scene::Json& cases) {
    std::vector<std::string> pointers;
    std::map<std::string, std::set<std::string>> values;
    for (const scene::Json& result : cases)
        for (const auto& [pointer, value] : member(result, "axes").items()) {
            if (values[pointer].empty()) pointers.push_back(pointer);
            values[pointer].insert(value.dump());
        }
    std::erase_if(pointers, [&](const std::string& each) { return values[each].size() < 2; });
    return pointers;
}

std::vector<MetricId> passTimes(const scene::Json& cases) {
    std::vector<MetricId> times;
    for (const scene::Json& result : cases)
        for (const auto& [name, metric] : member(result, "metrics").items())
            if (const MetricId id = metricNamed(name);
                isPassTime(id) && std::ranges::find(times, id) == times.end())
                times.push_back(id);
    return times;
}

template <class Cell>
Column column(std::string title, const scene::Json& cases, Cell&& cell) {
    Column column{.title = std::move(title)};
    for (const scene::Json& result : cases) column.cells.push_back(cell(result));
    return column;
}

// Whether what drew the strands is not to be seen from the axes.
bool drawnByAnother(const scene::Json& result) {
    const std::string name = text(member(result, "backend"), "name");
    return !name.empty() && text(member(result, "axes"), kBackendAxis) != name;
}

std::vector<Column> columns(const scene::Json& report) {
    std::vector<Column> all;
    const scene::Json& cases = member(report, "cases");
    std::vector<std::string> pointers;
    // A suite's scenes vary different things: only names tell their cases apart.
    if (member(member(member(report, "scene"), "document"), "suite").is_null())
        pointers = varyingAxes(cases);
    const std::vector<std::string> labels = scene::axisLabels(pointers);
    for (std::size_t i = 0; i < pointers.size(); ++i)
        all.push_back(column(labels[i], cases, [&](const scene::Json& result) {
            const scene::Json& value = member(member(result, "axes"), pointers[i]);
            return value.is_null() ? std::string("-") : scene::valueLabel(value);
        }));
    if (pointers.empty()) {
        all.push_back(
            column("case", cases, [](const scene::Json& result) { return text(result, "name"); }));
        all.back().numeric = false;
    }
    if (std::ranges::any_of(cases, drawnByAnother)) {
        all.push_back(column("drawn by", cases, [](const scene::Json& result) {
            const std::string name = text(member(result, "backend"), "name");
            return name.empty() ? std::string("-") : name;
        }));
        all.back().numeric = false;
    }
    const auto addMedian = [&](std::string title, const MetricId& metric) {
        all.push_back(column(std::move(title), cases, [&](const scene::Json& result) {
            return medianCell(result, metric);
        }));
    };
    addMedian("fps", ofFrame(Measured::rate));
    addMedian("frame ms", ofFrame(Measured::time));
    for (const MetricId& time : passTimes(cases)) addMedian(time.pass() + " ms", time);
    const MetricId flip = ofImage(Measured::flip);
    if (std::ranges::any_of(cases, [&](const scene::Json& result) {
            return !member(member(result, "metrics"), flip.name()).is_null();
        }))
        addMedian("FLIP", flip);
    all.push_back(column(
        "strands", cases, [](const scene::Json& result) { return countCell(result, "strands"); }));
    all.push_back(column("status", cases, statusCell));
    all.back().numeric = false;
    return all;
}

// ---- Table of a report --------------------------------------------------------------------------

std::string header(const scene::Json& report) {
    const scene::Json& device = member(member(report, "environment"), "device");
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

std::string table(const scene::Json& report) {
    std::string lines = header(report);
    const std::vector<Column> all = columns(report);
    for (std::size_t row = 0; row <= member(report, "cases").size(); ++row)
        lines += columnsLine(all, row);
    return lines;
}

// ---- Quantities ---------------------------------------------------------------------------------

std::string countText(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::size_t from_end = 3; from_end < text.size(); from_end += 4)
        text.insert(text.size() - from_end, 1, ',');
    return text;
}

std::string countText(std::uint64_t count, std::string_view what) {
    return countText(count) + ' ' + std::string(what) + (count == 1 ? "" : "s");
}

std::string plainNumber(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

LengthUnit readableUnit(double metres) {
    constexpr std::array<LengthUnit, 5> kUnits{
        {{"km", 1e3}, {"m", 1.0}, {"mm", 1e-3}, {"µm", 1e-6}, {"nm", 1e-9}}};
    if (metres == 0.0) return kUnits[1];
    for (const LengthUnit& unit : kUnits)
        if (std::abs(metres) >= unit.metres) return unit;
    return kUnits.back();
}

std::string lengthText(double metres) {
    const LengthUnit unit = readableUnit(metres);
    return shortNumber(metres / unit.metres) + ' ' + std::string(unit.symbol);
}

std::string sizeText(std::uint64_t bytes) {
    constexpr std::array<const char*, 4> kUnits{"bytes", "kB", "MB", "GB"};
    std::size_t unit = 0;
    double size = static_cast<double>(bytes);
    for (; size >= 999.5 && unit + 1 < kUnits.size(); ++unit) size /= 1000.0;
    return (unit == 0 ? std::to_string(bytes) : shortNumber(size)) + ' ' + kUnits[unit];
}

}  // namespace benchmarks::report
