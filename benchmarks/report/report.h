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

namespace engine {
enum class DeviceType;
}  // namespace engine

// Results of a run as plain values, and their JSON, which results/report.schema.json describes for
// everyone who reads reports. Unknown values are absent there, never 0 or "": empty strings, empty
// optionals and numbers that are not finite are left out.
namespace benchmarks::report {

inline constexpr const char* kReportSchema = "hairbench-report/1.9.0";

struct DeviceRecord {
    std::string name;
    std::optional<engine::DeviceType> type;
    std::string driver;  // VkPhysicalDeviceDriverProperties::driverName
    std::string driver_version;
    std::string api_version;
    std::optional<double> timestamp_period_ns;
    std::string id;  // "10005:0000", vendor and device in hex
    std::optional<std::uint32_t> timestamp_valid_bits;
    // The board, to tell two boards of one model apart; empty for software devices.
    std::string board;  // hash of its UUID, which is not published itself
    std::string pci_address;  // "0000:65:00.0"
    std::optional<double> power_limit_w;
    // Members of VkPhysicalDeviceLimits that decide which cases run here, under Vulkan's names.
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
    std::string flags;  // compiler flags
    std::optional<bool> dirty;  // whether tracked files differed from the commit
};

struct Environment {
    DeviceRecord device;
    HostRecord host;
    BuildRecord build;
    std::vector<std::string> command;
    std::string started;  // UTC, ISO 8601
    std::uint64_t seed = 1;
    std::optional<bool> validation;  // whether the validation layer was on, which makes times
                                     // useless
};

// Returns the environment as reports of every kind contain it.
scene::Json environmentJson(const Environment& environment);

struct SceneRecord {
    std::string path;
    std::string hash;  // of the document's text
    scene::Document document;  // every field, without any axis applied
};

// A pipeline statistic, and its expected count for the scene.
struct Statistic {
    std::string name;
    std::uint64_t measured = 0;
    std::optional<std::uint64_t> expected;
    std::string note;
};

// How the samples of a mode were taken.
struct Sampling {
    std::string mode;  // "overlapped", "isolated", "wall_clock"
    std::uint32_t rounds = 0;  // rounds with samples; each plays the same frames
    std::uint32_t plays = 1;  // plays of the frames in a round, without a pause between them
    std::uint32_t warmup_rounds = 0;  // left out at the start: times still drifted
    std::uint32_t throttled_rounds = 0;  // left out: heat or power held the device's clock back
    double seconds = 0.0;  // total time
    std::optional<bool> steady;  // no trend in the last samples; absent: too few to tell
    // Half the 95 % interval of the median frame time over that median. In isolated frames of a GPU
    // it is that of the least known of the frame and its larger passes (measure::SamplingRule). The
    // interval allows for the dependence between samples. Absent with too few samples for an
    // interval.
    std::optional<double> precision;
};

// Conditions during the measurement. Medians over the rounds.
struct Conditions {
    std::optional<double> clock_mhz;  // of the device's shaders
    std::optional<double> lowest_clock_mhz;  // lowest reading under load
    // A quarter of a round's readings under load, and at least one if there are several, are lower.
    // The lowest of all rounds.
    std::optional<double> low_clock_mhz;
    std::optional<double> base_clock_mhz;
    std::optional<double> memory_clock_mhz;
    std::optional<double> temperature;  // degrees Celsius
    std::optional<double> power_w;  // power draw of the device
    // Energy in J that the device used in a round, by its counter, and the time in s for that. Not
    // in reports.
    std::optional<double> energy_j;
    std::optional<double> energy_s;
    std::string energy_source;  // of frame.energy: "counter", "power"; empty: there is none
    std::optional<double> load;  // share of the time in which the device was busy, as the driver
                                 // reports it
    std::optional<double>
        steal;  // share of all processors' time that the hypervisor gave to others
    std::optional<double> other_load;  // share of all processors' time that other processes used
    std::vector<std::string> throttle_reasons;  // from the driver, each once
};

struct Trust {
    std::optional<double> pass_sum_over_wall;
    // Over the device's own time from the first timestamp of an isolated frame to its last.
    std::optional<double> pass_sum_over_device;
    // Over the wall-clock time less the time of an empty submission and its wait.
    std::optional<double> pass_sum_over_work;
    std::optional<double> empty_submission;  // ms, median
    std::optional<double> empty_pass;  // ms by timestamps, of an isolated pass that does nothing
    // "right": checked in this case or an earlier one of the run; "wrong": the passes' times are by
    // the CPU's clock; "unchecked": /run/max_time left no time for the check.
    std::string timestamps;
    std::optional<double> timestamp_rate;  // of the device's timestamps, over a host clock
    std::vector<std::string> warnings;
};

enum class Status { ok, skipped, failed };

// The back end that drew the strands.
struct BackendRecord {
    std::string name;  // as in /strands/backend, but never "automatic"; empty: no hair is drawn
    std::string variant;  // variant for the device; may be empty
    std::string reason;  // why this back end was used
};

// The worst value among the guides.
struct WorstGuide {
    double value = 0.0;
    std::uint32_t guide = 0;
    std::uint32_t guides = 0;  // number of guides beyond the limit for a warning
};

// State of the hair before the first frame.
struct StartRecord {
    std::string from;  // "file", "grown"; "relaxed": simulated for /simulation/settle_steps
    std::string rest;  // /simulation/rest
    WorstGuide stretch;  // of a segment: length over rest length
    WorstGuide depth;  // of a vertex inside a body, m; 0: none is inside
    WorstGuide speed;  // of a vertex, m/s
    // For a balanced rest shape: the number of guides that were stiffened for it, the greatest
    // factor, and the number of guides that could not be balanced.
    std::optional<std::uint32_t> stiffened;
    std::optional<double> stiffest;
    std::optional<std::uint32_t> unbalanced;
};

// Upper bound of a case's memory in B, estimated before it is created (measure/memory_need.h).
struct MemoryNeed {
    std::uint64_t device = 0;
    std::uint64_t host = 0;  // the program with the case, without a software device's memory
};

// A GLSL file that extends the case: docs/extending.md.
struct ExtensionRecord {
    std::string pointer;  // of the field that names the file
    std::string file;  // as the field names it
    std::string sha256;
};

// A program that the driver's compiler made of shaders.
struct ShaderRecord {
    std::string name;  // the driver's
    std::vector<std::string> shaders;  // paths
    std::uint32_t subgroup_size = 0;
    std::vector<std::pair<std::string, double>> figures;  // under the driver's names
};

struct CaseResult {
    std::string name;
    std::optional<std::size_t> index;  // in the whole sweep, from 0
    std::optional<std::size_t> order;  // position in the order of execution, from 0
    std::vector<scene::AxisValue> axes;
    Status status = Status::ok;
    std::string reason;  // why it was skipped or failed
    std::optional<MemoryNeed> memory_need;
    std::vector<ExtensionRecord> extensions;
    BackendRecord backend;
    std::optional<StartRecord> start;
    // Medians, MAD and other statistics are computed on writing. Metrics without a finite sample
    // are then left out.
    std::vector<Metric> metrics;
    std::vector<Statistic> statistics;
    std::vector<ShaderRecord> shaders;
    std::vector<std::pair<std::string, std::uint64_t>>
        counts;  // "guides", "strands", "segments", ...
    std::vector<Sampling> sampling;
    Conditions conditions;
    Trust trust;
    std::string image_hash;
    std::string state_hash;
    std::string picture;  // file of the last frame, relative to the report; may be empty
};

// The part of a sweep that a report covers.
struct Shard {
    std::uint32_t index = 1;  // from 1
    std::uint32_t count = 1;
};

// Everything in a report except its cases.
struct ReportHeader {
    Environment environment;
    SceneRecord scene;
    std::optional<std::size_t> case_count;  // of the whole sweep
    std::optional<std::uint32_t> order_seed;  // seed of the order in which cases ran
    std::optional<Shard> shard;
};

struct Report : ReportHeader {
    std::vector<CaseResult> cases;
    bool interrupted = false;  // stopped by the user: only the finished cases
};

scene::Json headerJson(const ReportHeader& header);
scene::Json caseJson(const CaseResult& result);
// Returns a report with cases that are already JSON; `interrupted` as in Report.
scene::Json assembledReport(scene::Json header, std::vector<scene::Json> cases, bool interrupted);
scene::Json reportJson(const Report& report);

const char* statusName(Status status);

// Whether this program can read reports with that schema. Minor versions only add members, so a
// reader of 1.1.0 can read "hairbench-report/1.3.0".
bool isReadable(std::string_view schema);

// Reads a written report with all its samples, including those in the samples file. Throws
// engine::Error "<path>: <reason>" for a missing file, a file that is not a report, another major
// version, or a missing samples file.
scene::Json readReport(const std::filesystem::path& path);

// Writes a report atomically: a reader sees either the old file or the new one. Writes large
// samples into a file beside it. Creates missing folders. Throws engine::Error "<path>: <reason>".
void writeReport(const scene::Json& report, const std::filesystem::path& path);

// Calls `visit` with each case of a report, in the report's order.
using EachCase = std::function<void(const std::function<void(scene::Json)>& visit)>;

enum class LargeSamples { none, some };

// Writes the same file as for assembledReport() of these cases, but visits each case once and keeps
// only one in memory. `header` has a report's members up to "interrupted". `large`: whether
// hasLargeSamples() is true for some case.
void writeReport(
    const scene::Json& header, const EachCase& each_case, LargeSamples large,
    const std::filesystem::path& path);

// Samples of large metrics lie in a file beside the report, "<report without
// extension>.samples.jsonl", with a line {"case", "metric", "samples"} for each metric. In the
// report, these metrics have "samples_file", the file's name relative to the report, and
// "sample_count" instead of "samples".

inline constexpr std::size_t kMostSamplesInReport = 2000;

// Whether a case (caseJson) has such a metric.
bool hasLargeSamples(const scene::Json& result);

}  // namespace benchmarks::report
