#pragma once

#include <array>
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/scene/json.h"

// Metrics of a case. This is the only place that builds a metric's name and takes it apart.
namespace benchmarks::report {

// The subject of a metric.
enum class MetricOf {
    frame,
    cpu,  // the host's work on overlapped frames
    gpu,  // the GPU's work on overlapped frames
    pass,  // one pass, by name
    image,  // the picture, against a reference
    memory,  // the device's memory
    strands,  // the pass strands with those of kBeforeStrands
    device,  // the device's speed, from a separate measurement
    shader,  // the code that the driver's compiler made of a shader
    probe,  // a quantity of the guides in each frame
    other,  // unknown here: from another program's report
};

// The passes that prepare the strands of one picture for the pass strands.
inline constexpr std::array kBeforeStrands{"points", "acceleration"};

// The measured quantity. results/README.md defines each.
enum class Measured {
    rate,
    low_1_percentile,
    low_1_mean,
    low_1_integral,
    low_0_1_percentile,
    low_0_1_mean,
    low_0_1_integral,
    device_low_1_percentile,
    device_low_1_mean,
    device_low_1_integral,
    device_low_0_1_percentile,
    device_low_0_1_mean,
    device_low_0_1_integral,
    time,
    device_time,
    first_time,
    isolated_time,
    overlap,
    cpu_time,
    instructions,
    cycles,
    energy,
    record_time,
    submit_time,
    wait_time,
    host_time,  // of the CPU
    rmse,
    psnr,
    ssim,
    flip,
    flip_tessellation,  // against the picture by tessellation
    flip_many_samples,  // against 64 samples per pixel
    allocated,  // all memory
    heap,
    purpose,
    transparency,
    bytes,  // that must be moved, by a model
    operations,  // that must be done, by a model
    limit,  // least time for both
    limit_share,
    time_per_point,
    time_per_sample,
    copy_bandwidth,
    arithmetic,
    registers,  // per invocation, and the next four
    scalar_registers,
    spills,  // registers kept in memory
    scalar_spills,
    scratch,
    waves,  // subgroups that a processor keeps at the same time
    code_size,
    shared_memory,
    latency,
    inverse_throughput,
    simulated_time,
    tip_displacement,
    groom_distance,
    length_error,
    kinetic_energy,
    gravitational_energy,
    elastic_energy,
    contacts,
    penetration,
    speed,
    bending,
    torsion,
    momentum,
    other,
};

enum class Better { neither, lower, higher };

// The mode in which a metric was timed. Metrics are never compared across modes.
enum class Mode {
    none,  // not timed in a mode
    overlapped,
    isolated,
    wall_clock,
    other,  // unknown here
};

// A kind of metric. Metrics of one kind differ only in their part.
struct MetricKind {
    MetricOf of;
    Measured what;
    std::string_view name;  // "pass.*.time": '*' stands for the part
    std::string_view unit;
    Better better;
};

// Returns all kinds except MetricOf::other.
std::span<const MetricKind> metricKinds();

// Identifies a metric. Two ids are equal exactly if their names are.
struct MetricId {
    MetricOf of = MetricOf::other;
    Measured what = Measured::other;
    // The pass, heap index, purpose of memory or kind of stage, without dots. For MetricOf::other,
    // the whole name. Otherwise empty.
    std::string part{};

    // "pass.strands.time". Asserts that metricKinds() has the pair of `of` and `what`.
    std::string name() const;

    // Returns the pass's name, empty for a metric of something else.
    std::string pass() const { return of == MetricOf::pass ? part : std::string(); }

    bool operator==(const MetricId&) const = default;
};

inline MetricId ofFrame(Measured what) { return {MetricOf::frame, what}; }
inline MetricId ofCpu(Measured what) { return {MetricOf::cpu, what}; }
inline MetricId ofGpu(Measured what) { return {MetricOf::gpu, what}; }
inline MetricId ofPass(std::string pass, Measured what) {
    return {MetricOf::pass, what, std::move(pass)};
}
inline MetricId ofImage(Measured what) { return {MetricOf::image, what}; }
inline MetricId ofStrands(Measured what, std::string stage = {}) {
    return {MetricOf::strands, what, std::move(stage)};
}
inline MetricId ofDevice(Measured what, std::string stage = {}) {
    return {MetricOf::device, what, std::move(stage)};
}
inline MetricId ofShader(std::string stages, Measured what) {
    return {MetricOf::shader, what, std::move(stages)};
}
inline MetricId ofMemory(Measured what, std::string part = {}) {
    return {MetricOf::memory, what, std::move(part)};
}

// Returns the metric of that name in a report; MetricOf::other for an unknown name.
MetricId metricNamed(std::string_view name);

// Whether the metric is a probe of guides, which has no noise.
bool isProbe(const MetricId& id);

// Whether it is the time of a pass, by the wall clock or by timestamps.
bool isPassTime(const MetricId& id);

// Whether it is the time of a whole frame or of a pass, by the wall clock or by timestamps.
bool isFrameOrPassTime(const MetricId& id);

// Whether it is the CPU time or the instructions of a frame or a pass.
bool isOfProcessor(const MetricId& id);

// Whether it is a cost of a frame or a pass: time, CPU time or instructions.
bool isFrameOrPassCost(const MetricId& id);

// Whether `id` is a metric of a frame or a pass and measures the same quantity as `other`.
bool isSameOfFrameOrPass(const MetricId& id, const MetricId& other);

// Samples of one quantity. Its unit and better direction follow from its id, or come from the
// report that it was read from.
struct Metric {
    MetricId id;
    std::string unit;  // "ms", "1/s", "B"
    Better better = Better::neither;
    Mode mode = Mode::none;
    std::vector<double> samples;  // values that are not finite count as missing

    Metric() = default;
    Metric(MetricId id, std::vector<double> samples, Mode mode = Mode::none);

    std::string name() const { return id.name(); }

    // Whether it is a duration of which less is better. Excludes differences, which may be
    // negative, and waits, which grow when other work gets faster.
    bool isTime() const { return unit == "ms" && better == Better::lower; }

    // Whether both were timed in the same mode; false for unknown modes.
    bool isTimedAs(const Metric& metric) const {
        return mode == metric.mode && mode != Mode::other;
    }
};

// Returns the samples of a metric in a report. Null, which a probe has in a frame without a finite
// value, is NaN. nlohmann throws for anything else that is not a number.
std::vector<double> samplesIn(const scene::Json& samples);

// A metric of a case with all samples in the report.
struct MetricReading : Metric {
    double median = 0.0;

    // Reads the entry of that name in a case's metrics. Reports of 1.0 have no direction: it then
    // follows from the id, and is unknown for MetricOf::other. nlohmann throws if a required member
    // is missing.
    static MetricReading fromReport(std::string_view name, const scene::Json& entry);
};

// Returns all metrics of a case in the report's order. Throws like MetricReading::fromReport(), and
// also for a case without metrics.
std::vector<MetricReading> readMetrics(const scene::Json& result);

// Returns the metric with that id, or null.
template <class Found>
const Found* findMetric(const std::vector<Found>& metrics, const MetricId& id) {
    const auto found = std::ranges::find(metrics, id, &Found::id);
    return found == metrics.end() ? nullptr : &*found;
}

// "lower", "higher"; empty for neither.
const char* betterName(Better better);

// "overlapped", "isolated", "wall_clock", "other"; empty for none.
const char* modeName(Mode mode);

}  // namespace benchmarks::report
