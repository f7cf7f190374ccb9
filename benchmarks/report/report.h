#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/report/metric.h"
#include "benchmarks/scene/axis.h"
#include "benchmarks/scene/json.h"

// What a run found out, as plain values, and its JSON: the contract with everyone who reads
// reports, described by results/report.schema.json. What is not known is absent there, never 0 or
// "": empty strings, empty optionals, and numbers that are not finite are left out.
namespace benchmarks::report {

inline constexpr const char* kReportSchema = "hairbench-report/1.6.0";

struct DeviceRecord {
    std::string name;
    std::string type;    // "discrete", "integrated", "virtual", "cpu"
    std::string driver;  // VkPhysicalDeviceDriverProperties::driverName
    std::string driver_version;
    std::string api_version;
    std::optional<double> timestamp_period_ns;
    std::string id;  // "10005:0000" vendor and device in hex
    std::optional<std::uint32_t> timestamp_valid_bits;
    // The members of VkPhysicalDeviceLimits that decide what runs here, under Vulkan's names.
    std::vector<std::pair<std::string, double>> limits;
};

struct HostRecord {
    std::string system;
    std::string processor;
    std::optional<std::uint32_t> processor_count;
    std::optional<std::uint64_t> memory_bytes;
};

struct BuildRecord {
    std::string version;
    std::string commit;
    std::string compiler;
    std::string type;  // "Release", ...
    std::string flags;  // of the compiler
    std::optional<bool> dirty;  // whether tracked files differed from the commit
};

struct Environment {
    DeviceRecord device;
    HostRecord host;
    BuildRecord build;
    std::vector<std::string> command;
    std::string started;  // UTC, ISO 8601
    std::uint64_t seed = 1;
    std::optional<bool> validation;  // whether the validation layer was on: times are then useless
};

// The environment as reports of any kind write it.
scene::Json environmentJson(const Environment& environment);

struct SceneRecord {
    std::string path;
    std::string hash;  // of the document's text
    scene::Document document;  // every field, no axis applied
};

// A pipeline statistic, and the count that the scene implies.
struct Statistic {
    std::string name;
    std::uint64_t measured = 0;
    std::optional<std::uint64_t> expected;
    std::string note;
};

// How a mode's samples came about.
struct Sampling {
    std::string mode;  // "overlapped", "isolated", "wall_clock"
    std::uint32_t rounds = 0;  // that samples are from; each plays the same frames
    std::uint32_t plays = 1;  // of the frames in a round, one after the other without a pause
    std::uint32_t warmup_rounds = 0;  // left out before: times still drifted
    std::uint32_t throttled_rounds = 0;  // left out: heat or power held the device's clock back
    double seconds = 0.0;  // that all of it took
    std::optional<bool> steady;  // no trend in the last samples; absent: too few to tell
    // Half the 95 % interval of the median frame time over it, samples being as dependent as they
    // look; absent where there are too few for an interval.
    std::optional<double> precision;
};

// What else went on. Medians over the rounds.
struct Conditions {
    std::optional<double> clock_mhz;  // of the device's shaders
    std::optional<double> lowest_clock_mhz;  // of any reading under load
    std::optional<double> base_clock_mhz;
    std::optional<double> memory_clock_mhz;
    std::optional<double> temperature;  // degrees Celsius
    std::optional<double> power_w;  // that the device draws
    std::optional<double> load;  // share of the time in which the device had work, as it says
    std::optional<double>
        steal;  // share of all processors' time that the hypervisor gave to others
    std::optional<double> other_load;  // share of it that other processes used
    std::vector<std::string> throttle_reasons;  // that the driver gave, each once
};

struct Trust {
    std::optional<double> pass_sum_over_wall;
    // By the device's own clock: over the time from an isolated frame's first stamp to its last.
    std::optional<double> pass_sum_over_device;
    // Over the wall clock less what an empty submission and the wait for it take.
    std::optional<double> pass_sum_over_work;
    std::optional<double> empty_submission;  // ms, median
    std::optional<double> empty_pass;  // ms by timestamps of an isolated pass that does nothing
    // "right": checked in this case or an earlier one of the run; "wrong": the passes' times are by
    // the CPU's clock; "unchecked": /run/max_time had no time for it.
    std::string timestamps;
    std::optional<double> timestamp_rate;  // of the device's stamps, over a clock of the host
    std::vector<std::string> warnings;
};

enum class Status { ok, skipped, failed };

// What drew the strands.
struct BackendRecord {
    std::string name;  // as /strands/backend has it, but "automatic"; empty: no hair is drawn
    std::string variant;  // how it was made for the device; may be empty
    std::string reason;  // why this one drew them
};

// What is worst of its kind among the guides.
struct WorstGuide {
    double value = 0.0;
    std::uint32_t guide = 0;
    std::uint32_t guides = 0;  // beyond what a warning is for
};

// The hair before the first frame.
struct StartRecord {
    std::string from;  // "file", "grown"; "relaxed": simulated for /simulation/settle_steps
    std::string rest;  // /simulation/rest
    WorstGuide stretch;  // of a segment, over its rest length
    WorstGuide depth;  // of a vertex in a body, m; 0: none is inside
    WorstGuide speed;  // of a vertex, m/s
    // Where the rest shape is balanced: guides that were stiffened for it, the greatest factor, and
    // guides that could not be balanced.
    std::optional<std::uint32_t> stiffened;
    std::optional<double> stiffest;
    std::optional<std::uint32_t> unbalanced;
};

// What a case needs at most, B, worked out before it is made (measure/memory_need.h).
struct MemoryNeed {
    std::uint64_t device = 0;
    std::uint64_t host = 0;  // of the program with the case, without a software device's memory
};

// A file of GLSL that the case was played with: docs/extending_scenes.md.
struct ExtensionRecord {
    std::string pointer;  // of the field that names it
    std::string file;  // as the field has it
    std::string sha256;
};

struct CaseResult {
    std::string name;
    std::optional<std::size_t> index;  // in the whole sweep, from 0
    std::optional<std::size_t> order;  // in which it ran, from 0
    std::vector<scene::AxisValue> axes;
    Status status = Status::ok;
    std::string reason;  // why it was skipped or failed
    std::optional<MemoryNeed> memory_need;
    std::vector<ExtensionRecord> extensions;
    BackendRecord backend;
    std::optional<StartRecord> start;
    // Medians, MAD and the rest are worked out when they are written; those without a finite sample
    // are left out then.
    std::vector<Metric> metrics;
    std::vector<Statistic> statistics;
    std::vector<std::pair<std::string, std::uint64_t>>
        counts;  // "guides", "strands", "segments", ...
    std::vector<Sampling> sampling;
    Conditions conditions;
    Trust trust;
    std::string image_hash;
    std::string state_hash;
    std::string picture;  // file of the last frame's picture, relative to the report; may be empty
};

// Which part of a sweep a report is of.
struct Shard {
    std::uint32_t index = 1;  // from 1
    std::uint32_t count = 1;
};

// All of a report but its cases.
struct ReportHeader {
    Environment environment;
    SceneRecord scene;
    std::optional<std::size_t> case_count;  // of the whole sweep
    std::optional<std::uint32_t> order_seed;  // of the order in which cases ran
    std::optional<Shard> shard;
};

struct Report : ReportHeader {
    std::vector<CaseResult> cases;
    bool interrupted = false;  // stopped by the user: the cases are those that were done
};

scene::Json headerJson(const ReportHeader& header);
scene::Json caseJson(const CaseResult& result);
// A report of cases that are JSON already; `interrupted` as above.
scene::Json assembledReport(scene::Json header, std::vector<scene::Json> cases, bool interrupted);
scene::Json reportJson(const Report& report);

const char* statusName(Status status);

// Whether this program reads reports of that schema: "hairbench-report/1.3.0" for one of 1.1.0, as
// minor versions add members.
bool isReadable(std::string_view schema);

// A written report with all its samples, those of a sidecar too. Throws engine::Error "<path>:
// <reason>": no such file, no report, one of another major version, a sidecar that is missing.
scene::Json readReport(const std::filesystem::path& path);

// Writes a report in one step: whoever opens the file sees the old one or the new one. Large
// samples go into a file beside it. Creates missing folders. Throws engine::Error
// "<path>: <reason>".
void writeReport(const scene::Json& report, const std::filesystem::path& path);

// Calls what it is given with each case of a report, in the report's order, and does so again
// whenever it is called.
using EachCase = std::function<void(const std::function<void(scene::Json)>& visit)>;

// Writes the same for assembledReport() of these cases, of which one is in memory at a time.
// `header` has a report's members up to "interrupted".
void writeReport(
    const scene::Json& header, const EachCase& each_case, const std::filesystem::path& path);

// Samples of large metrics lie in a file beside the report, "<report without extension>
// .samples.jsonl": a line {"case", "metric", "samples"} for each. Such a metric has "samples_file",
// its name relative to the report, and "sample_count" instead of "samples".

inline constexpr std::size_t kMostSamplesInReport = 2000;

}  // namespace benchmarks::report
