#include "benchmarks/measure/measure.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/statistics.h"

namespace benchmarks::measure {
namespace {

using engine::FrameRecord;
using engine::Timing;

// Share of /run/max_time for wall-clock rounds that give nothing but the passes' use of the CPU.
constexpr double kUseShare = 1.0 / 3.0;

template <class Get>
double medianOf(const std::vector<FrameRecord>& frames, Get get) {
    std::vector<double> values;
    for (const FrameRecord& frame : frames) values.push_back(get(frame));
    return report::summarize(values).median;
}

void checkEnds(const RoundEnd& overlapped, const RoundEnd& isolated, report::CaseResult& result) {
    if (isolated.picture_hash != overlapped.picture_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different pictures");
    if (isolated.state_hash != overlapped.state_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different states");
}

// What keeps the passes' times of these frames from being believed. Asked once in a run of frames
// with the same passes, if nothing does.
std::vector<std::string> faultsOf(
    Stage& stage, const std::vector<FrameRecord>& isolated, DeviceKnowledge* known,
    report::CaseResult& result) {
    const std::vector<std::string> passes = passNames(isolated);
    if (passes.empty()) return {"the device has no timestamps"};
    if (known && std::ranges::find(known->trusted_passes, passes) != known->trusted_passes.end())
        return {};
    std::vector<std::string> faults = checkTimestamps(stage, result);
    if (faults.empty() && known && !stage.isProcessor()) known->trusted_passes.push_back(passes);
    return faults;
}

// Adds the passes' times, by timestamps if they can be trusted and else by the CPU's clock; on a
// software device also what they used of the CPU, which only the latter tells. Returns the
// conditions of the rounds that it played.
std::vector<report::Conditions> addPasses(
    Stage& stage, const SampledMode& isolated, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    const std::vector<std::string> faults = faultsOf(stage, isolated.frames, hooks.known, result);
    const bool software = stage.isProcessor();
    if (faults.empty()) addPassTimes(isolated.frames, report::Mode::isolated, result);
    if (faults.empty() && !software) return {};

    SamplingRule rule = samplingRule(Timing::wall_clock, run);
    if (faults.empty()) {
        rule.max_time *= kUseShare;
        rule.most_rounds = isolated.sampling.rounds;
    } else {
        result.trust.warnings.push_back(
            "timestamps are not trusted: the passes' times are by the CPU's clock");
        result.trust.warnings.insert(result.trust.warnings.end(), faults.begin(), faults.end());
    }
    SampledMode clocked = sampleMode(stage, Timing::wall_clock, rule, run, hooks, result);
    if (!faults.empty()) addPassTimes(clocked.frames, report::Mode::wall_clock, result);
    if (software) addPassUse(clocked.frames, result);
    return std::move(clocked.conditions);
}

}  // namespace

std::vector<std::uint8_t> measureFrames(
    Stage& stage, const hair::RunSettings& run, const MeasureHooks& hooks,
    report::CaseResult& result) {
    const auto sample = [&](Timing timing) {
        return sampleMode(stage, timing, samplingRule(timing, run), run, hooks, result);
    };
    SampledMode overlapped = sample(Timing::overlapped);
    const SampledMode isolated = sample(Timing::isolated);
    result.image_hash = overlapped.end.picture_hash;
    result.state_hash = overlapped.end.state_hash;
    checkEnds(overlapped.end, isolated.end, result);
    for (const SampledMode* mode : {&std::as_const(overlapped), &isolated})
        if (mode->all_throttled && result.status == report::Status::ok) {
            result.status = report::Status::failed;
            result.reason = mode->sampling.mode + ": heat or power held the device back in all " +
                            std::to_string(mode->sampling.throttled_rounds) + " rounds";
        }

    addOverlappedMetrics(overlapped.frames, result);
    result.metrics.push_back(
        {report::ofFrame(report::Measured::first_time),
         {overlapped.first_frame},
         report::Mode::overlapped});
    addPassSum(isolated.frames, measureEmptySubmission(stage), stage.isProcessor(), result);
    // Of whatever else the device does meanwhile too, which is nothing on a machine of one's own.
    if (const auto watts = medianConditions(overlapped.conditions).power_w)
        result.metrics.push_back(
            {report::ofFrame(report::Measured::energy),
             {*watts * 1e-3 * medianOf(overlapped.frames, [](auto& f) { return f.interval; })},
             report::Mode::overlapped});
    // What a processor's passes cost is its CPU time; its clock is not the device's to tell.
    if (!stage.isProcessor())
        addCycles(
            overlapped.frames, overlapped.clock_mhz, isolated.frames, isolated.clock_mhz, result);
    result.trust.empty_pass = stage.emptyPass();
    std::vector<report::Conditions> conditions = std::move(overlapped.conditions);
    std::ranges::copy(isolated.conditions, std::back_inserter(conditions));
    std::ranges::move(
        addPasses(stage, isolated, run, hooks, result), std::back_inserter(conditions));
    result.conditions = medianConditions(conditions);
    addIsolatedMetrics(isolated.frames, result);
    if (stage.isProcessor()) addFrameUse(isolated.frames, result);
    // What passing side by side saves: the isolated passes' sum less the overlapped frame.
    if (!passNames(isolated.frames).empty()) {
        const double sum = medianOf(isolated.frames, passSum);
        const double frame = medianOf(overlapped.frames, [](auto& f) { return f.interval; });
        result.metrics.push_back({report::ofFrame(report::Measured::overlap), {sum - frame}});
    }
    return std::move(overlapped.end.picture);
}

std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    result.counts = test_case.counts();
    if (const auto backend = test_case.backend())
        result.backend = {hair::backendName(backend->backend), backend->variant, backend->reason};
    DeviceStage stage(device, test_case, run, hooks);
    std::vector<std::uint8_t> picture = measureFrames(stage, run, hooks, result);
    addTransparency(test_case, result);
    addStatistics(device, test_case, result);
    result.metrics.push_back(
        {report::ofMemory(report::Measured::allocated),
         {static_cast<double>(device.allocatedBytes())}});
    std::ranges::move(memoryMetrics(device.memory()), std::back_inserter(result.metrics));
    return picture;
}

}  // namespace benchmarks::measure
