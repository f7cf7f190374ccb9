#include "benchmarks/report/exporters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/report/metric.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/axis.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"

namespace benchmarks::report {
namespace {

// ---- What formats take from a report ------------------------------------------------------------

// Exporters throw nlohmann's exception for a report that lacks a required member. exportReport()
// turns it into an engine::Error.

struct Reading {
    const scene::Json* result;  // the case, which must outlive this
    MetricReading metric;
    // The metric in the report, which must outlive this: statistics of the samples, in its unit.
    // Older reports lack some of them.
    const scene::Json* statistics;
};

// Returns every metric of every case that ran, in the report's order.
std::vector<Reading> readings(const scene::Json& report) {
    std::vector<Reading> found;
    for (const scene::Json& result : report.at("cases")) {
        if (!result.contains("metrics")) continue;
        for (const auto& [name, metric] : result.at("metrics").items())
            found.push_back(
                {.result = &result,
                 .metric = MetricReading::fromReport(name, metric),
                 .statistics = &metric});
    }
    return found;
}

// "<case>/<metric>", unique in a report.
std::string benchmarkName(const Reading& reading) {
    return reading.result->at("name").get<std::string>() + '/' + reading.metric.name();
}

// Returns the pointers of the axes of all cases, without duplicates.
std::vector<std::string> axisPointers(const scene::Json& report) {
    std::vector<std::string> pointers;
    for (const scene::Json& result : report.at("cases"))
        for (const auto& [pointer, value] : result.at("axes").items())
            if (std::ranges::find(pointers, pointer) == pointers.end()) pointers.push_back(pointer);
    return pointers;
}

// Returns the verdict on a case; nothing if it did not run.
std::optional<CaseVerdict> verdictOn(const scene::Json& report, const scene::Json& result) {
    return judgeCase(report.at("environment"), result);
}

std::size_t warningCount(const scene::Json& result) {
    const scene::Json::json_pointer place("/trust/warnings");
    return result.contains(place) ? result.at(place).size() : 0;
}

// Returns the member's text without quotes, or "" if it is absent.
std::string cellText(const scene::Json& object, const std::string& member) {
    const auto found = object.find(member);
    if (found == object.end()) return "";
    return found->is_string() ? found->get<std::string>() : found->dump();
}

// Returns the JSON with a line feed at its end. Texts from drivers need not be UTF-8.
std::string documentText(const scene::Json& document) {
    return document.dump(1, ' ', false, scene::Json::error_handler_t::replace) + '\n';
}

// ---- Bencher Metric Format ----------------------------------------------------------------------

// A measure of Bencher. Bencher knows `latency`, in ns, smaller is better, and `throughput`, in
// operations per second, larger is better. It adds others when it first sees them.
struct Measure {
    std::string name;
    double scale;
};

// All times are in ns. A time of which less is not always better is a measure of its own.
Measure measureOf(const Metric& metric) {
    if (metric.unit == "ms") return {metric.isTime() ? "latency" : metric.name(), 1e6};
    if (metric.unit == "ns" && metric.better == Better::lower) return {"latency", 1.0};
    if (metric.unit == "1/s") return {"throughput", 1.0};
    if (metric.unit == "B") return {"bytes", 1.0};
    return {metric.name(), 1.0};
}

// Exports Bencher Metric Format: times as `latency` in ns, rates as `throughput`, memory as
// `bytes`. The lower and upper values are the quartiles. The format has no texts: the verdict on a
// case is a benchmark `<case>/trust` with the measure `doubt`, 0 trusted, 1 doubtful, 2 untrusted.
std::string bmf(const scene::Json& report) {
    scene::Json document = scene::Json::object();
    for (const scene::Json& result : report.at("cases"))
        if (const auto verdict = verdictOn(report, result))
            document[result.at("name").get<std::string>() + "/trust"] = {
                {"doubt", {{"value", static_cast<int>(verdict->level)}}}};
    for (const Reading& reading : readings(report)) {
        const Measure measure = measureOf(reading.metric);
        scene::Json value = {{"value", reading.metric.median * measure.scale}};
        const scene::Json& statistics = *reading.statistics;
        if (statistics.contains("first_quartile") && statistics.contains("third_quartile")) {
            value["lower_value"] = statistics["first_quartile"].get<double>() * measure.scale;
            value["upper_value"] = statistics["third_quartile"].get<double>() * measure.scale;
        }
        document[benchmarkName(reading)] = {{measure.name, std::move(value)}};
    }
    return documentText(document);
}

// ---- CSV ----------------------------------------------------------------------------------------

constexpr const char* kMetricMembers[] = {"unit",   "mode",    "median",         "mad",
                                          "mean",   "minimum", "first_quartile", "third_quartile",
                                          "maximum"};
constexpr const char* kIntervalMembers[] = {"lower", "upper", "confidence"};

std::string field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

// Puts an apostrophe before a text that a spreadsheet would take for a formula, so that it stays a
// text (OWASP, CSV Injection). Names of scenes and files may come from anyone.
std::string textField(const std::string& text) {
    const bool is_formula =
        !text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string::npos;
    return is_formula ? '\'' + text : text;
}

// Returns the member as a table shows it. Numbers get no apostrophe.
std::string memberField(const scene::Json& object, const std::string& member) {
    const std::string text = cellText(object, member);
    const auto found = object.find(member);
    return found != object.end() && found->is_number() ? text : textField(text);
}

std::string line(const std::vector<std::string>& cells) {
    std::string text = field(cells.front());
    for (const std::string& cell : std::span(cells).subspan(1)) text += ',' + field(cell);
    return text + '\n';
}

// Exports CSV by RFC 4180, except that lines end with LF alone. It has a row for each metric of
// each case, with a column for each axis, and a row with the reason for each case without metrics.
// A field is empty if its value is unknown. Spreadsheets read no text as a formula.
std::string csv(const scene::Json& report) {
    const std::vector<std::string> pointers = axisPointers(report);
    std::vector<std::string> titles{"case"};
    for (const std::string& pointer : pointers) titles.push_back(textField(pointer));
    titles.insert(
        titles.end(), {"status", "reason", "warnings", "verdict", "reasons", "metric", "samples"});
    titles.insert(titles.end(), std::begin(kMetricMembers), std::end(kMetricMembers));
    titles.insert(titles.end(), std::begin(kIntervalMembers), std::end(kIntervalMembers));
    std::string text = line(titles);

    const auto add = [&](const scene::Json& result, const std::string& name,
                         const scene::Json& metric) {
        std::vector<std::string> cells{memberField(result, "name")};
        for (const std::string& pointer : pointers)
            cells.push_back(memberField(result.at("axes"), pointer));
        cells.push_back(memberField(result, "status"));
        cells.push_back(memberField(result, "reason"));
        const auto verdict = verdictOn(report, result);
        cells.push_back(verdict ? std::to_string(warningCount(result)) : "");
        cells.push_back(verdict ? trustedName(verdict->level) : "");
        cells.push_back(verdict ? textField(reasonsText(*verdict)) : "");
        cells.push_back(textField(name));
        cells.push_back(name.empty() ? "" : std::to_string(metric.at("samples").size()));
        for (const char* member : kMetricMembers) cells.push_back(memberField(metric, member));
        const scene::Json interval = metric.value("interval", scene::Json::object());
        for (const char* member : kIntervalMembers) cells.push_back(memberField(interval, member));
        text += line(cells);
    };
    for (const scene::Json& result : report.at("cases")) {
        const scene::Json metrics = result.value("metrics", scene::Json::object());
        for (const auto& [name, metric] : metrics.items()) add(result, name, metric);
        if (metrics.empty()) add(result, "", scene::Json::object());
    }
    return text;
}

// ---- github-action-benchmark --------------------------------------------------------------------

// Exports customSmallerIsBetter of github-action-benchmark: times and memory, with the median
// absolute deviation as the range and the verdict on the case as extra text.
std::string customSmallerIsBetter(const scene::Json& report) {
    scene::Json entries = scene::Json::array();
    for (const Reading& reading : readings(report)) {
        const MetricReading& metric = reading.metric;
        if (!metric.isTime() && metric.unit != "B") continue;
        scene::Json entry = {
            {"name", benchmarkName(reading)}, {"unit", metric.unit}, {"value", metric.median}};
        if (reading.statistics->at("samples").size() > 1)
            entry["range"] = "± " + reading.statistics->at("mad").dump();
        if (const auto verdict = verdictOn(report, *reading.result))
            entry["extra"] = verdictText(*verdict);
        entries.push_back(std::move(entry));
    }
    return documentText(entries);
}

// ---- google-benchmark ---------------------------------------------------------------------------

constexpr double kMicrosecondsPerMillisecond = 1000.0;

scene::Json context(const scene::Json& report) {
    const scene::Json& environment = report.at("environment");
    scene::Json context = scene::Json::object();
    const auto take = [&](const char* name, const char* group, const char* member) {
        if (environment.at(group).contains(member)) context[name] = environment[group][member];
    };
    if (environment.contains("started")) context["date"] = environment["started"];
    if (!environment.at("command").empty()) context["executable"] = environment["command"][0];
    take("num_cpus", "host", "processor_count");
    context["caches"] = scene::Json::array();  // Bencher requires the member
    take("library_version", "build", "version");
    context["library_build_type"] =
        environment.at("build").value("type", "") == "Debug" ? "debug" : "release";
    context["json_schema_version"] = 1;
    take("device", "device", "name");
    take("driver", "device", "driver_version");
    if (const std::string counts = verdictsOf(report).counts(); !counts.empty())
        context["trust"] = counts;
    return context;
}

// Returns the CPU time of the same work, ms: of all threads for a frame or a pass of a software
// device, otherwise of the host's thread for an overlapped frame. Returns nothing if it is unknown,
// and for a metric that is a CPU time itself.
std::optional<double> cpuTimeOf(const Reading& reading) {
    const MetricId& id = reading.metric.id;
    std::vector<MetricId> wanted;
    if (id.of == MetricOf::pass && id.what == Measured::time)
        wanted = {ofPass(id.part, Measured::cpu_time)};
    if (id.of == MetricOf::frame &&
        (id.what == Measured::time || id.what == Measured::isolated_time))
        wanted = {ofFrame(Measured::cpu_time)};
    if (id == ofFrame(Measured::time)) wanted.push_back(ofCpu(Measured::host_time));
    const scene::Json& metrics = reading.result->at("metrics");
    for (const MetricId& each : wanted)
        if (const auto found = metrics.find(each.name()); found != metrics.end())
            return found->at("median").get<double>();
    return std::nullopt;
}

// Exports google-benchmark's JSON with times only, because its readers take aggregates and counters
// for times. Each metric is its own benchmark, "<case>/<metric>", and the verdict on the case is
// its label. Its real time is the median, and its CPU time that of the same work. Some readers use
// only the CPU time, so where it is unknown it is the real time too.
std::string gbench(const scene::Json& report) {
    scene::Json benchmarks = scene::Json::array();
    for (const Reading& reading : readings(report)) {
        if (!reading.metric.isTime()) continue;
        const std::string name = benchmarkName(reading);
        const double time = reading.metric.median * kMicrosecondsPerMillisecond;
        const std::optional<double> cpu = cpuTimeOf(reading);
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
             {"cpu_time", cpu ? *cpu * kMicrosecondsPerMillisecond : time},
             {"time_unit", "us"}});
        if (const auto verdict = verdictOn(report, *reading.result))
            benchmarks.back()["label"] = verdictText(*verdict);
    }
    return documentText({{"context", context(report)}, {"benchmarks", benchmarks}});
}

