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

// "pass.strands.time" -> "strands", "cpu.record.time" -> "cpu.record".
std::string sliceName(std::string metric) {
    if (metric.starts_with("pass.")) metric.erase(0, 5);
    if (metric.ends_with(".time")) metric.erase(metric.size() - 5);
    return metric;
}

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

std::vector<Nanoseconds> samplesOf(const Json& metrics, const std::string& name) {
    std::vector<Nanoseconds> samples;
    if (!metrics.contains(name)) return samples;
    for (const Json& sample : metrics.at(name).at("samples"))
        samples.push_back(std::llround(sample.get<double>() * kNanosecondsPerMillisecond));
    return samples;
}

void addCase(Trace& trace, int process, const Json& result) {
    const Json& metrics = result.at("metrics");
    std::vector<Series> passes;
    std::string clock = "isolated";
    for (const auto& [name, metric] : metrics.items()) {
        if (!isPassTime(name)) continue;
        passes.push_back({sliceName(name), samplesOf(metrics, name)});
        clock = metric.value("mode", clock);
    }
    std::vector<Nanoseconds> frames = samplesOf(metrics, "frame.isolated.time");
    for (const Series& pass : passes) frames.resize(std::max(frames.size(), pass.samples.size()));
    trace.name(process, 0, "process_name", result.at("name"));
    trace.name(
        process, isolated, "thread_name",
        clock == "wall_clock" ? "passes by the CPU's clock" : "isolated passes");
    layFrames(trace, process, isolated, frames, passes);
    std::vector<Series> work;
    for (const char* name : {"cpu.record.time", "cpu.submit.time"})
        work.push_back({sliceName(name), samplesOf(metrics, name)});
    trace.name(process, overlapped, "thread_name", "CPU of overlapped frames");
    layFrames(trace, process, overlapped, samplesOf(metrics, "frame.time"), work);
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
