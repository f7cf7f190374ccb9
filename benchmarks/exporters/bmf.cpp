#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"

namespace benchmarks {
namespace {

// Of bencher's own measures, `latency` is in ns and smaller is better, `throughput` in operations
// per second and larger is better. Others are made when they first come.
struct Measure {
    std::string name;
    double scale;
};

Measure measureOf(const Metric& metric) {
    if (metric.isTime()) return {"latency", 1e6};
    if (metric.unit == "1/s") return {"throughput", 1.0};
    if (metric.unit == "B") return {"bytes", 1.0};
    return {metric.name(), 1.0};
}

}  // namespace

std::string bmf(const Json& report) {
    Json document = Json::object();
    for (const Reading& reading : readings(report)) {
        const Measure measure = measureOf(reading.metric);
        Json value = {{"value", reading.metric.median * measure.scale}};
        const Json& statistics = *reading.statistics;
        if (statistics.contains("first_quartile") && statistics.contains("third_quartile")) {
            value["lower_value"] = statistics["first_quartile"].get<double>() * measure.scale;
            value["upper_value"] = statistics["third_quartile"].get<double>() * measure.scale;
        }
        document[benchmarkName(reading)] = {{measure.name, std::move(value)}};
    }
    return documentText(document);
}

}  // namespace benchmarks
