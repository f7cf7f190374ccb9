#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "benchmarks/run/plan.h"
#include "engine/device.h"

// A run: its plan's cases played one after another, recorded, and made into a report.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::run {

// The file that --out names; or results/local/<scene>.json, and <scene>.2of8.json of a shard, so
// that shards in one folder do not take each other's place.
std::filesystem::path reportFile(const RunOptions& options, const RunPlan& plan);

// Throws engine::Error where a picture that a case is to be compared with is not there.
void checkReferences(const RunPlan& plan);

// The device of a run. Where a case lost it, those after it have another.
class RunDevice {
public:
    explicit RunDevice(engine::DeviceOptions options) : options_(std::move(options)) {}

    // Made where there is none. Throws as engine::Device does, but NoDevice where one was lost and
    // no other can be made.
    const engine::Device& get();
    void drop() { device_.reset(); }

private:
    engine::DeviceOptions options_;
    bool had_one_ = false;
    std::optional<engine::Device> device_;
};

struct FinishedRun {
    // For a terminal: the table of the cases, then their warnings; empty where was_complete.
    std::string summary;
    std::size_t done = 0;  // cases
    std::size_t measured = 0;  // of these: neither skipped nor failed
    bool interrupted = false;  // by the user: cases are missing
    // Cases are missing: one lost the device, and this is why there is no other.
    std::string no_device;
    bool was_complete = false;  // --resume found a report with nothing left to do
};

// Plays what a plan has left to do, with progress on stderr, and writes the report to `out`.
// Where an interrupt finds the device at a long frame, what it would return, whose report is
// written, is given to `last_words`, and the program ends (engine/process.h).
// A case that loses the device fails, and the next one has a new device; where none can be made the
// run ends.
// Throws engine::Error, and WriteFailed (record.h).
FinishedRun playRun(
    RunDevice& device, const RunOptions& options, const RunPlan& plan,
    const std::filesystem::path& out, measure::HairCache& cache,
    const std::function<void(const FinishedRun&)>& last_words);

}  // namespace benchmarks::run
