#include "benchmarks/measure/trust.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"

namespace benchmarks::measure {

std::vector<std::string> timestampFaults(
    std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock) {
    double fastest_frame = std::numeric_limits<double>::infinity();
    for (const engine::FrameRecord& frame : wall_clock) {
        fastest_frame = std::min(fastest_frame, passSum(frame));
    }
    const double slack = kSubmissionCost + kFrameShare * fastest_frame;

    std::vector<std::string> faults;
    for (const std::string& pass : passNames(isolated)) {
        const std::vector<double> timestamped_times = passTimes(isolated, pass);
        const std::vector<double> clocked_times = passTimes(wall_clock, pass);
        if (clocked_times.empty()) continue;
        // A busy machine only adds time, so the fastest frames are compared.
        const double timestamped = std::ranges::min(timestamped_times);
        const double clocked = std::ranges::min(clocked_times);
        const bool too_long = timestamped > clocked * (1.0 + report::kTrustTolerance) + slack;
        const bool too_short = timestamped < clocked * (1.0 - report::kTrustTolerance) - slack;
        if (too_long || too_short) {
            faults.push_back(
                "pass." + pass + ": timestamps say " + report::shortNumber(timestamped) +
                " ms, the CPU's clock " + report::shortNumber(clocked) + " ms");
        }
    }
    return faults;
}

// ---- Timestamps against the CPU's clock ---------------------------------------------------------

namespace {

constexpr std::uint32_t kPairs = 2;  // between two checks
constexpr std::uint32_t kMostPairs = 16;
// With fewer pairs, a disturbance cannot be told from a fault.
constexpr std::uint32_t kFewestPairs = 4;

// Work that is planted in one pass after another: many times the possible cost of its submission.
constexpr double kPlantedTime = 10.0;  // ms
constexpr double kMostPlantedSteps = 1u << 30;

// Clocks of a device and its host drift apart by about 1e-5; real faults are large.
constexpr double kRateTolerance = 0.01;

}  // namespace

std::vector<std::string> checkTimestamps(
    const PlayedFrames& timestamped, const PlayedFrames& clocked,
    const std::function<bool()>& is_time) {
    std::vector<engine::FrameRecord> timestamped_frames;
    std::vector<engine::FrameRecord> clocked_frames;
    std::vector<std::string> faults;
    do {
        for (std::uint32_t i = 0; i < kPairs; ++i) {
            timestamped.play();
            clocked.play();
        }
        std::ranges::move(timestamped.finish(), std::back_inserter(timestamped_frames));
        std::ranges::move(clocked.finish(), std::back_inserter(clocked_frames));
        faults = timestampFaults(timestamped_frames, clocked_frames);
    } while (!faults.empty() && timestamped_frames.size() < kMostPairs && (!is_time || is_time()));
    return faults;
}

namespace {

PlayedFrames playedBy(Player& player) {
    return {[&] { player.frame(); }, [&] { return player.finish(); }};
}

std::vector<std::string>
pairFaults(Stage& stage, const PlantedWork* planted, const std::function<bool()>& is_time) {
    const auto player = [&](engine::Timing timing) {
        return planted ? stage.player(timing, *planted) : stage.player(timing);
    };
    const auto timestamped = player(engine::Timing::isolated);
    const auto clocked = player(engine::Timing::wall_clock);
    return checkTimestamps(playedBy(*timestamped), playedBy(*clocked), is_time);
}

double timeOf(std::span<const engine::FrameRecord> frames, const std::string& pass) {
    const std::vector<double> times = passTimes(frames, pass);
    return times.empty() ? 0.0 : std::ranges::min(times);
}

std::vector<engine::FrameRecord> playTwice(Player& player) {
    player.frame();
    player.frame();
    return player.finish();
}

// Steps of planted work that take the pass kPlantedTime by the CPU's clock.
std::uint32_t detectableSteps(Stage& stage, const std::string& pass, double without) {
    double steps = 1024.0;
    while (steps < kMostPlantedSteps) {
        const std::unique_ptr<Player> player =
            stage.player(engine::Timing::wall_clock, {pass, static_cast<std::uint32_t>(steps)});
        const double planted = timeOf(playTwice(*player), pass) - without;
        if (planted >= kPlantedTime) break;
        // A time well above that of a submission tells how much more is needed.
        steps *= planted > 0.2 * kPlantedTime ? 1.2 * kPlantedTime / planted : 4.0;
    }
    return static_cast<std::uint32_t>(std::min(steps, kMostPlantedSteps));
}

// Adds faults that are not in the list yet.
void addPlantedFaults(
    Stage& stage, const PlantedWork& planted, const std::function<bool()>& is_time,
    std::vector<std::string>& faults) {
    for (std::string& fault : pairFaults(stage, &planted, is_time))
        if (std::ranges::find(faults, fault) == faults.end())
            faults.push_back(std::move(fault) + ", with planted work in " + planted.pass);
}

std::vector<std::string> rateFaults(std::optional<double> rate) {
    if (!rate || std::abs(*rate - 1.0) <= kRateTolerance) return {};
    return {
        "the device's timestamps run at " + report::shortNumber(*rate) +
        " of the rate that their period says"};
}

}  // namespace

std::vector<std::string> checkTimestamps(Stage& stage, report::CaseResult& result) {
    result.trust.timestamp_rate = stage.timestampRate();
    std::vector<std::string> faults = rateFaults(result.trust.timestamp_rate);
    if (stage.isProcessor()) {
        std::ranges::move(pairFaults(stage, nullptr, {}), std::back_inserter(faults));
        return faults;
    }
    const auto plain = stage.player(engine::Timing::wall_clock);
    const std::vector<engine::FrameRecord> frames = playTwice(*plain);
    std::uint32_t steps = 0;
    for (const std::string& pass : passNames(frames)) {
        if (steps == 0) steps = detectableSteps(stage, pass, timeOf(frames, pass));
        addPlantedFaults(stage, {pass, steps}, {}, faults);
    }
    return faults;
}

namespace {

using Verdict = TimestampJudgement::Verdict;

double medianWall(std::span<const engine::FrameRecord> frames) {
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : frames) walls.push_back(frame.record + frame.wall);
    return report::quantile(walls, 0.5);
}

TimestampJudgement judgeByWallClock(
    Stage& stage, std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock, double end) {
    std::vector<std::string> faults = timestampFaults(isolated, wall_clock);
    if (faults.empty()) return {Verdict::right, {}};
    const double pair = (medianWall(isolated) + medianWall(wall_clock)) * 1e-3;
    if (stage.seconds() + kFewestPairs * pair > end) return {Verdict::unchecked, std::move(faults)};
    faults = pairFaults(stage, nullptr, [&] { return stage.seconds() + kPairs * pair <= end; });
    return {faults.empty() ? Verdict::right : Verdict::wrong, std::move(faults)};
}

TimestampJudgement judgeByPlantedWork(
    Stage& stage, std::span<const engine::FrameRecord> isolated, double end,
    DeviceKnowledge& known) {
    const std::vector<std::string> passes = passNames(isolated);
    const double frame = medianWall(isolated);
    // s, of the pairs between two checks; the work may take half as long again as planned.
    const double look = 2.0 * kPairs * (1.5 * kPlantedTime + frame) * 1e-3;
    // s, of the frames in which the work grows to its size.
    const double growth = (5.0 * kPlantedTime + 24.0 * frame) * 1e-3;
    if (known.planted_steps == 0) {
        if (stage.seconds() + growth + look > end) return {};
        const auto plain = stage.player(engine::Timing::wall_clock);
        const double without = timeOf(playTwice(*plain), passes.front());
        known.planted_steps = detectableSteps(stage, passes.front(), without);
    }
    const auto is_time = [&] { return stage.seconds() + look <= end; };
    std::size_t& checked = known.checked_passes[passes];
    std::vector<std::string> faults;
    while (checked < passes.size() && is_time())
        addPlantedFaults(stage, {passes[checked++], known.planted_steps}, is_time, faults);
    if (!faults.empty()) {
        checked = 0;
        return {Verdict::wrong, std::move(faults)};
    }
    return {checked == passes.size() ? Verdict::right : Verdict::unchecked, {}};
}

}  // namespace

