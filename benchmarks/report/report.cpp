#include "benchmarks/report/report.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/methods.h"
#include "benchmarks/report/statistics.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/instance.h"

namespace benchmarks::report {
namespace {

namespace fs = std::filesystem;

// ---- Members that are absent when unknown -------------------------------------------------------

void put(scene::Json& object, const char* key, const std::string& text) {
    if (!text.empty()) object[key] = text;
}

void put(scene::Json& object, const char* key, double number) {
    if (std::isfinite(number)) object[key] = number;
}

template <class Number>
void put(scene::Json& object, const char* key, const std::optional<Number>& number) {
    if (!number) return;
    if constexpr (std::is_floating_point_v<Number>)
        put(object, key, *number);
    else
        object[key] = *number;
}

// ---- Parts of a report --------------------------------------------------------------------------

scene::Json toJson(const DeviceRecord& device) {
    scene::Json object = scene::Json::object();
    put(object, "name", device.name);
    if (device.type) object["type"] = engine::deviceTypeName(*device.type);
    put(object, "driver", device.driver);
    put(object, "driver_version", device.driver_version);
    put(object, "api_version", device.api_version);
    put(object, "timestamp_period_ns", device.timestamp_period_ns);
    put(object, "id", device.id);
    put(object, "timestamp_valid_bits", device.timestamp_valid_bits);
    put(object, "board", device.board);
    put(object, "pci_address", device.pci_address);
    put(object, "power_limit_w", device.power_limit_w);
    for (const auto& [name, limit] : device.limits) put(object["limits"], name.c_str(), limit);
    return object;
}

scene::Json toJson(const HostRecord& host) {
    scene::Json object = scene::Json::object();
    put(object, "system", host.system);
    put(object, "processor", host.processor);
    put(object, "processor_count", host.processor_count);
    put(object, "memory_bytes", host.memory_bytes);
    return object;
}

scene::Json toJson(const BuildRecord& build) {
    scene::Json object = scene::Json::object();
    put(object, "version", build.version);
    put(object, "commit", build.commit);
    put(object, "compiler", build.compiler);
    put(object, "type", build.type);
    put(object, "flags", build.flags);
    put(object, "dirty", build.dirty);
    return object;
}

scene::Json toJson(const SceneRecord& scene) {
    return {{"path", scene.path}, {"hash", scene.hash}, {"document", scene.document.json()}};
}

// Returns null if no sample is finite. Samples of a probe keep their frames: there null stands for
// one that is not finite.
scene::Json toJson(const Metric& metric) {
    std::vector<double> samples = metric.samples;
    const std::size_t missing =
        std::erase_if(samples, [](double value) { return !std::isfinite(value); });
    if (samples.empty()) return nullptr;
    scene::Json written = samples;
    if (isProbe(metric.id) && missing > 0) {
        written = scene::Json::array();
        for (const double value : metric.samples)
            written.push_back(std::isfinite(value) ? scene::Json(value) : scene::Json());
    }
    const Summary summary = summarize(samples);
    scene::Json object = scene::Json::object();
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
    }
    if (samples.size() > 1 && !isProbe(metric.id)) {
        put(object, "effective_samples", effectiveSamples(samples));
        const MedianInterval interval = medianInterval(samples, 0.05, effectiveSamples(samples));
        if (std::isfinite(interval.lower) && std::isfinite(interval.upper))
            object["interval"] = {
                {"lower", interval.lower},
                {"upper", interval.upper},
                {"confidence", interval.confidence}};
    }
    put(object, "relative_deviation", summary.relative_deviation);
    object["samples"] = std::move(written);
    if (missing > 0) object["missing_samples"] = missing;
    return object;
}

scene::Json toJson(const Sampling& sampling) {
    scene::Json object = {
        {"mode", sampling.mode},
        {"rounds", sampling.rounds},
        {"warmup_rounds", sampling.warmup_rounds},
        {"throttled_rounds", sampling.throttled_rounds}};
    if (sampling.plays > 1) object["plays"] = sampling.plays;
    put(object, "seconds", sampling.seconds);
    put(object, "steady", sampling.steady);
    put(object, "precision", sampling.precision);
    return object;
}

scene::Json toJson(const Conditions& conditions) {
    scene::Json object = scene::Json::object();
    put(object, "clock_mhz", conditions.clock_mhz);
    put(object, "lowest_clock_mhz", conditions.lowest_clock_mhz);
    put(object, "low_clock_mhz", conditions.low_clock_mhz);
    put(object, "base_clock_mhz", conditions.base_clock_mhz);
    put(object, "memory_clock_mhz", conditions.memory_clock_mhz);
    put(object, "temperature", conditions.temperature);
    put(object, "power_w", conditions.power_w);
    put(object, "energy_source", conditions.energy_source);
    put(object, "load", conditions.load);
    put(object, "steal", conditions.steal);
    put(object, "other_load", conditions.other_load);
    if (!conditions.throttle_reasons.empty())
        object["throttle_reasons"] = conditions.throttle_reasons;
    return object;
}

scene::Json toJson(const Statistic& statistic) {
    scene::Json object = {{"measured", statistic.measured}};
    put(object, "expected", statistic.expected);
    put(object, "note", statistic.note);
    return object;
}

scene::Json toJson(const Trust& trust) {
    scene::Json object = scene::Json::object();
    put(object, "pass_sum_over_wall", trust.pass_sum_over_wall);
    put(object, "pass_sum_over_device", trust.pass_sum_over_device);
    put(object, "pass_sum_over_work", trust.pass_sum_over_work);
    put(object, "empty_submission", trust.empty_submission);
    put(object, "empty_pass", trust.empty_pass);
    put(object, "timestamps", trust.timestamps);
    put(object, "timestamp_rate", trust.timestamp_rate);
    object["warnings"] = trust.warnings;
    return object;
}

void put(scene::Json& object, const char* name, const BackendRecord& backend) {
    if (backend.name.empty()) return;
    scene::Json& made = object[name] = scene::Json::object();
    put(made, "name", backend.name);
    put(made, "variant", backend.variant);
    put(made, "reason", backend.reason);
}

scene::Json toJson(const WorstGuide& worst) {
    scene::Json object = {{"guide", worst.guide}, {"guides", worst.guides}};
    put(object, "value", worst.value);
    return object;
}

void put(scene::Json& object, const char* name, const std::optional<StartRecord>& start) {
    if (!start) return;
    scene::Json& made = object[name] = scene::Json::object();
    put(made, "from", start->from);
    put(made, "rest", start->rest);
    made["stretch"] = toJson(start->stretch);
    made["depth"] = toJson(start->depth);
    made["speed"] = toJson(start->speed);
    put(made, "stiffened", start->stiffened);
    put(made, "stiffest", start->stiffest);
    put(made, "unbalanced", start->unbalanced);
}

void putShaders(scene::Json& object, const CaseResult& result) {
    for (const ShaderRecord& shader : result.shaders) {
        scene::Json& record = object["shaders"].emplace_back(
            scene::Json{{"name", shader.name}, {"shaders", shader.shaders}});
        if (shader.subgroup_size > 0) record["subgroup_size"] = shader.subgroup_size;
        scene::Json& figures = record["figures"] = scene::Json::object();
        for (const auto& [name, value] : shader.figures) put(figures, name.c_str(), value);
    }
}

void putMeasured(scene::Json& object, const CaseResult& result) {
    scene::Json& metrics = object["metrics"] = scene::Json::object();
    for (const Metric& metric : result.metrics)
        if (scene::Json value = toJson(metric); !value.is_null())
            metrics[metric.name()] = std::move(value);
    scene::Json& statistics = object["statistics"] = scene::Json::object();
    for (const Statistic& statistic : result.statistics)
        statistics[statistic.name] = toJson(statistic);
    scene::Json& counts = object["counts"] = scene::Json::object();
    for (const auto& [name, count] : result.counts) counts[name] = count;
    scene::Json& sampling = object["sampling"] = scene::Json::array();
    for (const Sampling& each : result.sampling) sampling.push_back(toJson(each));
    object["conditions"] = toJson(result.conditions);
    object["trust"] = toJson(result.trust);
    put(object, "image_hash", result.image_hash);
    put(object, "state_hash", result.state_hash);
    put(object, "picture", result.picture);
}

scene::Json toJson(const CaseResult& result) {
    scene::Json object = {{"name", result.name}, {"axes", scene::Json::object()}};
    for (const scene::AxisValue& axis : result.axes)
        object["axes"][axis.pointer] = axis.value.json();
    put(object, "index", result.index);
    put(object, "order", result.order);
    object["status"] = statusName(result.status);
    put(object, "reason", result.reason);
    for (const ExtensionRecord& extension : result.extensions)
        object["extensions"].push_back(
            {{"pointer", extension.pointer},
             {"file", extension.file},
             {"sha256", extension.sha256}});
    if (result.memory_need)
        object["memory_need"] = {
            {"device", result.memory_need->device}, {"host", result.memory_need->host}};
    put(object, "backend", result.backend);
    put(object, "start", result.start);
    putShaders(object, result);
    // A case that was throttled throughout has failed, but its measurements show by how much.
    if (result.status == Status::ok || !result.metrics.empty())
        putMeasured(object, result);
    else if (!result.trust.warnings.empty())  // as by the validation layer before the failure
        object["trust"] = toJson(result.trust);
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

scene::Json environmentJson(const Environment& environment) {
    scene::Json object = scene::Json::object();
    object["device"] = toJson(environment.device);
    object["host"] = toJson(environment.host);
    object["build"] = toJson(environment.build);
    object["command"] = environment.command;
    put(object, "started", environment.started);
    object["seed"] = environment.seed;
    put(object, "validation", environment.validation);
    return object;
}

scene::Json headerJson(const ReportHeader& header) {
    scene::Json object = scene::Json::object();
    object["schema"] = kReportSchema;
    object["environment"] = environmentJson(header.environment);
    object["scene"] = toJson(header.scene);
    put(object, "case_count", header.case_count);
    put(object, "order_seed", header.order_seed);
    if (header.shard)
        object["shard"] = {{"index", header.shard->index}, {"count", header.shard->count}};
    return object;
}

scene::Json caseJson(const CaseResult& result) { return toJson(result); }

scene::Json assembledReport(scene::Json header, std::vector<scene::Json> cases, bool interrupted) {
    header["interrupted"] = interrupted;
    header["cases"] = std::move(cases);
    header["methods"] = methodsText(header);
    return header;
}

scene::Json reportJson(const Report& report) {
    std::vector<scene::Json> cases;
    for (const CaseResult& result : report.cases) cases.push_back(toJson(result));
    return assembledReport(headerJson(report), std::move(cases), report.interrupted);
}

namespace {

// ---- Samples beside a report --------------------------------------------------------------------

// The folder of the report itself, if the path is a link.
fs::path folderOf(const fs::path& report) { return fs::weakly_canonical(report).parent_path(); }

fs::path samplesFile(const fs::path& report) {
    return folderOf(report) / (fs::weakly_canonical(report).stem().string() + ".samples.jsonl");
}

using Key = std::pair<std::string, std::string>;  // case, metric

// Calls `visit` with the case's name, the metric's name and the metric, for each metric of a case.
template <class Case, class Visit>
void forEachMetric(Case& result, Visit visit) {
    const auto metrics = result.find("metrics");
    if (metrics == result.end()) return;
    for (auto& [name, metric] : metrics->items())
        visit(result.at("name").template get<std::string>(), name, metric);
}

// Replaces the member `old_key` by `value` under `key`, in the same place.
void replaceMember(scene::Json& object, const char* old_key, const char* key, scene::Json value) {
    scene::Json replaced = scene::Json::object();
    for (auto& [name, member] : object.items()) {
        if (name == old_key)
            replaced[key] = std::move(value);
        else
            replaced[name] = std::move(member);
    }
    object = std::move(replaced);
}

std::map<Key, scene::Json> readSamples(const fs::path& path) {
    std::map<Key, scene::Json> samples;
    std::istringstream file(engine::readFile(path));
    for (std::string text; std::getline(file, text);) {
        scene::Json line = scene::parseJson(text, path.string());
        samples[{line.at("case"), line.at("metric")}] = std::move(line.at("samples"));
    }
    return samples;
}

// A report and the samples of another run can lie together if a run was killed between writing
// them.
bool fits(const scene::Json& metric, const scene::Json& samples) {
    std::vector<double> numbers = samplesIn(samples);
    if (numbers.size() != metric.at("sample_count").get<std::size_t>()) return false;
    std::erase_if(numbers, [](double value) { return std::isnan(value); });
    return !numbers.empty() && summarize(numbers).median == metric.at("median").get<double>();
}

// Whether the metric's samples belong in a file beside the report.
bool isLarge(const scene::Json& metric) {
    const auto samples = metric.find("samples");
    return samples != metric.end() && samples->size() > kMostSamplesInReport;
}

// Moves the large samples of a case into lines of the samples file, and names the file in the case.
void moveSamplesOut(scene::Json& result, const fs::path& file, std::ostream& lines) {
    forEachMetric(
        result, [&](const std::string& name, const std::string& metric, scene::Json& value) {
            if (!isLarge(value)) return;
            const scene::Json line = {
                {"case", name}, {"metric", metric}, {"samples", std::move(value["samples"])}};
            lines << line.dump(-1, ' ', false, scene::Json::error_handler_t::replace) << '\n';
            replaceMember(value, "samples", "samples_file", file.filename().string());
            value["sample_count"] = line["samples"].size();
        });
}

// Removes the samples file of an earlier report at `path`.
void removeSamples(const fs::path& path) {
    std::error_code ignored;
    fs::remove(samplesFile(path), ignored);
}

// Undoes nameSamplesFile() for a report that was read from `path`. Throws engine::Error if the
// samples file is missing, damaged or of another report.
void moveSamplesIn(scene::Json& report, const fs::path& path) {
    std::map<std::string, std::map<Key, scene::Json>> files;
    const auto move_in = [&](const std::string& name, const std::string& metric,
                             scene::Json& value) {
        const auto member = value.find("samples_file");
        if (member == value.end()) return;
        const auto file_name = member->get<std::string>();
        const fs::path file = folderOf(path) / fs::path(file_name).filename();  // beside the report
        if (!fs::is_regular_file(file))
            throw engine::Error(path.string(), "its samples are missing: " + file.string());
        if (!files.contains(file_name)) files[file_name] = readSamples(file);
        scene::Json& samples = files[file_name][{name, metric}];
        if (!fits(value, samples))
            throw engine::Error(
                path.string(),
                file.string() + " belongs to another report: " + name + ", " + metric);
        value.erase("sample_count");
        replaceMember(value, "samples_file", "samples", std::move(samples));
    };
    const auto cases = report.find("cases");
    if (cases == report.end()) return;
    for (scene::Json& result : *cases) forEachMetric(result, move_in);
}

}  // namespace

// ---- Files --------------------------------------------------------------------------------------

bool isReadable(std::string_view schema) {
    const std::string_view mine = kReportSchema;
    return schema.starts_with(mine.substr(0, mine.find('.') + 1));
}

namespace {

// Returns nothing if the member is absent. Throws engine::Error if it is not an unsigned integer.
std::optional<std::size_t> countAt(const scene::Json& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end()) return std::nullopt;
    if (!found->is_number_unsigned())
        throw engine::Error('/' + std::string(member), "is not a count");
    return found->get<std::size_t>();
}

// Readers rely on a report's counts without a check. Throws engine::Error for impossible ones: a
// case index that is not below the case count, or that occurs twice, or a shard outside its count.
void checkCounts(const scene::Json& report) {
    const std::optional<std::size_t> count = countAt(report, "case_count");
    if (const auto shard = report.find("shard"); shard != report.end()) {
        const std::size_t index = countAt(*shard, "index").value_or(0);
        if (index < 1 || index > countAt(*shard, "count").value_or(0))
            throw engine::Error("/shard", "has an index outside [1, count]");
    }
    const auto cases = report.find("cases");
    if (cases == report.end()) return;
    std::set<std::size_t> seen;
    for (const scene::Json& each : *cases) {
        const std::optional<std::size_t> index = countAt(each, "index");
        if (!index) continue;  // from an older report
        if (count && *index >= *count)
            throw engine::Error(
                "/cases", "a case has the number " + std::to_string(*index) +
                              ", counted from 0, but there are " + std::to_string(*count) +
                              " cases");
        if (!seen.insert(*index).second)
            throw engine::Error("/cases", "two cases have the number " + std::to_string(*index));
    }
}

// ---- Corrections of older reports ---------------------------------------------------------------

constexpr int kFirstCorrect = 7;  // hairbench-report/1.7.0

// "hairbench-report/1.6.0" -> 6.
int minorVersion(const std::string& schema) {
    const std::size_t dot = schema.find('.');
    return dot == std::string::npos ? 0 : std::atoi(schema.c_str() + dot + 1);
}

// Returns the sum of the isolated passes' medians, each less one empty pass, ms. (Reports do not
// tell how often a pass ran in a frame.) Nothing if a pass was not isolated, or if an empty pass's
// time is unknown.
std::optional<double> netPassSum(const scene::Json& result, const scene::Json& metrics) {
    const auto trust = result.find("trust");
    if (trust == result.end() || !trust->contains("empty_pass")) return std::nullopt;
    const double empty = trust->at("empty_pass");
    std::optional<double> sum;
    for (const auto& [name, metric] : metrics.items()) {
        if (!name.starts_with("pass.") || !name.ends_with(".time") || name.ends_with(".cpu.time"))
            continue;
        if (metric.value("mode", "") != modeName(Mode::isolated)) return std::nullopt;
        sum = sum.value_or(0.0) + metric.at("median").get<double>() - empty;
    }
    return sum;
}

// Replaces the metric by a single value; removes it if there is none.
void correct(scene::Json& metrics, const MetricId& id, const std::optional<double>& value) {
    const std::string name = id.name();
    if (!metrics.contains(name)) return;
    if (value)
        metrics[name] = toJson(Metric(id, {*value}));
    else
        metrics.erase(name);
}

// Before 1.7.0, frame.overlap contained an empty pass for each isolated pass, and gpu.wait.time was
// the positive part of each frame's interval minus its device time, so that jitter raised it. Its
// mean is that of the gaps between frames. Both follow from other metrics, but not their intervals.
void correctOlder(scene::Json& report) {
    if (minorVersion(report.at("schema")) >= kFirstCorrect || !report.contains("cases")) return;
    bool any = false;
    for (scene::Json& result : report["cases"]) {
        const auto metrics = result.find("metrics");
        if (metrics == result.end() || !metrics->contains("frame.time")) continue;
        any = any || metrics->contains("frame.overlap") || metrics->contains("gpu.wait.time");
        const scene::Json& frame = metrics->at("frame.time");
        std::optional<double> overlap = netPassSum(result, *metrics);
        if (overlap) *overlap -= frame.at("median").get<double>();
        std::optional<double> wait;
        if (metrics->contains("frame.device.time"))
            wait = std::max(
                frame.at("mean").get<double>() -
                    metrics->at("frame.device.time").at("mean").get<double>(),
                0.0);
        correct(*metrics, ofFrame(Measured::overlap), overlap);
        correct(*metrics, ofGpu(Measured::wait_time), wait);
    }
    if (any)
        report["corrections"] =
            "frame.overlap and gpu.wait.time follow hairbench-report/1.7.0, from medians and "
            "means, "
            "without intervals; fps.low_* still include the wake-ups of the host";
}

}  // namespace

scene::Json readReport(const std::filesystem::path& path) {
    scene::Json report = scene::parseJson(engine::readFile(path), path.string());
    const auto schema = report.is_object() ? report.find("schema") : report.end();
    if (!report.is_object() || schema == report.end() || !schema->is_string())
        throw engine::Error(path.string(), "is not a report of 'hairbench run'");
    if (!isReadable(schema->get_ref<const std::string&>()))
        throw engine::Error(
            path.string(), schema->get<std::string>() + " is not " + std::string(kReportSchema));
    const auto damaged = [&](const std::string& reason) {
        return engine::Error(path.string(), "is damaged: " + reason);
    };
    try {
        checkCounts(report);
    } catch (const scene::Json::exception& error) {
        throw damaged(scene::jsonReason(error));
    } catch (const engine::Error& error) {
        throw damaged(error.what());
    }
    try {
        moveSamplesIn(report, path);  // its errors name the file at fault
    } catch (const scene::Json::exception& error) {
        throw damaged(scene::jsonReason(error));
    }
    try {
        correctOlder(report);
    } catch (const scene::Json::exception& error) {
        throw damaged(scene::jsonReason(error));
    }
    return report;
}

namespace {

// Returns the text of a value at that indentation level. Texts from drivers and commands need not
// be UTF-8.
std::string textOf(const scene::Json& value, int level) {
    const std::string text = value.dump(2, ' ', false, scene::Json::error_handler_t::replace);
    std::string indented;
    indented.reserve(text.size());
    for (const char c : text) {  // strings contain no line breaks
        indented += c;
        if (c == '\n') indented.append(2 * static_cast<std::size_t>(level), ' ');
    }
    return indented;
}

// Writes an object's text, member by member.
class ObjectText {
public:
    explicit ObjectText(std::ostream& stream) : stream_(stream) {}

