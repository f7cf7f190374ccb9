#include "benchmarks/report.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "benchmarks/decide/median_interval.h"
#include "benchmarks/statistics.h"

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
    put(object, "id", device.id);
    put(object, "timestamp_valid_bits", device.timestamp_valid_bits);
    for (const auto& [name, limit] : device.limits) put(object["limits"], name.c_str(), limit);
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
    put(object, "flags", build.flags);
    put(object, "dirty", build.dirty);
    return object;
}

Json toJson(const SceneRecord& scene) {
    return {{"path", scene.path}, {"hash", scene.hash}, {"document", scene.document.json()}};
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
    put(object, "hint", std::string(betterName(metric.better)));
    put(object, "mode", std::string(modeName(metric.mode)));
    put(object, "median", summary.median);
    put(object, "mad", summary.mad);
    put(object, "mean", summary.mean);
    put(object, "minimum", summary.minimum);
    put(object, "first_quartile", summary.first_quartile);
    put(object, "third_quartile", summary.third_quartile);
    put(object, "maximum", summary.maximum);
    if (samples.size() > 1) {
        put(object, "percentile_5", quantile(samples, 0.05));
        put(object, "percentile_95", quantile(samples, 0.95));
        put(object, "percentile_99", quantile(samples, 0.99));
        put(object, "effective_samples", effectiveSamples(samples));
        const MedianInterval interval = medianInterval(samples, 0.05, effectiveSamples(samples));
        if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
            object["interval"] = {
                {"lower", interval.lower},
                {"upper", interval.upper},
                {"confidence", interval.confidence}};
    }
    put(object, "relative_deviation", summary.relative_deviation);
    object["samples"] = std::move(samples);
    if (missing > 0) object["missing_samples"] = missing;
    return object;
}

Json toJson(const Sampling& sampling) {
    Json object = {
        {"mode", sampling.mode},
        {"rounds", sampling.rounds},
        {"warmup_rounds", sampling.warmup_rounds},
        {"throttled_rounds", sampling.throttled_rounds}};
    put(object, "seconds", sampling.seconds);
    put(object, "steady", sampling.steady);
    put(object, "precision", sampling.precision);
    return object;
}

Json toJson(const Conditions& conditions) {
    Json object = Json::object();
    put(object, "clock_mhz", conditions.clock_mhz);
    put(object, "base_clock_mhz", conditions.base_clock_mhz);
    put(object, "memory_clock_mhz", conditions.memory_clock_mhz);
    put(object, "temperature", conditions.temperature);
    put(object, "steal", conditions.steal);
    put(object, "other_load", conditions.other_load);
    if (!conditions.throttle_reasons.empty())
        object["throttle_reasons"] = conditions.throttle_reasons;
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
        if (Json value = toJson(metric); !value.is_null())
            metrics[metric.name()] = std::move(value);
    Json& statistics = object["statistics"] = Json::object();
    for (const Statistic& statistic : result.statistics)
        statistics[statistic.name] = toJson(statistic);
    Json& counts = object["counts"] = Json::object();
    for (const auto& [name, count] : result.counts) counts[name] = count;
    Json& sampling = object["sampling"] = Json::array();
    for (const Sampling& each : result.sampling) sampling.push_back(toJson(each));
    object["conditions"] = toJson(result.conditions);
    object["trust"] = toJson(result.trust);
    put(object, "image_hash", result.image_hash);
    put(object, "state_hash", result.state_hash);
    put(object, "picture", result.picture);
}

Json toJson(const CaseResult& result) {
    Json object = {{"name", result.name}, {"axes", Json::object()}};
    for (const AxisValue& axis : result.axes) object["axes"][axis.pointer] = axis.value.json();
    put(object, "index", result.index);
    put(object, "order", result.order);
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
    put(object, "validation", environment.validation);
    return object;
}

Json headerJson(const ReportHeader& header) {
    Json object = Json::object();
    object["schema"] = kReportSchema;
    object["environment"] = environmentJson(header.environment);
    object["scene"] = toJson(header.scene);
    put(object, "case_count", header.case_count);
    put(object, "order_seed", header.order_seed);
    if (header.shard)
        object["shard"] = {{"index", header.shard->index}, {"count", header.shard->count}};
    return object;
}

Json caseJson(const CaseResult& result) { return toJson(result); }

Json assembledReport(Json header, std::vector<Json> cases, bool interrupted) {
    header["interrupted"] = interrupted;
    header["cases"] = std::move(cases);
    return header;
}

Json reportJson(const Report& report) {
    std::vector<Json> cases;
    for (const CaseResult& result : report.cases) cases.push_back(toJson(result));
    return assembledReport(headerJson(report), std::move(cases), report.interrupted);
}

std::string reportText(const Report& report) {
    // What drivers and commands say need not be UTF-8.
    return reportJson(report).dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace benchmarks
