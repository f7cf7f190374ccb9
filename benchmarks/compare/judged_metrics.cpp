#include "benchmarks/compare/judged_metrics.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "benchmarks/sweep.h"
#include "engine/error.h"

namespace benchmarks {

bool isSoftwareDevice(const Json& environment) {
    const auto device = environment.find("device");
    return device != environment.end() && device->value("type", "") == "cpu";
}

Clock judgedClock(bool software_device, std::span<const MetricId> metrics) {
    return software_device && std::ranges::any_of(metrics, isOfProcessor) ? Clock::processor
                                                                          : Clock::wall;
}

MetricChoice metricsNamed(const std::string& regex) {
    if (regex.empty()) return {};
    try {
        return [matches = nameMatcher(regex)](const MetricId& id) { return matches(id.name()); };
    } catch (const engine::Error& error) {
        throw engine::Error("--metrics", error.what());
    }
}

MetricChoice timesBy(Clock clock) {
    return clock == Clock::processor ? isOfProcessor : isFrameOrPassTime;
}

Judgement judgementOf(const MetricChoice& chosen, const MetricReading& a, const MetricReading& b) {
    if (!chosen(a.id) || a.better == Better::neither || a.unit != b.unit)
        return Judgement::not_wanted;
    if (a.unit == "ms" && std::max(a.median, b.median) < kShortestTime) return Judgement::too_short;
    return Judgement::judged;
}

double costOf(const Metric& metric, double value) {
    return metric.better == Better::higher ? 1.0 / value : value;
}

}  // namespace benchmarks
