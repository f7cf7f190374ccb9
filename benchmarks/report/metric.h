#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/scene/json.h"

// What is measured of a case. A metric's name is made from what it is, and looked up in one place
// where a report is read: nothing else takes a name to pieces.
namespace benchmarks::report {

// What a metric is of.
enum class MetricOf {
    frame,
    cpu,  // the host's work on overlapped frames
    gpu,  // its work on overlapped frames
    pass,  // one pass, by its name
    image,  // the picture, against a reference
    memory,  // of the device
    strands,  // the passes points and strands together
    device,  // what it can do, by a measurement of its own
    other,  // not known here: some other program's report has it
};

// Which quantity is measured. results/README.md says what each is.
enum class Measured {
    rate,
    low_1_percentile,
    low_1_mean,
    low_1_integral,
    low_0_1_percentile,
    low_0_1_mean,
    low_0_1_integral,
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
    flip_tessellation,  // against the picture by that back end
    flip_many_samples,  // against 64 samples a pixel
    allocated,  // all memory
    heap,
    purpose,
    transparency,
    bytes,  // that must be moved
    operations,  // that must be done
    limit,  // the least time for both
    limit_share,
    time_per_point,
    time_per_sample,
    copy_bandwidth,
    arithmetic,
    other,
};

enum class Better { neither, lower, higher };

// How it was timed, never compared across modes.
enum class Mode {
    none,  // in no mode
    overlapped,
    isolated,
    wall_clock,
    other,  // one that is not known here
};

// Metrics of one kind differ in their part alone.
struct MetricKind {
    MetricOf of;
    Measured what;
    std::string_view name;  // "pass.*.time": '*' stands for the part
    std::string_view unit;
    Better better;
};

// All kinds that there are, but for MetricOf::other.
std::span<const MetricKind> metricKinds();

// Which metric it is. Two that are equal have the same name, and the other way round.
struct MetricId {
    MetricOf of = MetricOf::other;
    Measured what = Measured::other;
    // The pass, the index of the heap, the purpose of memory or the kind of stage, without dots;
    // the whole name of MetricOf::other; otherwise empty.
    std::string part{};

    // "pass.strands.time". A pair of `of` and `what` that metricKinds() lacks is our own bug.
    std::string name() const;

    // Empty where it is of no pass.
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
inline MetricId ofMemory(Measured what, std::string part = {}) {
    return {MetricOf::memory, what, std::move(part)};
}

// The metric of that name in a report; MetricOf::other where no kind has such a name.
MetricId metricNamed(std::string_view name);

// Whether it is the time of a pass by the wall clock or by timestamps.
bool isPassTime(const MetricId& id);

// Whether it is the time of a whole frame or of a pass, by the wall clock or by timestamps.
bool isFrameOrPassTime(const MetricId& id);

// Whether it is what a frame or a pass used of the processor: its CPU time or instructions.
bool isOfProcessor(const MetricId& id);

// Whether it is what a frame or a pass costs by any measure: time, CPU time or instructions.
bool isFrameOrPassCost(const MetricId& id);

// Whether it is of a frame or of a pass, and the same quantity of it as the other one is.
bool isSameOfFrameOrPass(const MetricId& id, const MetricId& other);

// Samples of one quantity. Unit and better direction follow from what it is; where it was read from
// a report they are as the report says.
struct Metric {
    MetricId id;
    std::string unit;  // "ms", "1/s", "B"
    Better better = Better::neither;
    Mode mode = Mode::none;
    std::vector<double> samples;  // those that are not finite are missing

    Metric() = default;
    Metric(MetricId id, std::vector<double> samples, Mode mode = Mode::none);

    std::string name() const { return id.name(); }

    // Whether it is a duration of which less is better: no difference of two, which may be
    // negative, nor a wait, which grows when others get faster.
    bool isTime() const { return unit == "ms" && better == Better::lower; }

    // Whether both were timed in the same mode; false where a mode is not known here.
    bool isTimedAs(const Metric& metric) const {
        return mode == metric.mode && mode != Mode::other;
    }
};

// A metric of a case as a report has it, with all of its samples that the report has.
struct MetricReading : Metric {
    double median = 0.0;

    // The entry of that name in a case's metrics. Reports of 1.0 say no direction: it then follows
    // from what the metric is, and is not known of MetricOf::other. A member that an entry must
    // have and has not is thrown by nlohmann.
    static MetricReading fromReport(std::string_view name, const scene::Json& entry);
};

// All metrics of a case in a report, in its order. Thrown as by MetricReading::fromReport(), also
// where the case has no metrics at all.
std::vector<MetricReading> readMetrics(const scene::Json& result);

// The metric with that id; null where there is none.
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