// ---- Markdown -----------------------------------------------------------------------------------

// Escapes text for a table cell: no line breaks, and nothing that starts a column or markup,
// mentions a person or an issue, or becomes a link by itself ("https://", "www.", "a@b.c"; GitHub
// Flavored Markdown, section 6.9). GitHub looks for mentions and links after it has removed
// backslashes, so a zero-width space separates their parts.
std::string escaped(const std::string& text) {
    constexpr std::string_view kNoWidth = "&#8203;";
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const std::string_view rest = std::string_view(text).substr(i);
        if (rest.starts_with("://")) result += kNoWidth;
        if (std::string_view("\\`*_[]<>|#&~").find(c) != std::string_view::npos) result += '\\';
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
        const bool ends_www = c == '.' && i > 0 && (text[i - 1] == 'w' || text[i - 1] == 'W');
        if (c == '@' || c == '#' || ends_www) result += kNoWidth;
    }
    return result;
}

void addCell(std::string& line, const std::string& text) { line += ' ' + text + " |"; }

const MetricId kRate = ofFrame(Measured::rate);

// Returns frames per second, and the times of the frame and of each pass, in order of first
// occurrence.
std::vector<MetricId> columnMetrics(const scene::Json& report) {
    std::vector<MetricId> metrics;
    for (const Reading& reading : readings(report)) {
        const MetricId& id = reading.metric.id;
        const bool shown = id == kRate || isFrameOrPassTime(id);
        if (shown && std::ranges::find(metrics, id) == metrics.end()) metrics.push_back(id);
    }
    return metrics;
}

