#include "benchmarks/measure/measure.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/statistics.h"

namespace benchmarks::measure {
namespace {

using engine::FrameRecord;
using engine::Timing;

// Share of /run/max_time for wall-clock rounds that give nothing but the passes' use of the CPU.
constexpr double kUseShare = 1.0 / 3.0;

template <class Get>
double medianOf(const std::vector<engine::FrameRecord>& frames, Get get) {
    std::vector<double> values;
    for (const engine::FrameRecord& frame : frames) values.push_back(get(frame));
    return report::summarize(values).median;
}

void checkEnds(const RoundEnd& overlapped, const RoundEnd& isolated, report::CaseResult& result) {
    if (isolated.picture_hash != overlapped.picture_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different pictures");
    if (isolated.state_hash != overlapped.state_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different states");
}

// Adds the passes' times, by timestamps if they can be trusted and else by the CPU's clock; on a
// software device also what they used of the CPU, which only the latter tells. Returns the
// conditions of the rounds that it played.
std::vector<report::Conditions> addPasses(
    const Play& play, const SampledMode& isolated, MachineWatch& watch,
    report::CaseResult& result) {
    const std::vector<std::string> faults =
        checkTimestamps(play.device, [&](engine::FrameLoop& loop) { playFrame(loop, play); });
    const bool software = play.device.info().type == "cpu";
    if (faults.empty()) addPassTimes(isolated.frames, report::Mode::isolated, result);
    if (faults.empty() && !software) return {};

    SamplingRule rule = samplingRule(engine::Timing::wall_clock, play.run);
    if (faults.empty()) {
        rule.max_time *= kUseShare;
        rule.most_rounds = isolated.sampling.rounds;
    } else {
        result.trust.warnings.push_back(
            "timestamps are not trusted: the passes' times are by the CPU's clock");
        result.trust.warnings.insert(result.trust.warnings.end(), faults.begin(), faults.end());
    }
    SampledMode clocked = sampleMode(play, engine::Timing::wall_clock, rule, watch, result);
    if (!faults.empty()) addPassTimes(clocked.frames, report::Mode::wall_clock, result);
    if (software) addPassUse(clocked.frames, result);
    return std::move(clocked.conditions);
}

}  // namespace

std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    result.counts = test_case.counts();
    std::optional<BusyPass> busy;
    if (!run.busy_pass.empty()) busy.emplace(device, run.busy_pass, run.busy_work);
    const Play play{device, test_case, run, hooks, busy ? &*busy : nullptr};
    MachineWatch watch(device);

    const auto sample = [&](engine::Timing timing) {
        return sampleMode(play, timing, samplingRule(timing, run), watch, result);
    };
    SampledMode overlapped = sample(engine::Timing::overlapped);
    const SampledMode isolated = sample(engine::Timing::isolated);
    result.image_hash = overlapped.end.picture_hash;
    result.state_hash = overlapped.end.state_hash;
    checkEnds(overlapped.end, isolated.end, result);
    addTransparency(test_case, result);
    addStatistics(play, result);

    addOverlappedMetrics(overlapped.frames, result);
    result.metrics.push_back(
        {report::ofFrame(report::Measured::first_time),
         {overlapped.first_frame},
         report::Mode::overlapped});
    addPassSum(isolated.frames, result);
    std::vector<report::Conditions> conditions = std::move(overlapped.conditions);
    std::ranges::copy(isolated.conditions, std::back_inserter(conditions));
    std::ranges::move(addPasses(play, isolated, watch, result), std::back_inserter(conditions));
    result.conditions = medianConditions(conditions);
    addIsolatedMetrics(isolated.frames, result);
    if (device.info().type == "cpu") addFrameUse(isolated.frames, result);
    // What passing side by side saves: the isolated passes' sum less the overlapped frame.
    const double sum = medianOf(isolated.frames, passSum);
    const double frame = medianOf(overlapped.frames, [](auto& f) { return f.interval; });
    result.metrics.push_back({report::ofFrame(report::Measured::overlap), {sum - frame}});
    result.metrics.push_back(
        {report::ofMemory(report::Measured::allocated),
         {static_cast<double>(device.allocatedBytes())}});
    std::ranges::move(memoryMetrics(device.memory()), std::back_inserter(result.metrics));
    return std::move(overlapped.end.picture);
}

}  // namespace benchmarks::measure
