#include "benchmarks/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <string_view>

#include "benchmarks/columns.h"
#include "benchmarks/statistics.h"

namespace benchmarks {
namespace {

constexpr std::size_t kLongestReason = 45;

// ---- What a case says -----------------------------------------------------------------------

const AxisValue* findAxis(const CaseResult& result, const std::string& pointer) {
    const auto axis = std::ranges::find(result.axes, pointer, &AxisValue::pointer);
    return axis == result.axes.end() ? nullptr : &*axis;
}

// Absent if no sample is finite.
std::optional<double> medianOf(const Metric& metric) {
    std::vector<double> samples = metric.samples;
    std::erase_if(samples, [](double value) { return !std::isfinite(value); });
    if (samples.empty()) return {};
    return summarize(samples).median;
}

std::string medianCell(const CaseResult& result, const std::string& name) {
    const auto metric = std::ranges::find(result.metrics, name, &Metric::name);
    const auto median = metric == result.metrics.end() ? std::nullopt : medianOf(*metric);
    return median ? shortNumber(*median) : "-";
}

std::string countCell(const CaseResult& result, const std::string& name) {
    for (const auto& [count_name, count] : result.counts)
        if (count_name == name) return std::to_string(count);
    return "-";
}

// The first line, cut at a word.
std::string shortened(const std::string& reason) {
    const std::string first = reason.substr(0, reason.find('\n'));
    if (first.size() <= kLongestReason) return first;
    const std::size_t space = first.rfind(' ', kLongestReason);
    return first.substr(0, space == std::string::npos ? kLongestReason : space) + "...";
}

std::string statusCell(const CaseResult& result) {
    std::string text = statusName(result.status);
    if (const std::size_t warnings = result.trust.warnings.size(); warnings > 0)
        text += ", " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
    return result.reason.empty() ? text : text + ": " + shortened(result.reason);
}

// ---- Columns --------------------------------------------------------------------------------

// Pointers of the axes that have more than one value in the report, in the sweep's order.
std::vector<std::string> varyingAxes(const std::vector<CaseResult>& cases) {
    std::vector<std::string> varying;
    if (cases.empty()) return varying;
    for (const AxisValue& axis : cases.front().axes) {
        std::set<std::string> values;
        for (const CaseResult& result : cases)
            if (const AxisValue* const mine = findAxis(result, axis.pointer))
                values.insert(mine->value);
        if (values.size() > 1) varying.push_back(axis.pointer);
    }
    return varying;
}

// "pass.strands.time" -> "strands"; empty for other metrics.
std::string passOf(std::string_view metric) {
    constexpr std::string_view kBefore = "pass.", kAfter = ".time";
    if (!metric.starts_with(kBefore) || !metric.ends_with(kAfter)) return {};
    return std::string(
        metric.substr(kBefore.size(), metric.size() - kBefore.size() - kAfter.size()));
}

std::vector<std::string> passes(const std::vector<CaseResult>& cases) {
    std::vector<std::string> names;
    for (const CaseResult& result : cases)
        for (const Metric& metric : result.metrics)
            if (const std::string pass = passOf(metric.name);
                !pass.empty() && medianOf(metric) && std::ranges::find(names, pass) == names.end())
                names.push_back(pass);
    return names;
}

template <class Cell>
Column column(std::string title, const std::vector<CaseResult>& cases, Cell&& cell) {
    Column column{.title = std::move(title)};
    for (const CaseResult& result : cases) column.cells.push_back(cell(result));
    return column;
}

std::vector<Column> columns(const std::vector<CaseResult>& cases) {
    std::vector<Column> all;
    const std::vector<std::string> pointers = varyingAxes(cases);
    const std::vector<std::string> labels = axisLabels(pointers);
    for (std::size_t i = 0; i < pointers.size(); ++i)
        all.push_back(column(labels[i], cases, [&](const CaseResult& result) {
            const AxisValue* const axis = findAxis(result, pointers[i]);
            return axis ? valueLabel(axis->value) : std::string("-");
        }));
    if (pointers.empty()) {
        all.push_back(column("case", cases, [](const CaseResult& result) { return result.name; }));
        all.back().numeric = false;
    }
    const auto addMedian = [&](std::string title, const std::string& metric) {
        all.push_back(column(std::move(title), cases, [&](const CaseResult& result) {
            return medianCell(result, metric);
        }));
    };
    addMedian("fps", "fps");
    addMedian("frame ms", "frame.time");
    for (const std::string& pass : passes(cases)) addMedian(pass + " ms", "pass." + pass + ".time");
    if (std::ranges::any_of(cases, [](const CaseResult& result) {
            return std::ranges::find(result.metrics, "image.flip", &Metric::name) !=
                   result.metrics.end();
        }))
        addMedian("FLIP", "image.flip");
    all.push_back(
        column("strands", cases, [](const CaseResult& r) { return countCell(r, "strands"); }));
    all.push_back(column("status", cases, statusCell));
    all.back().numeric = false;
    return all;
}

// ---- Text -----------------------------------------------------------------------------------

std::string header(const Report& report) {
    const DeviceRecord& device = report.environment.device;
    std::string text = device.name.empty() ? "unknown device" : device.name;
    if (!device.type.empty()) text += " (" + device.type + ")";
    if (!device.driver.empty()) text += ", " + device.driver;
    if (!device.driver_version.empty()) text += ' ' + device.driver_version;
    if (!device.api_version.empty()) text += ", Vulkan " + device.api_version;
    if (!report.scene.path.empty()) text += "; " + report.scene.path;
    return text + '\n';
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

std::string table(const Report& report) {
    std::string text = header(report);
    const std::vector<Column> all = columns(report.cases);
    for (std::size_t row = 0; row <= report.cases.size(); ++row) text += columnsLine(all, row);
    return text;
}

}  // namespace benchmarks