std::string columnTitle(const MetricId& metric) {
    if (metric == kRate) return "mean FPS";
    return (isPassTime(metric) ? metric.pass() : "frame") + " (ms)";
}

std::string aboutTheRun(const scene::Json& report) {
    const scene::Json& environment = report.at("environment");
    std::string text = "**" + escaped(cellText(report.at("scene"), "path")) + "**";
    for (const auto& [group, member] :
         {std::pair{"device", "name"},
          {"device", "driver"},
          {"device", "driver_version"},
          {"host", "processor"},
          {"build", "commit"}})
        if (const std::string value = cellText(environment.at(group), member); !value.empty())
            text += ", " + escaped(value);
    if (const std::string counts = verdictsOf(report).counts(); !counts.empty())
        text += ". " + counts;
    return text + ".\n\nTimes are medians; FPS is frames / all their time; ± is half the 95 % "
                  "interval of the frame's median.\n\n";
}

std::string statusText(const scene::Json& result) {
    const std::string reason = cellText(result, "reason");
    const std::size_t warnings = warningCount(result);
    return cellText(result, "status") +
           (warnings > 0 ? ", " + countText(warnings, "warning") : "") +
           (reason.empty() ? "" : ": " + reason);
}

// Empty without a frame time.
std::string frameSamplesText(const scene::Json& result) {
    const scene::Json::json_pointer place("/metrics/frame.time/samples");
    return result.contains(place) ? countText(result.at(place).size()) : std::string();
}

