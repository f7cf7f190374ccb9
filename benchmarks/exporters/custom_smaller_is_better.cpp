#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"

namespace benchmarks {

std::string customSmallerIsBetter(const Json& report) {
    Json entries = Json::array();
    for (const Reading& reading : readings(report)) {
        const MetricReading& metric = reading.metric;
        if (!metric.isTime() && metric.unit != "B") continue;
        Json entry = {
            {"name", benchmarkName(reading)}, {"unit", metric.unit}, {"value", metric.median}};
        if (reading.statistics->at("samples").size() > 1)
            entry["range"] = "± " + reading.statistics->at("mad").dump();
        entries.push_back(std::move(entry));
    }
    return documentText(entries);
}

}  // namespace benchmarks
