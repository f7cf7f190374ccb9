#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "benchmarks/report/verdict.h"
#include "benchmarks/run/plan.h"
#include "engine/device.h"

// Plays the cases of a plan one after another, records them, and makes a report.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::run {

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
// an interrupt arrives during a long frame, writes the report, passes the result to `last_words`
// and ends the program (engine/process.h).
// A case that loses the device fails, and the next case gets a new device. If none can be created,
// the run ends.
// Throws engine::Error, and WriteFailed (record.h).
FinishedRun playRun(
    RunDevice& device, const RunOptions& options, const RunPlan& plan,
    const std::filesystem::path& out, measure::HairCache& cache,
    const std::function<void(const FinishedRun&)>& last_words);

}  // namespace benchmarks::run
