#include "benchmarks/report/table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/report/metric.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/axis.h"
#include "engine/error.h"

namespace benchmarks::report {

// ---- Comparison of back ends --------------------------------------------------------------------

namespace {

constexpr double kAlpha = 0.05;
constexpr const char* kReferenceBackend = "tessellation";

// ---- Cases --------------------------------------------------------------------------------------

// Whether the field at this pointer changes the number of strands.
bool isOfSize(std::string_view pointer) {
    return pointer.starts_with("/groom/") || pointer.starts_with("/lod/") ||
           pointer == "/strands/density";
}

std::optional<std::string> backendOf(const scene::Json& result) {
    const auto value = result.at("axes").find(kBackendAxis);
    if (value == result.at("axes").end() || !value->is_string()) return std::nullopt;
    return value->get<std::string>();
}

// Returns the case's axes without the back end's and, where `sizes` is false, without those that
// change the number of strands.
scene::Json otherAxes(const scene::Json& result, bool sizes) {
    scene::Json axes = scene::Json::object();
    for (const auto& [pointer, value] : result.at("axes").items())
        if (pointer != kBackendAxis && (sizes || !isOfSize(pointer))) axes[pointer] = value;
    return axes;
}

const scene::Json* metricOf(const scene::Json& result, const MetricId& id) {
    const auto metrics = result.find("metrics");
    if (metrics == result.end()) return nullptr;
    const auto found = metrics->find(id.name());
    return found == metrics->end() ? nullptr : &*found;
}

std::optional<BackendTime> timeOf(const scene::Json& result) {
    if (const scene::Json* const whole = metricOf(result, ofStrands(Measured::time))) {
        BackendTime time{.median = whole->at("median").get<double>()};
        if (const auto interval = whole->find("interval"); interval != whole->end()) {
            time.lower = interval->at("lower").get<double>();
            time.upper = interval->at("upper").get<double>();
            time.confidence = interval->at("confidence").get<double>();
        }
        return time;
    }
    const scene::Json* const strands = metricOf(result, ofPass("strands", Measured::time));
    if (!strands) return std::nullopt;
    BackendTime time{.median = strands->at("median").get<double>()};
    for (const char* pass : kBeforeStrands)
        if (const scene::Json* const other = metricOf(result, ofPass(pass, Measured::time)))
            time.median += other->at("median").get<double>();
    return time;
}

std::optional<BackendPoint> pointOf(const scene::Json& result) {
    const std::optional<BackendTime> time = timeOf(result);
    const auto counts = result.find("counts");
    if (!time || counts == result.end() || !counts->contains("strands")) return std::nullopt;
    BackendPoint point{
        .name = result.at("name").get<std::string>(),
        .strands = counts->at("strands").get<double>(),
        .time = *time};
    if (!(point.strands > 0.0 && point.time.median > 0.0)) return std::nullopt;
    return point;
}

// ---- Lines and ratios ---------------------------------------------------------------------------

std::optional<PowerLaw> lawOf(const std::vector<BackendPoint>& points) {
    std::vector<double> strands;
    std::vector<double> times;
    for (const BackendPoint& point : points) {
        strands.push_back(point.strands);
        times.push_back(point.time.median);
    }
    if (std::set<double>(strands.begin(), strands.end()).size() < 2) return std::nullopt;
    return fitPowerLaw(strands, times, kAlpha);
}

std::vector<BackendLine> linesOf(const scene::Json& cases) {
    std::vector<BackendLine> lines;
    std::vector<scene::Json> keys;
    for (const scene::Json& result : cases) {
        const std::optional<std::string> backend = backendOf(result);
        const std::optional<BackendPoint> point = pointOf(result);
        if (!backend || !point) continue;
        const scene::Json held = otherAxes(result, false);
        scene::Json key = {*backend, held};
        const auto found = std::ranges::find(keys, key);
        const auto place = static_cast<std::size_t>(found - keys.begin());
        if (found == keys.end()) {
            keys.push_back(std::move(key));
            BackendLine line{.backend = *backend};
            for (const auto& [pointer, value] : held.items())
                line.held.emplace_back(pointer, scene::Document(value));
            lines.push_back(std::move(line));
        }
        lines[place].points.push_back(*point);
    }
    for (BackendLine& line : lines) {
        std::ranges::stable_sort(line.points, {}, &BackendPoint::strands);
        line.law = lawOf(line.points);
    }
    return lines;
}

BackendRatio ratioOf(const std::string& name, const BackendTime& time, const BackendTime& to) {
    BackendRatio ratio{.name = name, .ratio = time.median / to.median};
    if (!time.lower || !time.upper || !to.lower || !to.upper || !(*to.lower > 0.0)) return ratio;
    ratio.lower = *time.lower / *to.upper;
    ratio.upper = *time.upper / *to.lower;
    ratio.confidence = std::max(time.confidence + to.confidence - 1.0, 0.0);
    return ratio;
}

std::vector<BackendRatio> ratiosOf(const scene::Json& cases) {
    std::vector<BackendRatio> ratios;
    for (const scene::Json& result : cases) {
        const std::optional<BackendTime> time = timeOf(result);
        if (!backendOf(result) || !time) continue;
        const scene::Json axes = otherAxes(result, true);
        for (const scene::Json& other : cases) {
            if (backendOf(other) != kReferenceBackend || otherAxes(other, true) != axes) continue;
            const std::optional<BackendTime> to = timeOf(other);
            if (to && to->median > 0.0)
                ratios.push_back(ratioOf(result.at("name").get<std::string>(), *time, *to));
            break;
        }
    }
    return ratios;
}

// ---- JSON ---------------------------------------------------------------------------------------

void addInterval(scene::Json& object, std::optional<double> lower, std::optional<double> upper) {
    if (!lower || !upper) return;
    object["lower"] = *lower;
    object["upper"] = *upper;
}

scene::Json toJson(const BackendLine& line) {
    scene::Json object = {
        {"backend", line.backend},
        {"held", scene::Json::object()},
        {"points", scene::Json::array()}};
    for (const auto& [pointer, value] : line.held) object["held"][pointer] = value.json();
    for (const BackendPoint& point : line.points) {
        scene::Json each = {
            {"case", point.name}, {"strands", point.strands}, {"time", point.time.median}};
        addInterval(each, point.time.lower, point.time.upper);
        object["points"].push_back(std::move(each));
    }
    if (line.law) {
        object["law"] = {{"exponent", line.law->exponent}, {"factor", line.law->factor}};
        if (std::isfinite(line.law->lower))
            addInterval(object["law"], line.law->lower, line.law->upper);
    }
    return object;
}

}  // namespace

std::optional<BackendFigures> compareBackends(const scene::Json& report) {
    const scene::Json& cases = report.at("cases");
    std::set<std::string> backends;
    for (const scene::Json& result : cases)
        if (std::optional<std::string> backend = backendOf(result)) backends.insert(*backend);
    if (backends.size() < 2) return std::nullopt;
    return BackendFigures{.lines = linesOf(cases), .ratios = ratiosOf(cases)};
}

scene::Json backendsJson(const BackendFigures& figures) {
    scene::Json object = {{"lines", scene::Json::array()}, {"ratios", scene::Json::object()}};
    for (const BackendLine& line : figures.lines) object["lines"].push_back(toJson(line));
    for (const BackendRatio& ratio : figures.ratios) {
        scene::Json each = {{"ratio", ratio.ratio}};
        addInterval(each, ratio.lower, ratio.upper);
        if (each.contains("lower")) each["confidence"] = ratio.confidence;
        object["ratios"][ratio.name] = std::move(each);
    }
    return object;
}

// ---- The table of a run -------------------------------------------------------------------------

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

CaseTable::CaseTable(const scene::Json& header) : header_(header) {}

// Puts the cell into the row of the case that is being added.
void CaseTable::put(Column& column, std::string cell) const {
    column.cells.resize(rows_, "-");
    column.cells.push_back(std::move(cell));
}

void CaseTable::add(const scene::Json& result) {
    for (const auto& [pointer, value] : member(result, "axes").items()) {
        auto axis = std::ranges::find(axes_, pointer, &AxisColumn::pointer);
        if (axis == axes_.end()) axis = axes_.insert(axis, {.pointer = pointer});
        axis->values.insert(value.dump());
        put(axis->column, value.is_null() ? "-" : scene::valueLabel(value));
    }
    for (const auto& [name, metric] : member(result, "metrics").items()) {
        const MetricId id = metricNamed(name);
        has_flip_ = has_flip_ || id == ofImage(Measured::flip);
        if (!isPassTime(id)) continue;
        auto pass = std::ranges::find(passes_, id, &PassColumn::time);
        if (pass == passes_.end())
            pass = passes_.insert(pass, {.column = {.title = id.pass() + " ms"}, .time = id});
        put(pass->column, medianCell(result, id));
    }
    put(names_, report::text(result, "name"));
    const std::string backend = report::text(member(result, "backend"), "name");
    put(backends_, backend.empty() ? "-" : backend);
    drawn_by_another_ = drawn_by_another_ || drawnByAnother(result);
    put(rates_, medianCell(result, ofFrame(Measured::rate)));
    put(frames_, medianCell(result, ofFrame(Measured::time)));
    const auto width = relativeHalfInterval(result);
    put(widths_, width ? shareText(*width) : "-");
    put(flips_, medianCell(result, ofImage(Measured::flip)));
    put(strands_, countCell(result, "strands"));
    const auto verdict = judgeCase(member(header_, "environment"), result);
    put(verdicts_, verdict ? verdictText(*verdict) : "-");
    put(statuses_, statusCell(result));
    ++rows_;
}

std::vector<Column> CaseTable::columns() const {
    std::vector<Column> all;
    std::vector<std::string> pointers;
    // The scenes of a suite vary different things, so only names tell their cases apart.
    if (member(member(member(header_, "scene"), "document"), "suite").is_null())
        for (const AxisColumn& axis : axes_)
            if (axis.values.size() > 1) {
                pointers.push_back(axis.pointer);
                all.push_back(axis.column);
            }
    const std::vector<std::string> labels = scene::axisLabels(pointers);
    for (std::size_t i = 0; i < labels.size(); ++i) all[i].title = labels[i];
    if (pointers.empty()) all.push_back(names_);
    if (drawn_by_another_) all.push_back(backends_);
    all.insert(all.end(), {rates_, frames_, widths_});
    for (const PassColumn& pass : passes_) all.push_back(pass.column);
    if (has_flip_) all.push_back(flips_);
    all.insert(all.end(), {strands_, verdicts_, statuses_});
    for (Column& column : all) column.cells.resize(rows_, "-");
    return all;
}

std::string CaseTable::text() const { return header(header_) + columnsText(columns()); }

std::string table(const scene::Json& report) {
    CaseTable table(report);
    for (const scene::Json& result : member(report, "cases")) table.add(result);
    return table.text();
}

}  // namespace benchmarks::report
