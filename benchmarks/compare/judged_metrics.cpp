#include "benchmarks/compare/judged_metrics.h"

#include <algorithm>
#include <string_view>

#include <nlohmann/json.hpp>

#include "benchmarks/hint.h"
#include "benchmarks/sweep.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

std::function<bool(const std::string&)> matcher(const std::string& regex) {
    try {
        return nameMatcher(regex);
    } catch (const engine::Error& error) {
        throw engine::Error("--metrics", error.what());
    }
}

}  // namespace

bool isOfProcessor(const std::string& name) {
    return (name.starts_with("frame.") || name.starts_with("pass.")) &&
           (name.ends_with(".cpu.time") || name.ends_with(".instructions"));
}

MetricReading readMetric(const std::string& name, const Json& metric) {
    MetricReading reading{.name = name, .unit = {}, .mode = {}, .hint = {}};
    reading.unit = metric.at("unit").get<std::string>();
    reading.mode = metric.value("mode", "");
    reading.hint = metric.value("hint", hintOf(name, reading.unit));
    reading.median = metric.at("median").get<double>();
    if (const auto interval = metric.find("interval"); interval != metric.end()) {
        reading.lower = interval->at("lower").get<double>();
        reading.upper = interval->at("upper").get<double>();
    }
    return reading;
}

bool isSoftwareDevice(const Json& environment) {
    const auto device = environment.find("device");
    return device != environment.end() && device->value("type", "") == "cpu";
}

Clock judgedClock(bool software_device, std::span<const std::string> names) {
    return software_device && std::ranges::any_of(names, isOfProcessor) ? Clock::processor
                                                                        : Clock::wall;
}

JudgedMetrics::JudgedMetrics(const std::string& regex, Clock clock)
    : chosen_(!regex.empty()), clock_(clock), matches_(matcher(regex)) {}

bool JudgedMetrics::wants(const std::string& name) const {
    if (chosen_) return matches_(name);
    if (clock_ == Clock::processor) return isOfProcessor(name);
    return name == "frame.time" ||
           (name.starts_with("pass.") && name.ends_with(".time") && !isOfProcessor(name));
}

Judgement JudgedMetrics::judge(const MetricReading& a, const MetricReading& b) const {
    if (!wants(a.name) || a.hint.empty() || a.unit != b.unit) return Judgement::not_wanted;
    if (a.unit == "ms" && std::max(a.median, b.median) < kShortestTime) return Judgement::too_short;
    return Judgement::judged;
}

double costOf(const MetricReading& metric) {
    return metric.hint == "higher" ? 1.0 / metric.median : metric.median;
}

}  // namespace benchmarks
