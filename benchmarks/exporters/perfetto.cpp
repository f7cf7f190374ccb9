#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/exporters/exporters.h"
#include "benchmarks/exporters/readings.h"

namespace benchmarks {
namespace {

// Whole, so that slices that end together do so in the file too; the viewer counts in ns as well.
using Nanoseconds = std::int64_t;

constexpr double kNanosecondsPerMillisecond = 1e6;
constexpr double kNanosecondsPerMicrosecond = 1e3;

// A case is a process of the trace, its tracks are threads.
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

    Json take() { return std::move(events_); }

private:
    Json events_ = Json::array();
};

// Each frame is as long as it was and holds its parts one after another from its start; a part
// that ends after its frame, by some other clock, lengthens it. `parts` may lack samples: a pass
// that some frames have not is laid into the first ones.
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
    std::vector<Nanoseconds> samples;
    for (const double sample : metric.samples)
        samples.push_back(std::llround(sample * kNanosecondsPerMillisecond));
    return samples;
}

// None where there is no such metric.
std::vector<Nanoseconds> samplesOf(const std::vector<MetricReading>& metrics, const MetricId& id) {
    const MetricReading* const metric = findMetric(metrics, id);
    return metric ? samplesOf(*metric) : std::vector<Nanoseconds>();
}

void addCase(Trace& trace, int process, const Json& result) {
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

}  // namespace

std::string perfetto(const Json& report) {
    Trace trace;
    int process = 0;
    for (const Json& result : report.at("cases"))
        if (result.contains("metrics")) addCase(trace, ++process, result);
    return documentText(
        {{"traceEvents", trace.take()},
         {"displayTimeUnit", "ms"},
         {"otherData", {{"scene", report.at("scene").at("path")}}}});
}

}  // namespace benchmarks