// Empty without an interval.
std::string frameIntervalText(const scene::Json& result) {
    const auto width = relativeHalfInterval(result);
    return width ? shareText(*width) : std::string();
}

// Exports a table in GitHub's Markdown with a row per case: axes, FPS, medians in ms, the frame
// time's interval and number of samples, verdict, status.
std::string markdown(const scene::Json& report) {
    const std::vector<std::string> pointers = axisPointers(report);
    const std::vector<MetricId> metrics = columnMetrics(report);
    std::string titles = "|";
    std::string rule = "|";
    for (const std::string& label : scene::axisLabels(pointers)) addCell(titles, escaped(label));
    for (const MetricId& metric : metrics) addCell(titles, escaped(columnTitle(metric)));
    for (const char* title : {"±", "samples", "trust", "status"}) addCell(titles, title);
    for (std::size_t i = 0; i < pointers.size(); ++i) rule += " --- |";
    for (std::size_t i = 0; i < metrics.size() + 2; ++i) rule += " ---: |";
    std::string text = aboutTheRun(report) + titles + '\n' + rule + " --- | --- |\n";
    for (const scene::Json& result : report.at("cases")) {
        std::string line = "|";
        for (const std::string& pointer : pointers)
            addCell(line, escaped(cellText(result.at("axes"), pointer)));
        std::vector<MetricReading> measured;
        if (result.contains("metrics")) measured = readMetrics(result);
        for (const MetricId& metric : metrics) {
            const MetricReading* const reading = findMetric(measured, metric);
            addCell(line, reading ? shortNumber(reading->median) : "");
        }
        addCell(line, frameIntervalText(result));
        addCell(line, frameSamplesText(result));
        const auto verdict = verdictOn(report, result);
        addCell(line, verdict ? escaped(verdictText(*verdict)) : "");
        addCell(line, escaped(statusText(result)));
        text += line + '\n';
    }
    return text;
}

