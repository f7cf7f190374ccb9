#include "benchmarks/exporters/readings.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace benchmarks {

std::vector<Reading> readings(const Json& report) {
    std::vector<Reading> found;
    for (const Json& result : report.at("cases")) {
        if (!result.contains("metrics")) continue;
        for (const auto& [name, metric] : result.at("metrics").items())
            found.push_back(
                {.case_name = result.at("name"),
                 .metric = MetricReading::fromReport(name, metric),
                 .statistics = &metric});
    }
    return found;
}

std::string benchmarkName(const Reading& reading) {
    return reading.case_name + '/' + reading.metric.name();
}

std::vector<std::string> axisPointers(const Json& report) {
    std::vector<std::string> pointers;
    for (const Json& result : report.at("cases"))
        for (const auto& [pointer, value] : result.at("axes").items())
            if (std::ranges::find(pointers, pointer) == pointers.end()) pointers.push_back(pointer);
    return pointers;
}

std::string cellText(const Json& object, const std::string& member) {
    const auto found = object.find(member);
    if (found == object.end()) return "";
    return found->is_string() ? found->get<std::string>() : found->dump();
}

std::string documentText(const Json& document) {
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks
