#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"

namespace benchmarks {
namespace {

constexpr double kMicrosecondsPerMillisecond = 1000.0;

Json context(const Json& report) {
    const Json& environment = report.at("environment");
    Json context = Json::object();
    const auto take = [&](const char* name, const char* group, const char* member) {
        if (environment.at(group).contains(member)) context[name] = environment[group][member];
    };
    if (environment.contains("started")) context["date"] = environment["started"];
    if (!environment.at("command").empty()) context["executable"] = environment["command"][0];
    take("num_cpus", "host", "processor_count");
    context["caches"] = Json::array();  // bencher wants the member
    take("library_version", "build", "version");
    context["library_build_type"] =
        environment.at("build").value("type", "") == "Debug" ? "debug" : "release";
    context["json_schema_version"] = 1;
    take("device", "device", "name");
    take("driver", "device", "driver_version");
    return context;
}

}  // namespace

std::string gbench(const Json& report) {
    Json benchmarks = Json::array();
    for (const Reading& reading : readings(report)) {
        if (!reading.metric.isTime()) continue;
        const std::string name = benchmarkName(reading);
        const double time = reading.metric.median * kMicrosecondsPerMillisecond;
        benchmarks.push_back(
            {{"name", name},
             {"family_index", benchmarks.size()},
             {"per_family_instance_index", 0},
             {"run_name", name},
             {"run_type", "iteration"},
             {"repetitions", 1},
             {"repetition_index", 0},
             {"threads", 1},
             {"iterations", reading.statistics->at("samples").size()},
             {"real_time", time},
             {"cpu_time", time},
             {"time_unit", "us"}});
    }
    return documentText({{"context", context(report)}, {"benchmarks", benchmarks}});
}

}  // namespace benchmarks