// ---- Perfetto -----------------------------------------------------------------------------------

// Integers, so that slices with the same end have the same end in the file. The viewer also counts
// in ns.
using Nanoseconds = std::int64_t;

constexpr double kNanosecondsPerMillisecond = 1e6;
constexpr double kNanosecondsPerMicrosecond = 1e3;

// A case is a process of the trace, and its tracks are threads.
enum Track { isolated = 1, overlapped = 2 };

struct Series {
    std::string name;  // of the slices
    std::vector<Nanoseconds> samples;  // by frame
};

class Trace {
public:
    void name(int process, int track, const char* what, const std::string& name) {
        events_.push_back(
            {{"ph", "M"},
             {"name", what},
             {"pid", process},
             {"tid", track},
             {"args", {{"name", name}}}});
    }

    // Shows a text beside a process's name.
    void label(int process, const std::string& text) {
        events_.push_back(
            {{"ph", "M"},
             {"name", "process_labels"},
             {"pid", process},
             {"tid", 0},
             {"args", {{"labels", text}}}});
    }

    void
    slice(int process, int track, const std::string& name, Nanoseconds start, Nanoseconds length) {
        events_.push_back(
            {{"ph", "X"},
             {"name", name},
             {"cat", track == isolated ? "isolated" : "overlapped"},
             {"pid", process},
             {"tid", track},
             {"ts", static_cast<double>(start) / kNanosecondsPerMicrosecond},
             {"dur", static_cast<double>(length) / kNanosecondsPerMicrosecond}});
    }

    scene::Json take() { return std::move(events_); }

private:
    scene::Json events_ = scene::Json::array();
};

// Lays the frames one after another, each with its parts from its start. A frame has its measured
// length, or the sum of its parts if that is longer because they use another clock. `parts` may
// lack samples: a pass that some frames lack is put into the first frames.
void layFrames(
    Trace& trace, int process, Track track, const std::vector<Nanoseconds>& frames,
    const std::vector<Series>& parts) {
    Nanoseconds start = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Nanoseconds sum = 0;
        for (const Series& part : parts)
            if (i < part.samples.size()) sum += part.samples[i];
        const Nanoseconds length = std::max(frames[i], sum);
        trace.slice(process, track, "frame " + std::to_string(i), start, length);
        Nanoseconds at = start;
        for (const Series& part : parts) {
            if (i >= part.samples.size()) continue;
            trace.slice(process, track, part.name, at, part.samples[i]);
            at += part.samples[i];
        }
        start += length;
    }
}

std::vector<Nanoseconds> samplesOf(const MetricReading& metric) {
    constexpr double kLongest = 1e7;  // ms, about three hours: a million of these still fit in ns
    std::vector<Nanoseconds> samples;
    for (const double sample : metric.samples) {
        if (!(sample >= 0.0 && sample <= kLongest))
            throw engine::Error(metric.name(), "has a sample that is not the time of a frame");
        samples.push_back(std::llround(sample * kNanosecondsPerMillisecond));
    }
    return samples;
}

