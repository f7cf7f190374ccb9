#include "benchmarks/measure.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "benchmarks/machine/machine_watch.h"
#include "benchmarks/measure/check_timestamps.h"
#include "benchmarks/measure/drawn_counts.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sample_mode.h"
#include "benchmarks/memory_metrics.h"
#include "benchmarks/statistics.h"
#include "benchmarks/trust.h"

namespace benchmarks {

namespace {

using engine::FrameRecord;
using engine::Timing;

// Share of /run/max_time for wall-clock rounds that give nothing but the passes' use of the CPU.
constexpr double kUseShare = 1.0 / 3.0;

template <class Get>
double medianOf(const std::vector<FrameRecord>& frames, Get get) {
    std::vector<double> values;
    for (const FrameRecord& frame : frames) values.push_back(get(frame));
    return summarize(values).median;
}

void checkEnds(const RoundEnd& overlapped, const RoundEnd& isolated, CaseResult& result) {
    if (isolated.picture_hash != overlapped.picture_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different pictures");
    if (isolated.state_hash != overlapped.state_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different states");
}

// Adds the passes' times, by timestamps if they can be trusted and else by the CPU's clock; on a
// software device also what they used of the CPU, which only the latter tells. Returns the
// conditions of the rounds that it played.
std::vector<Conditions>
addPasses(const Play& play, const SampledMode& isolated, MachineWatch& watch, CaseResult& result) {
    const std::vector<std::string> faults =
        checkTimestamps(play.device, [&](engine::FrameLoop& loop) { playFrame(loop, play); });
    const bool software = play.device.info().type == "cpu";
    if (faults.empty()) addPassTimes(isolated.frames, Mode::isolated, result);
    if (faults.empty() && !software) return {};

    SamplingRule rule = samplingRule(Timing::wall_clock, play.run);
    if (faults.empty()) {
        rule.max_time *= kUseShare;
        rule.most_rounds = isolated.sampling.rounds;
    } else {
        result.trust.warnings.push_back(
            "timestamps are not trusted: the passes' times are by the CPU's clock");
        result.trust.warnings.insert(result.trust.warnings.end(), faults.begin(), faults.end());
    }
    SampledMode clocked = sampleMode(play, Timing::wall_clock, rule, watch, result);
    if (!faults.empty()) addPassTimes(clocked.frames, Mode::wall_clock, result);
    if (software) addPassUse(clocked.frames, result);
    return std::move(clocked.conditions);
}

}  // namespace

std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, CaseResult& result) {
    result.counts = test_case.counts();
    std::optional<BusyPass> busy;
    if (!run.busy_pass.empty()) busy.emplace(device, run.busy_pass, run.busy_work);
    const Play play{device, test_case, run, hooks, busy ? &*busy : nullptr};
    MachineWatch watch(device);

    const auto sample = [&](Timing timing) {
        return sampleMode(play, timing, samplingRule(timing, run), watch, result);
    };
    SampledMode overlapped = sample(Timing::overlapped);
    const SampledMode isolated = sample(Timing::isolated);
    result.image_hash = overlapped.end.picture_hash;
    result.state_hash = overlapped.end.state_hash;
    checkEnds(overlapped.end, isolated.end, result);
    addTransparency(test_case, result);
    addStatistics(play, result);

    addOverlappedMetrics(overlapped.frames, result);
    result.metrics.push_back(
        {ofFrame(Measured::first_time), {overlapped.first_frame}, Mode::overlapped});
    addPassSum(isolated.frames, result);
    std::vector<Conditions> conditions = std::move(overlapped.conditions);
    std::ranges::copy(isolated.conditions, std::back_inserter(conditions));
    std::ranges::move(addPasses(play, isolated, watch, result), std::back_inserter(conditions));
    result.conditions = medianConditions(conditions);
    addIsolatedMetrics(isolated.frames, result);
    if (device.info().type == "cpu") addFrameUse(isolated.frames, result);
    // What passing side by side saves: the isolated passes' sum less the overlapped frame.
    const double sum = medianOf(isolated.frames, passSum);
    const double frame = medianOf(overlapped.frames, [](auto& f) { return f.interval; });
    result.metrics.push_back({ofFrame(Measured::overlap), {sum - frame}});
    result.metrics.push_back(
        {ofMemory(Measured::allocated), {static_cast<double>(device.allocatedBytes())}});
    std::ranges::move(memoryMetrics(device.memory()), std::back_inserter(result.metrics));
    return std::move(overlapped.end.picture);
}

}  // namespace benchmarks
