#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/scene/json.h"

namespace benchmarks::report {

// Returns a made-up report with the members that comparisons read.
inline scene::Json madeReport(const std::string& device_type = "discrete") {
    scene::Json report = {{"schema", "hairbench-report/1.1.0"}};
    report["environment"] = {
        {"device", {{"name", "Made up"}, {"type", device_type}}},
        {"host", {{"processor", "Abacus"}}},
        {"build", {{"version", "0.1.0"}, {"commit", "1a2b3c4d5e6f"}}},
        {"command", {"hairbench", "run"}},
        {"seed", 1}};
    report["scene"] = {
        {"path", "scenes/made.json"},
        {"hash", "0123456789abcdef"},
        {"document", scene::Json::object()}};
    report["cases"] = scene::Json::array();
    return report;
}

struct MadeMetric {
    std::string name;
    std::vector<double> samples;  // in any order that has the median in the middle
    std::string unit = "ms";
    std::string hint = "lower";
    std::string mode = "isolated";
};

inline scene::Json madeMetric(const MadeMetric& metric) {
    return {{"unit", metric.unit}, {"hint", metric.hint},
            {"mode", metric.mode}, {"median", metric.samples[metric.samples.size() / 2]},
            {"mad", 0.0},          {"samples", metric.samples}};
}

inline scene::Json madeCase(
    const std::string& name, const std::vector<MadeMetric>& metrics,
    const std::string& image_hash = "00000000000000aa",
    const std::string& state_hash = "00000000000000bb") {
    scene::Json result = {{"name", name}, {"axes", scene::Json::object()}, {"status", "ok"}};
    result["metrics"] = scene::Json::object();
    for (const MadeMetric& each : metrics) result["metrics"][each.name] = madeMetric(each);
    result["image_hash"] = image_hash;
    result["state_hash"] = state_hash;
    return result;
}

inline scene::Json failedCase(const std::string& name, const std::string& reason) {
    return {
        {"name", name}, {"axes", scene::Json::object()}, {"status", "failed"}, {"reason", reason}};
}

}  // namespace benchmarks::report
