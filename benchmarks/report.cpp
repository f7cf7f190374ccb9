#include "benchmarks/report.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "benchmarks/statistics.h"
#include "engine/write_file.h"

namespace benchmarks {
namespace {

// ---- Members that are absent when unknown ---------------------------------------------------

void put(Json& object, const char* key, const std::string& text) {
    if (!text.empty()) object[key] = text;
}

void put(Json& object, const char* key, double number) {
    if (std::isfinite(number)) object[key] = number;
}

template <class Number>
void put(Json& object, const char* key, const std::optional<Number>& number) {
    if (!number) return;
    if constexpr (std::is_floating_point_v<Number>)
        put(object, key, *number);
    else
        object[key] = *number;
}

// ---- Parts ----------------------------------------------------------------------------------

Json toJson(const DeviceRecord& device) {
    Json object = Json::object();
    put(object, "name", device.name);
    put(object, "type", device.type);
    put(object, "driver", device.driver);
    put(object, "driver_version", device.driver_version);
    put(object, "api_version", device.api_version);
    put(object, "timestamp_period_ns", device.timestamp_period_ns);
    return object;
}

Json toJson(const HostRecord& host) {
    Json object = Json::object();
    put(object, "system", host.system);
    put(object, "processor", host.processor);
    put(object, "processor_count", host.processor_count);
    put(object, "memory_bytes", host.memory_bytes);
    return object;
}

Json toJson(const BuildRecord& build) {
    Json object = Json::object();
    put(object, "version", build.version);
    put(object, "commit", build.commit);
    put(object, "compiler", build.compiler);
    put(object, "type", build.type);
    return object;
}

Json toJson(const SceneRecord& scene) {
    return {{"path", scene.path}, {"hash", scene.hash}, {"document", Json::parse(scene.document)}};
}

// Null if there is no finite sample.
Json toJson(const Metric& metric) {
    std::vector<double> samples = metric.samples;
    const std::size_t missing =
        std::erase_if(samples, [](double value) { return !std::isfinite(value); });
    if (samples.empty()) return nullptr;
    const Summary summary = summarize(samples);
    Json object = Json::object();
    object["unit"] = metric.unit;
    put(object, "mode", metric.mode);
    put(object, "median", summary.median);
    put(object, "mad", summary.mad);
    put(object, "mean", summary.mean);
    put(object, "minimum", summary.minimum);
    put(object, "first_quartile", summary.first_quartile);
    put(object, "third_quartile", summary.third_quartile);
    put(object, "maximum", summary.maximum);
    put(object, "relative_deviation", summary.relative_deviation);
    object["samples"] = std::move(samples);
    if (missing > 0) object["missing_samples"] = missing;
    return object;
}

Json toJson(const Statistic& statistic) {
    Json object = {{"measured", statistic.measured}};
    put(object, "expected", statistic.expected);
    put(object, "note", statistic.note);
    return object;
}

Json toJson(const Trust& trust) {
    Json object = Json::object();
    put(object, "pass_sum_over_wall", trust.pass_sum_over_wall);
    object["warnings"] = trust.warnings;
    return object;
}

void putMeasured(Json& object, const CaseResult& result) {
    Json& metrics = object["metrics"] = Json::object();
    for (const Metric& metric : result.metrics)
        if (Json value = toJson(metric); !value.is_null()) metrics[metric.name] = std::move(value);
    Json& statistics = object["statistics"] = Json::object();
    for (const Statistic& statistic : result.statistics)
        statistics[statistic.name] = toJson(statistic);
    Json& counts = object["counts"] = Json::object();
    for (const auto& [name, count] : result.counts) counts[name] = count;
    object["trust"] = toJson(result.trust);
    put(object, "image_hash", result.image_hash);
    put(object, "state_hash", result.state_hash);
}

Json toJson(const CaseResult& result) {
    Json object = {{"name", result.name}, {"axes", Json::object()}};
    for (const AxisValue& axis : result.axes)
        object["axes"][axis.pointer] = Json::parse(axis.value);
    object["status"] = statusName(result.status);
    put(object, "reason", result.reason);
    if (result.status == Status::ok) putMeasured(object, result);
    return object;
}

}  // namespace

const char* statusName(Status status) {
    switch (status) {
    case Status::ok:
        return "ok";
    case Status::skipped:
        return "skipped";
    case Status::failed:
        return "failed";
    }
    return "failed";
}

Json environmentJson(const Environment& environment) {
    Json object = Json::object();
    object["device"] = toJson(environment.device);
    object["host"] = toJson(environment.host);
    object["build"] = toJson(environment.build);
    object["command"] = environment.command;
    put(object, "started", environment.started);
    object["seed"] = environment.seed;
    return object;
}

std::string reportText(const Report& report) {
    Json object = Json::object();
    object["schema"] = kReportSchema;
    object["environment"] = environmentJson(report.environment);
    object["scene"] = toJson(report.scene);
    object["interrupted"] = report.interrupted;
    Json& cases = object["cases"] = Json::array();
    for (const CaseResult& result : report.cases) cases.push_back(toJson(result));
    // What drivers and commands say need not be UTF-8.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void writeReport(const Report& report, const std::filesystem::path& path) {
    engine::writeFileAtomically(path, reportText(report));
}

}  // namespace benchmarks
