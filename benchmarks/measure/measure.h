#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/report/report.h"
#include "engine/process.h"
#include "hair/settings.h"

// The state of the hair before the first frame, and its faults.

namespace benchmarks::measure {

struct StartInspection {
    report::StartRecord record;
    std::vector<std::string> warnings;
};

// Names the forces of hair-hair contact that the time step limits by more than a twentieth, with
// the values in use and the step that would not.
std::vector<std::string> contactWarnings(const Case& test_case);

// For a case that has played no frame. Waits for the device.
StartInspection inspectStart(const Case& test_case);

// Judges this state as inspectStart() does.
StartInspection judgeStart(
    const hair::simulation::GuideCondition& condition, const hair::simulation::RestBalance* balance,
    const hair::Settings& settings);

// Measures one case.

// Plays the case in rounds of /run/warmup and /run/frames frames, overlapped and then isolated,
// until the frame time is known to /run/precision or /run/max_time is over. Checks that all rounds
// made the same picture and state, and checks the timestamps against the CPU's clock. Counts with
// pipeline statistics in the frame that ends the first isolated round. Fills in metrics,
// statistics, counts, sampling, conditions, trust and hashes of `result`. If the device was
// throttled in all rounds, the status is `failed` and the samples are those of throttled rounds.
// Returns the picture of a round's last frame, which is hashed, [row][column] RGBA, top row first.
// Throws Interrupted if the user asks to stop, engine::Error if there is no /run/busy_pass.
std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result);

// Probes of the start of the hair and of some frames, which play without drawing.
struct PlayedProbes {
    std::vector<std::string> names;  // of metrics: "probe.speed"
    std::vector<double> times;  // [frame], simulated s
    std::vector<std::vector<double>> values;  // [name][frame]
    std::vector<double> pass_times;  // [frame], ms; empty without timestamps
};

// Returns the names of the metrics that /run/probes asks for: "probe.speed".
std::vector<std::string> probeNames(const hair::Settings& settings);

// Records the probes of /run/probes, which must ask for some, of frames that somebody plays.
class ProbeRecorder {
public:
    // For the start of the hair and `frames` frames. Throws engine::Error for guides that do not
    // exist.
    ProbeRecorder(const engine::Device& device, Case& test_case, std::uint32_t frames);

    // Records the pass `probe` of the current frame: of the start of the hair, or behind
    // Case::simulate().
    void record(engine::Passes& passes);
    // Notes the time of the frame that was recorded.
    void frameDone();

    // Returns all frames, without times of the pass. Waits for the device.
    PlayedProbes take();

private:
    Case& case_;
    hair::simulation::Probes probes_;
    PlayedProbes played_;
};

// Plays the case from its start with the pass `probe` of /run/probes, which must ask for some.
// Throws Interrupted if `stop` returns true before a frame, engine::Error for guides that do not
// exist.
PlayedProbes playProbes(
    const engine::Device& device, Case& test_case, std::uint32_t frames,
    const std::function<bool()>& stop);

// Plays the frames of a round again, without drawing, from the start of the hair to the state that
// was hashed, with the pass `probe`. Adds probe.*; warns if the state differs from
// result.state_hash. Does nothing without /run/probes. Throws like measure(), and engine::Error for
// guides that do not exist.
void addProbes(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result);

// Measures the part that needs no case, on any stage: metrics of frames and passes, sampling,
// conditions, trust and hashes.
std::vector<std::uint8_t> measureFrames(
    Stage& stage, const hair::RunSettings& run, const MeasureHooks& hooks,
    report::CaseResult& result);

}  // namespace benchmarks::measure
