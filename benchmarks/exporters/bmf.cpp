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

Measure measureOf(const Reading& reading) {
    if (isTime(reading)) return {"latency", 1e6};
    if (reading.unit == "1/s") return {"throughput", 1.0};
    if (reading.unit == "B") return {"bytes", 1.0};
    return {reading.name, 1.0};
}

}  // namespace

std::string bmf(const Json& report) {
    Json document = Json::object();
    for (const Reading& reading : readings(report)) {
        const Measure measure = measureOf(reading);
        Json value = {{"value", reading.median * measure.scale}};
        const Json& metric = *reading.metric;
        if (metric.contains("first_quartile") && metric.contains("third_quartile")) {
            value["lower_value"] = metric["first_quartile"].get<double>() * measure.scale;
            value["upper_value"] = metric["third_quartile"].get<double>() * measure.scale;
        }
        document[benchmarkName(reading)] = {{measure.name, std::move(value)}};
    }
    return documentText(document);
}

}  // namespace benchmarks