// Returns no samples if the metric is absent.
std::vector<Nanoseconds> samplesOf(const std::vector<MetricReading>& metrics, const MetricId& id) {
    const MetricReading* const metric = findMetric(metrics, id);
    return metric ? samplesOf(*metric) : std::vector<Nanoseconds>();
}

void addCase(Trace& trace, int process, const scene::Json& result) {
    const std::vector<MetricReading> metrics = readMetrics(result);
    std::vector<Series> passes;
    Mode clock = Mode::isolated;
    for (const MetricReading& metric : metrics) {
        if (!isPassTime(metric.id)) continue;
        passes.push_back({metric.id.pass(), samplesOf(metric)});
        if (metric.mode != Mode::none) clock = metric.mode;
    }
    std::vector<Nanoseconds> frames = samplesOf(metrics, ofFrame(Measured::isolated_time));
    for (const Series& pass : passes) frames.resize(std::max(frames.size(), pass.samples.size()));
    trace.name(process, 0, "process_name", result.at("name"));
    trace.name(
        process, isolated, "thread_name",
        clock == Mode::wall_clock ? "passes by the CPU's clock" : "isolated passes");
    layFrames(trace, process, isolated, frames, passes);
    const std::vector<Series> work{
        {"cpu.record", samplesOf(metrics, ofCpu(Measured::record_time))},
        {"cpu.submit", samplesOf(metrics, ofCpu(Measured::submit_time))}};
    trace.name(process, overlapped, "thread_name", "CPU of overlapped frames");
    layFrames(trace, process, overlapped, samplesOf(metrics, ofFrame(Measured::time)), work);
}

// Exports Chrome's trace events, which Perfetto opens. Each case has its isolated frames one after
// another with their passes, its overlapped frames with the CPU's work for each, and the verdict as
// a label.
std::string perfetto(const scene::Json& report) {
    Trace trace;
    int process = 0;
    for (const scene::Json& result : report.at("cases"))
        if (result.contains("metrics")) {
            addCase(trace, ++process, result);
            if (const auto verdict = verdictOn(report, result))
                trace.label(process, verdictText(*verdict));
        }
    return documentText(
        {{"traceEvents", trace.take()},
         {"displayTimeUnit", "ms"},
         {"otherData", {{"scene", report.at("scene").at("path")}}}});
}

// ---- Table of formats ---------------------------------------------------------------------------

constexpr Exporter kExporters[] = {
    {"csv", "comma-separated values: a row for each metric of each case", ".csv", csv},
    {"markdown", "a table for GitHub, a row for each case", ".md", markdown},
    {"gbench", "google-benchmark's JSON: times, for its compare.py and others", ".json", gbench},
    {"bmf", "Bencher Metric Format", ".json", bmf},
    {"customSmallerIsBetter", "for github-action-benchmark: times and memory", ".json",
     customSmallerIsBetter},
    {"perfetto", "Chrome's trace events: frames and passes", ".json", perfetto},
};

}  // namespace

std::span<const Exporter> exporters() { return kExporters; }

std::string exportReport(const scene::Json& report, std::string_view format) {
    const auto exporter = std::ranges::find(kExporters, format, &Exporter::name);
    if (exporter == std::end(kExporters)) {
        std::vector<std::string> names;
        for (const Exporter& each : kExporters) names.emplace_back(each.name);
        throw engine::Error(scene::unknownName("unknown format", format, names));
    }
    try {
        const auto schema = report.at("schema").get<std::string>();
        if (!isReadable(schema))
            throw engine::Error("/schema", schema + " is not " + kReportSchema);
        return exporter->write(report);
    } catch (const scene::Json::exception& error) {
        throw engine::Error("the report can't be converted", scene::jsonReason(error));
    }
}

}  // namespace benchmarks::report
