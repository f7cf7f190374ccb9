#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/run/backends.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/scene/json.h"
#include "engine/device.h"

// Runs one case: its measurement, and the picture beside the report.

namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::run {

// Writes a case's picture, [row][column] RGBA, top row first, beside the report, as a PNG at most
// 480 px wide: "<report without extension>.pictures/<index>.png". Returns that path relative to the
// report's folder, with forward slashes. Throws engine::Error "<path>: <reason>".
std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index);

// Removes pictures of earlier runs beside the report that are not in `pictures`, the report's own.
void removeOtherPictures(
    const std::set<std::string>& pictures, const std::filesystem::path& report);

// References for the cases of a run.
struct CaseComparisons {
    reference::ReferenceComparison references;
    BackendComparison backends;
};

struct PlayedCase {
    report::CaseResult result;
    bool lost_device = false;  // the device cannot be used any more
};

// Measures a case. A case that cannot run here, or that fails, gives a result with the reason. If
// the device, the host or `max_memory`, B, has too little memory (measure/memory_need.h), the case
// is not even created. The picture goes beside the file `report`; if that is empty, none is
// written. Throws Interrupted.
PlayedCase runCase(
    const engine::Device& device, const PlannedCase& planned, const measure::MeasureHooks& hooks,
    const std::filesystem::path& report, CaseComparisons& comparisons, measure::HairCache& cache,
    std::optional<std::uint64_t> max_memory = {});

// Plays the cases of a plan one after another, records them, and makes a report.

// Returns the file from --out, otherwise results/local/<scene>.json, or <scene>.2of8.json for a
// shard, so that shards in one folder do not overwrite each other.
std::filesystem::path reportFile(const RunOptions& options, const RunPlan& plan);

// Throws engine::Error if a reference picture of a case is missing.
void checkReferences(const RunPlan& plan);

// The device of a run. After a case loses it, the next cases get a new one.
class RunDevice {
public:
    explicit RunDevice(engine::DeviceOptions options) : options_(std::move(options)) {}

    // Creates the device if there is none. Throws like engine::Device, but NoDevice if one was lost
    // and no other can be created.
    const engine::Device& get();
    void drop() { device_.reset(); }

private:
    engine::DeviceOptions options_;
    bool had_one_ = false;
    std::optional<engine::Device> device_;
};

struct FinishedRun {
    // For a terminal: the table of cases, then their warnings; empty if was_complete.
    std::string summary;
    report::Verdicts verdicts;  // on the measured cases
    std::size_t done = 0;  // cases
    std::size_t measured = 0;  // cases neither skipped nor failed
    bool interrupted = false;  // by the user: cases are missing
    // Set if a case lost the device and no other could be created: the reason. Cases are then
    // missing.
    std::string no_device;
    bool was_complete = false;  // --resume found a report with nothing left to do
};

// Plays the remaining cases of a plan, with progress on stderr, and writes the report to `out`. If
// an interrupt arrives during a long frame or within a library, writes the report, passes the
// result to `last_words` and ends the program (engine/process.h): another thread may call it.
// A case that loses the device fails, and the next case gets a new device. If none can be created,
// the run ends.
// Throws engine::Error, and WriteFailed (record.h).
FinishedRun playRun(
    RunDevice& device, const RunOptions& options, const RunPlan& plan,
    const std::filesystem::path& out, measure::HairCache& cache,
    const std::function<void(const FinishedRun&)>& last_words);

// Merges the reports of a sweep's shards.

struct MergeRules {
    std::filesystem::path out;  // the merged report, to which picture paths become relative
    bool force = false;  // merge even reports that do not belong together; of two equal cases, keep
                         // the first
};

// Merges the reports of parts of a sweep: the cases in the sweep's order, everything else from the
// first report, "interrupted" if cases are missing. Adds a line to `notes` for each objection that
// `force` overrode, and for missing cases. Throws engine::Error "<path>: <reason>" like readReport,
// for a report of another scene, build or device than the first one, and for a case that an earlier
// report has.
scene::Json mergedReport(
    const std::vector<std::filesystem::path>& reports, const MergeRules& rules,
    std::vector<std::string>& notes);

}  // namespace benchmarks::run