TimestampJudgement judgeTimestamps(
    Stage& stage, std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock, double seconds, DeviceKnowledge* known,
    report::CaseResult& result) {
    const std::vector<std::string> passes = passNames(isolated);
    if (passes.empty()) return {Verdict::wrong, {"the device has no timestamps"}};
    DeviceKnowledge own;
    DeviceKnowledge& knowledge = known ? *known : own;
    const double end = stage.seconds() + seconds;
    if (!knowledge.timestamp_rate && seconds >= kRateTime)
        knowledge.timestamp_rate.emplace(stage.timestampRate());
    result.trust.timestamp_rate = knowledge.timestamp_rate.value_or(std::nullopt);
    std::vector<std::string> faults = rateFaults(result.trust.timestamp_rate);
    if (!faults.empty()) return {Verdict::wrong, std::move(faults)};
    if (std::ranges::find(knowledge.trusted_passes, passes) != knowledge.trusted_passes.end())
        return {Verdict::right, {}};
    TimestampJudgement judgement = stage.isProcessor()
                                       ? judgeByWallClock(stage, isolated, wall_clock, end)
                                       : judgeByPlantedWork(stage, isolated, end, knowledge);
    if (judgement.verdict == Verdict::right) knowledge.trusted_passes.push_back(passes);
    return judgement;
}

}  // namespace benchmarks::measure
