#include "benchmarks/measure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "benchmarks/hash.h"
#include "benchmarks/dropped_fragments.h"
#include "benchmarks/statistics.h"
#include "benchmarks/table.h"
#include "benchmarks/trust.h"

namespace benchmarks {

namespace {

using engine::FrameRecord;
using engine::Timing;

// Pairs of an isolated and a wall-clock frame that the timestamps are tested with. A fault of the
// device stays, a disturbance passes: while there are faults, more pairs are drawn.
constexpr std::uint32_t kTrustPairs = 2;
constexpr std::uint32_t kMostTrustPairs = 16;

struct Played {
    std::vector<FrameRecord> frames;  // measured ones
    double first_frame = 0.0;         // CPU ms from the start of recording until it was complete
    std::vector<std::uint8_t> picture;
    std::string picture_hash;
    std::string state_hash;
};

void playFrame(engine::FrameLoop& loop, Case& test_case, const StopRequest& stop) {
    if (stop()) throw Interrupted();
    loop.frame([&](engine::Passes& passes) { test_case.frame(passes); });
}

// All modes play the same frames, so that their pictures and states must be equal.
Played play(
    const engine::Device& device, Case& test_case, Timing timing, const hair::RunSettings& run,
    const StopRequest& stop) {
    test_case.reset();
    engine::FrameLoop loop(device, timing);
    Played played;
    playFrame(loop, test_case, stop);
    played.first_frame = loop.finish().front().interval;
    for (std::uint32_t i = 1; i < run.warmup; ++i) playFrame(loop, test_case, stop);
    // The interval of the last frame contains the wait for it: one more frame is drawn than
    // measured.
    for (std::uint32_t i = 0; i <= run.frames; ++i) playFrame(loop, test_case, stop);
    const std::vector<FrameRecord> frames = loop.finish();
    played.frames.assign(frames.end() - 1 - run.frames, frames.end() - 1);
    played.picture = test_case.picture();
    played.picture_hash = hashBytes(std::as_bytes(std::span(played.picture)));
    played.state_hash = test_case.stateHash();
    return played;
}

template <class Get>
std::vector<double> collect(const std::vector<FrameRecord>& frames, Get get) {
    std::vector<double> values;
    for (const FrameRecord& frame : frames) values.push_back(get(frame));
    return values;
}

void addPassTimes(
    const std::vector<FrameRecord>& frames, const std::string& mode, CaseResult& result) {
    for (const std::string& pass : passNames(frames)) {
        result.metrics.push_back({"pass." + pass + ".time", "ms", passTimes(frames, pass), mode});
    }
}

void addFrameTimes(const Played& played, CaseResult& result) {
    const std::string mode = "overlapped";
    const std::vector<FrameRecord>& frames = played.frames;
    const std::vector<double> intervals = collect(frames, [](auto& f) { return f.interval; });
    result.metrics.push_back({"fps", "1/s", {framesPerSecond(intervals)}, mode});
    result.metrics.push_back({"frame.time", "ms", intervals, mode});
    result.metrics.push_back(
        {"frame.device.time", "ms", collect(frames, [](auto& f) { return f.device; }), mode});
    result.metrics.push_back(
        {"cpu.record.time", "ms", collect(frames, [](auto& f) { return f.record; }), mode});
    result.metrics.push_back(
        {"cpu.submit.time", "ms", collect(frames, [](auto& f) { return f.submit; }), mode});
    result.metrics.push_back({"frame.first.time", "ms", {played.first_frame}, mode});
}

void addStatistics(
    const engine::Device& device, Case& test_case, const StopRequest& stop, CaseResult& result) {
    if (!device.hasPipelineStatistics()) return;
    engine::FrameLoop loop(device, Timing::statistics);
    playFrame(loop, test_case, stop);
    const std::vector<FrameRecord> frames = loop.finish();
    const auto& passes = frames.front().statistics;
    const auto strands = std::ranges::find(passes, "strands", &engine::PassStatistics::name);
    if (strands == passes.end()) return;

    const std::optional<hair::ExpectedCounts> expected = test_case.expected();
    const auto expectedOf = [&](std::string_view name) -> std::optional<std::uint64_t> {
        if (!expected) return std::nullopt;
        if (name == "tessellation_control_patches") return expected->tessellation_control_patches;
        if (name == "tessellation_evaluation_invocations") {
            return expected->tessellation_evaluation_invocations;
        }
        if (name == "geometry_invocations") return expected->geometry_invocations;
        if (name == "geometry_primitives") return expected->geometry_primitives;
        return std::nullopt;
    };
    for (std::size_t i = 0; i < engine::kStatisticNames.size(); ++i) {
        Statistic statistic{
            .name = std::string(engine::kStatisticNames[i]),
            .measured = strands->counts[i],
            .expected = expectedOf(engine::kStatisticNames[i]),
            .note = ""};
        const bool fragments = statistic.name == "fragment_invocations";
        if (fragments && device.fragmentCountsAreApproximate()) {
            statistic.note = "approximate: this driver counts too many";
        }
        if (statistic.expected && *statistic.expected != statistic.measured) {
            result.trust.warnings.push_back(
                statistic.name + ": measured " + std::to_string(statistic.measured) +
                ", expected " + std::to_string(*statistic.expected));
        }
        result.statistics.push_back(std::move(statistic));
    }
}

// Of the last frame, which is played.
void addTransparency(const Case& test_case, CaseResult& result) {
    const hair::StrandBlend& blend = test_case.blend();
    if (blend.bytes() == 0) return;
    result.metrics.push_back(
        {"memory.transparency", "B", {static_cast<double>(blend.bytes())}, ""});
    const std::optional<hair::ListedFragments> listed = blend.listed();
    if (!listed) return;
    result.counts.emplace_back("fragment_list_capacity", listed->capacity);
    result.counts.emplace_back("fragments_wanted", listed->wanted);
    result.counts.emplace_back("fragments_dropped", listed->dropped());
    if (std::string text = droppedFragments(test_case); !text.empty())
        result.trust.warnings.push_back(std::move(text));
}

// Adds the isolated pass times, by timestamps if they can be trusted and else by the CPU's clock.
void addPasses(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const Played& isolated, const StopRequest& stop, CaseResult& result) {
    const double ratio = passSumOverWall(isolated.frames);
    result.trust.pass_sum_over_wall = ratio;
    if (std::abs(ratio - 1.0) > kTrustTolerance) {
        result.trust.warnings.push_back(
            "the passes add up to " + shortNumber(ratio) + " of the frame's wall clock");
    }

    engine::FrameLoop stamped(device, Timing::isolated);
    engine::FrameLoop clocked(device, Timing::wall_clock);
    std::vector<FrameRecord> stamped_frames;
    std::vector<FrameRecord> clocked_frames;
    std::vector<std::string> faults;
    do {
        for (std::uint32_t i = 0; i < kTrustPairs; ++i) {
            playFrame(stamped, test_case, stop);
            playFrame(clocked, test_case, stop);
        }
        std::ranges::move(stamped.finish(), std::back_inserter(stamped_frames));
        std::ranges::move(clocked.finish(), std::back_inserter(clocked_frames));
        faults = timestampFaults(stamped_frames, clocked_frames);
    } while (!faults.empty() && stamped_frames.size() < kMostTrustPairs);
    if (faults.empty()) {
        addPassTimes(isolated.frames, "isolated", result);
        return;
    }
    result.trust.warnings.push_back(
        "timestamps are not trusted: the passes' times are by the CPU's clock");
    result.trust.warnings.insert(result.trust.warnings.end(), faults.begin(), faults.end());
    for (std::uint32_t i = 0; i < run.frames; ++i) playFrame(clocked, test_case, stop);
    addPassTimes(clocked.finish(), "wall_clock", result);
}

}  // namespace

std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const StopRequest& stop, CaseResult& result) {
    result.counts = test_case.counts();
    Played overlapped = play(device, test_case, Timing::overlapped, run, stop);
    const Played isolated = play(device, test_case, Timing::isolated, run, stop);
    result.image_hash = overlapped.picture_hash;
    result.state_hash = overlapped.state_hash;
    if (isolated.picture_hash != overlapped.picture_hash) {
        result.trust.warnings.push_back("overlapped and isolated frames made different pictures");
    }
    if (isolated.state_hash != overlapped.state_hash) {
        result.trust.warnings.push_back("overlapped and isolated frames made different states");
    }

    addFrameTimes(overlapped, result);
    addPasses(device, test_case, run, isolated, stop, result);
    const std::vector<double> walls = collect(isolated.frames, [](auto& f) { return f.wall; });
    result.metrics.push_back({"frame.isolated.time", "ms", walls, "isolated"});
    // What passing side by side saves: the isolated passes' sum less the overlapped frame.
    const double sum = summarize(collect(isolated.frames, passSum)).median;
    const double frame =
        summarize(collect(overlapped.frames, [](auto& f) { return f.interval; })).median;
    result.metrics.push_back({"frame.overlap", "ms", {sum - frame}, ""});
    result.metrics.push_back(
        {"memory.device", "B", {static_cast<double>(device.allocatedBytes())}, ""});
    addTransparency(test_case, result);
    addStatistics(device, test_case, stop, result);
    return std::move(overlapped.picture);
}

}  // namespace benchmarks