    // Writes a member's name. The caller writes its value next.
    void key(const std::string& name) {
        stream_ << (is_empty_ ? "{\n  " : ",\n  ") << textOf(scene::Json(name), 1) << ": ";
        is_empty_ = false;
    }
    void member(const std::string& name, const scene::Json& value) {
        key(name);
        stream_ << textOf(value, 1);
    }
    void end() { stream_ << (is_empty_ ? "{}\n" : "\n}\n"); }

private:
    std::ostream& stream_;
    bool is_empty_ = true;
};

// Writes a report. `behind` returns the members after the cases, once the cases are written.
void writeReport(
    const scene::Json& before, const EachCase& each_case, LargeSamples large,
    const std::function<scene::Json()>& behind, const fs::path& path) {
    // No samples file lies beside something that is not a regular file, like /dev/stdout or a pipe.
    const bool is_file = engine::isReplaceable(path);
    const bool moves_samples = is_file && large == LargeSamples::some;
    const fs::path samples = moves_samples ? samplesFile(path) : fs::path();
    const auto write = [&](std::ostream& file, std::ostream* sample_lines) {
        ObjectText text(file);
        for (const auto& [name, value] : before.items()) text.member(name, value);
        text.key("cases");
        bool is_first = true;
        each_case([&](scene::Json result) {
            if (sample_lines) moveSamplesOut(result, samples, *sample_lines);
            file << (is_first ? "[\n    " : ",\n    ") << textOf(result, 2);
            is_first = false;
        });
        file << (is_first ? "[]" : "\n  ]");
        const scene::Json last = behind();
        for (const auto& [name, value] : last.items()) text.member(name, value);
        text.end();
    };
    engine::writeFileAtomically(path, [&](std::ostream& file) {
        if (!moves_samples) return write(file, nullptr);
        // Complete before the report is, so that nobody sees the report without its samples.
        engine::writeFileAtomically(samples, [&](std::ostream& lines) { write(file, &lines); });
    });
    if (is_file && !moves_samples) removeSamples(path);
}

}  // namespace

bool hasLargeSamples(const scene::Json& result) {
    bool any = false;
    forEachMetric(result, [&](const std::string&, const std::string&, const scene::Json& metric) {
        any = any || isLarge(metric);
    });
    return any;
}

void writeReport(const scene::Json& report, const fs::path& path) {
    scene::Json before = scene::Json::object(), behind = before;
    bool is_behind = false;
    for (const auto& [name, value] : report.items()) {
        if (name == "cases")
            is_behind = true;
        else
            (is_behind ? behind : before)[name] = value;
    }
    const EachCase each_case = [&](const auto& visit) {
        for (const scene::Json& result : report.at("cases")) visit(result);
    };
    const bool any_large = std::ranges::any_of(report.at("cases"), hasLargeSamples);
    writeReport(
        before, each_case, any_large ? LargeSamples::some : LargeSamples::none,
        [&] { return behind; }, path);
}

void writeReport(
    const scene::Json& header, const EachCase& each_case, LargeSamples large,
    const fs::path& path) {
    Methods methods(header);
    const EachCase counted = [&](const auto& visit) {
        each_case([&](scene::Json result) {
            methods.add(result);
            visit(std::move(result));
        });
    };
    const auto behind = [&] { return scene::Json{{"methods", methods.text()}}; };
    writeReport(header, counted, large, behind, path);
}

}  // namespace benchmarks::report
