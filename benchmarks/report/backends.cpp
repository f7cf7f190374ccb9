#include "benchmarks/report/backends.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/metric.h"

namespace benchmarks::report {
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
        BackendTime time{.median = whole->at("median").get<double>(), .lower = {}, .upper = {}};
        if (const auto interval = whole->find("interval"); interval != whole->end()) {
            time.lower = interval->at("lower").get<double>();
            time.upper = interval->at("upper").get<double>();
            time.confidence = interval->at("confidence").get<double>();
        }
        return time;
    }
    const scene::Json* const strands = metricOf(result, ofPass("strands", Measured::time));
    if (!strands) return std::nullopt;
    BackendTime time{.median = strands->at("median").get<double>(), .lower = {}, .upper = {}};
    if (const scene::Json* const points = metricOf(result, ofPass("points", Measured::time)))
        time.median += points->at("median").get<double>();
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
            BackendLine line{.backend = *backend, .held = {}, .points = {}, .law = {}};
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
    BackendRatio ratio{.name = name, .ratio = time.median / to.median, .lower = {}, .upper = {}};
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

}  // namespace benchmarks::report
