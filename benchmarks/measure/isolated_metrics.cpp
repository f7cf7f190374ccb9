#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/table.h"
#include "benchmarks/trust.h"

namespace benchmarks {

namespace {

using engine::FrameRecord;
using engine::PassTime;
using engine::ProcessUse;

// CPU time and instructions of what `metric_of` makes metrics of. A count that some of the frames
// lack is left out: samples of different frames would be none of one quantity.
template <class MakeId>
void addUse(MakeId metric_of, const std::vector<ProcessUse>& uses, Mode mode, CaseResult& result) {
    std::vector<double> times;
    std::vector<double> instructions;
    for (const ProcessUse& use : uses) {
        times.push_back(use.cpu);
        if (use.instructions) instructions.push_back(*use.instructions);
    }
    const bool counted = instructions.size() == uses.size();
    result.metrics.push_back({metric_of(Measured::cpu_time), std::move(times), mode});
    if (counted)
        result.metrics.push_back(
            {metric_of(Measured::instructions), std::move(instructions), mode});
}

}  // namespace

void addIsolatedMetrics(std::span<const FrameRecord> frames, CaseResult& result) {
    std::vector<double> walls;
    for (const FrameRecord& frame : frames) walls.push_back(frame.wall);
    result.metrics.push_back({ofFrame(Measured::isolated_time), std::move(walls), Mode::isolated});
}

void addPassTimes(std::span<const FrameRecord> frames, Mode mode, CaseResult& result) {
    for (const std::string& pass : passNames(frames))
        result.metrics.push_back({ofPass(pass, Measured::time), passTimes(frames, pass), mode});
}

void addPassSum(std::span<const FrameRecord> isolated, CaseResult& result) {
    const double ratio = passSumOverWall(isolated);
    result.trust.pass_sum_over_wall = ratio;
    if (std::abs(ratio - 1.0) > kTrustTolerance) {
        result.trust.warnings.push_back(
            "the passes add up to " + shortNumber(ratio) + " of the frame's wall clock");
    }
}

void addFrameUse(std::span<const FrameRecord> isolated, CaseResult& result) {
    std::vector<ProcessUse> uses;
    for (const FrameRecord& frame : isolated) uses.push_back(frame.use);
    addUse(ofFrame, uses, Mode::isolated, result);
}

void addPassUse(std::span<const FrameRecord> wall_clock, CaseResult& result) {
    for (const std::string& name : passNames(wall_clock)) {
        std::vector<ProcessUse> uses;
        for (const FrameRecord& frame : wall_clock) {
            const auto found = std::ranges::find(frame.passes, name, &PassTime::name);
            if (found != frame.passes.end()) uses.push_back(found->use);
        }
        addUse([&](Measured what) { return ofPass(name, what); }, uses, Mode::wall_clock, result);
    }
}

}  // namespace benchmarks
