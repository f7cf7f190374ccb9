#include "benchmarks/report/table.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/backends.h"
#include "benchmarks/report/metric.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/axis.h"
#include "engine/shown_text.h"

namespace benchmarks::report {
namespace {

constexpr std::size_t kLongestReason = 45;

// ---- Cells of a case ----------------------------------------------------------------------------

// Returns the member's value, or null if it is absent.
const scene::Json& member(const scene::Json& object, const std::string& name) {
    static const scene::Json absent;
    const auto found = object.find(name);
    return found == object.end() ? absent : *found;
}

// Returns the member's text, empty if it is absent.
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

// Returns the first line, shortened at a word.
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

// Whether the axes do not show which back end drew the strands.
bool drawnByAnother(const scene::Json& result) {
    const std::string name = text(member(result, "backend"), "name");
    return !name.empty() && text(member(result, "axes"), kBackendAxis) != name;
}

// Collects the facts that decide the table's columns.
class CasesSeen {
public:
    void add(const scene::Json& result) {
        for (const auto& [pointer, value] : member(result, "axes").items()) {
            if (values_[pointer].empty()) pointers_.push_back(pointer);
            values_[pointer].insert(value.dump());
        }
        for (const auto& [name, metric] : member(result, "metrics").items()) {
            const MetricId id = metricNamed(name);
            if (isPassTime(id) && std::ranges::find(pass_times_, id) == pass_times_.end())
                pass_times_.push_back(id);
            has_flip_ = has_flip_ || id == ofImage(Measured::flip);
        }
        drawn_by_another_ = drawn_by_another_ || drawnByAnother(result);
    }

    // Returns the pointers of axes with more than one value in the report, in the sweep's order.
    std::vector<std::string> varyingAxes() const {
        std::vector<std::string> pointers = pointers_;
        std::erase_if(
            pointers, [&](const std::string& each) { return values_.at(each).size() < 2; });
        return pointers;
    }
    const std::vector<MetricId>& passTimes() const { return pass_times_; }
    bool hasFlip() const { return has_flip_; }
    bool anyDrawnByAnother() const { return drawn_by_another_; }

private:
    std::vector<std::string> pointers_;
    std::map<std::string, std::set<std::string>> values_;
    std::vector<MetricId> pass_times_;
    bool has_flip_ = false;
    bool drawn_by_another_ = false;
};

// Returns the table's columns with all their cells.
std::vector<Column> columns(const scene::Json& header, const EachCase& each_case) {
    CasesSeen seen;
    each_case([&](const scene::Json& result) { seen.add(result); });
    std::vector<Column> all;
    std::vector<std::function<std::string(const scene::Json& result)>> cells;
    enum class Cells { text, numbers };
    const auto add = [&](std::string title, Cells kind, auto&& cell) {
        all.push_back({.title = std::move(title), .numeric = kind == Cells::numbers});
        cells.emplace_back(std::forward<decltype(cell)>(cell));
    };
    std::vector<std::string> pointers;
    // The scenes of a suite vary different things, so only names tell their cases apart.
    if (member(member(member(header, "scene"), "document"), "suite").is_null())
        pointers = seen.varyingAxes();
    const std::vector<std::string> labels = scene::axisLabels(pointers);
    for (std::size_t i = 0; i < pointers.size(); ++i)
        add(labels[i], Cells::numbers, [pointer = pointers[i]](const scene::Json& result) {
            const scene::Json& value = member(member(result, "axes"), pointer);
            return value.is_null() ? std::string("-") : scene::valueLabel(value);
        });
    if (pointers.empty())
        add("case", Cells::text, [](const scene::Json& result) { return text(result, "name"); });
    if (seen.anyDrawnByAnother())
        add("drawn by", Cells::text, [](const scene::Json& result) {
            const std::string name = text(member(result, "backend"), "name");
            return name.empty() ? std::string("-") : name;
        });
    const auto addMedian = [&](std::string title, const MetricId& metric) {
        add(std::move(title), Cells::numbers,
            [metric](const scene::Json& result) { return medianCell(result, metric); });
    };
    addMedian("fps", ofFrame(Measured::rate));
    addMedian("frame ms", ofFrame(Measured::time));
    add("+-", Cells::numbers, [](const scene::Json& result) {
        const auto width = relativeHalfInterval(result);
        return width ? shareText(*width) : std::string("-");
    });
    for (const MetricId& time : seen.passTimes()) addMedian(time.pass() + " ms", time);
    if (seen.hasFlip()) addMedian("FLIP", ofImage(Measured::flip));
    add("strands", Cells::numbers,
        [](const scene::Json& result) { return countCell(result, "strands"); });
    add("trust", Cells::text, [&](const scene::Json& result) {
        const auto verdict = judgeCase(member(header, "environment"), result);
        return verdict ? verdictText(*verdict) : std::string("-");
    });
    add("status", Cells::text, statusCell);
    each_case([&](const scene::Json& result) {
        for (std::size_t i = 0; i < all.size(); ++i) all[i].cells.push_back(cells[i](result));
    });
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
    return engine::shownText(line) +
           "\nfps: frames / all their time; ms: medians; +-: half the 95 % interval of frame ms\n";
}

}  // namespace

std::string table(const scene::Json& report) {
    return table(report, [&](const auto& visit) {
        for (const scene::Json& result : member(report, "cases")) visit(result);
    });
}

std::string table(const scene::Json& report_header, const EachCase& each_case) {
    return header(report_header) + columnsText(columns(report_header, each_case));
}

}  // namespace benchmarks::report
