#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"

namespace benchmarks {

std::string customSmallerIsBetter(const Json& report) {
    Json entries = Json::array();
    for (const Reading& reading : readings(report)) {
        if (!isTime(reading) && reading.unit != "B") continue;
        Json entry = {
            {"name", benchmarkName(reading)}, {"unit", reading.unit}, {"value", reading.median}};
        if (reading.metric->at("samples").size() > 1)
            entry["range"] = "± " + reading.metric->at("mad").dump();
        entries.push_back(std::move(entry));
    }
    return documentText(entries);
}

}  // namespace benchmarks
