#include "benchmarks/measure/trust.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"
#include "engine/error.h"

namespace benchmarks::measure {
namespace {

// ---- Trend of a series --------------------------------------------------------------------------

constexpr std::size_t kMostExact = 33;

// Probabilities of the number of inversions of a random order of n, from 0 up. The n-th item may
// stand before 0 ... n - 1 of the others.
std::vector<double> inversionProbabilities(std::size_t n) {
    std::vector<double> probabilities{1.0};
    for (std::size_t i = 2; i <= n; ++i) {
        std::vector<double> next(probabilities.size() + i - 1, 0.0);
        for (std::size_t count = 0; count < probabilities.size(); ++count)
            for (std::size_t more = 0; more < i; ++more)
                next[count + more] += probabilities[count] / static_cast<double>(i);
        probabilities = std::move(next);
    }
    return probabilities;
}

double exactP(std::size_t n, double score) {
    const std::vector<double> probabilities = inversionProbabilities(n);
    const auto pairs = static_cast<double>(probabilities.size() - 1);
    const auto fewest = static_cast<std::size_t>(std::lround(0.5 * (pairs - std::abs(score))));
    double tail = 0.0;
    for (std::size_t count = 0; count <= fewest; ++count) tail += probabilities[count];
    return std::min(1.0, 2.0 * tail);
}

// Sums over the groups of t equal samples.
struct Ties {
    double pairs = 0.0;  // t (t - 1)
    double spread = 0.0;  // t (t - 1) (2 t + 5)
};

Ties tiesOf(std::span<const double> sorted) {
    Ties ties;
    for (auto first = sorted.begin(); first != sorted.end();) {
        const auto next = std::upper_bound(first, sorted.end(), *first);
        const auto t = static_cast<double>(next - first);
        ties.pairs += t * (t - 1.0);
        ties.spread += t * (t - 1.0) * (2.0 * t + 5.0);
        first = next;
    }
    return ties;
}

// Sorts values and returns the number of pairs of which the later one was less than the earlier.
double sortCountingDescents(std::span<double> values) {
    if (values.size() < 2) return 0.0;
    const std::span<double> first = values.first(values.size() / 2);
    const std::span<double> second = values.subspan(first.size());
    double descents = sortCountingDescents(first) + sortCountingDescents(second);
    std::size_t passed = 0;
    for (const double value : second) {
        while (passed < first.size() && first[passed] <= value) ++passed;
        descents += static_cast<double>(first.size() - passed);
    }
    std::ranges::inplace_merge(values, second.begin());
    return descents;
}

}  // namespace

Trend trend(std::span<const double> samples) {
    // Pairs that ascend, less those that descend. Knight 1966, A computer method for calculating
    // Kendall's tau with ungrouped data.
    std::vector<double> sorted(samples.begin(), samples.end());
    const double descents = sortCountingDescents(sorted);
    const Ties ties = tiesOf(sorted);
    const auto n = static_cast<double>(samples.size());
    const double score = 0.5 * (n * (n - 1.0) - ties.pairs) - 2.0 * descents;
    if (samples.size() < 2 || ties.pairs == n * (n - 1.0)) return {score, 1.0};
    if (samples.size() <= kMostExact && ties.pairs == 0.0)
        return {score, exactP(samples.size(), score)};
    // Time has no ties, so the terms for ties in both orders vanish.
    const double variance = (n * (n - 1.0) * (2.0 * n + 5.0) - ties.spread) / 18.0;
    return {score, std::erfc(std::abs(score) / std::sqrt(variance) / std::numbers::sqrt2)};
}

double medianSlope(std::span<const double> samples) {
    if (samples.size() < 2) throw engine::Error("median slope", "fewer than two samples");
    std::vector<double> slopes;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (std::size_t j = i + 1; j < samples.size(); ++j)
            slopes.push_back((samples[j] - samples[i]) / static_cast<double>(j - i));
    return report::quantile(slopes, 0.5);
}

bool isSteady(std::span<const double> samples, const SteadyRule& rule) {
    if (samples.size() < std::max<std::size_t>(rule.window, 1)) return false;
    const std::span<const double> window = samples.last(rule.window);
    if (trend(window).p > rule.level) return true;
    const double drift = std::abs(medianSlope(window)) * static_cast<double>(rule.window - 1);
    return drift <= rule.tolerance * std::abs(report::quantile(window, 0.5));
}

// ---- Times relative to their frame --------------------------------------------------------------

std::vector<double> withoutProfile(const RoundTimes& rounds) {
    std::vector<double> relative = allTimes(rounds);
    if (rounds.empty()) return relative;
    const std::size_t frames = rounds.front().size();
    for (std::size_t frame = 0; frame < frames; ++frame) {
        std::vector<double> same;
        for (const std::vector<double>& round : rounds) same.push_back(round[frame]);
        const double usual = report::quantile(same, 0.5);
        // Times of 0 are below the clock's resolution and count as equal.
        for (std::size_t i = frame; i < relative.size(); i += frames)
            relative[i] = usual > 0.0 ? relative[i] / usual : 1.0;
    }
    return relative;
}

std::vector<double> roundLevels(const RoundTimes& rounds) {
    const std::vector<double> relative = withoutProfile(rounds);
    std::vector<double> levels;
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const std::size_t frames = rounds[i].size();
        levels.push_back(report::quantile(std::span(relative).subspan(i * frames, frames), 0.5));
    }
    return levels;
}

std::vector<double> allTimes(std::span<const std::vector<double>> rounds) {
    std::vector<double> times;
    for (const std::vector<double>& round : rounds)
        times.insert(times.end(), round.begin(), round.end());
    return times;
}

namespace {

// ---- Rounds that still settle -------------------------------------------------------------------

constexpr std::size_t kShortest = 8;  // 2 / 8! is below any share of the level
constexpr std::size_t kMostBlocks = 64;  // the tests take time cubic in this
constexpr std::size_t kHeads[] = {2, 3, 4};

using Levels = std::span<const double>;

bool areOff(Levels some, Levels others, double tolerance) {
    const double usual = report::quantile(others, 0.5);
    return std::abs(report::quantile(some, 0.5) - usual) > tolerance * std::abs(usual);
}

bool hasTrend(Levels levels, double level, double tolerance) {
    const std::size_t quarter = std::max<std::size_t>(levels.size() / 4, 1);
    return trend(levels).p <= level &&
           areOff(levels.first(quarter), levels.last(quarter), tolerance);
}

double binomial(std::size_t n, std::size_t k) {
    double ways = 1.0;
    for (std::size_t i = 1; i <= k; ++i)
        ways *= static_cast<double>(n - k + i) / static_cast<double>(i);
    return ways;
}

bool standsApart(Levels levels, std::size_t head, double level, double tolerance) {
    const Levels first = levels.first(head);
    const Levels rest = levels.subspan(head);
    const bool apart = std::ranges::min(first) > std::ranges::max(rest) ||
                       std::ranges::max(first) < std::ranges::min(rest);
    return apart && 2.0 / binomial(levels.size(), head) <= level && areOff(first, rest, tolerance);
}

bool settles(Levels levels, const SettlingRule& rule) {
    std::vector<std::size_t> stretches;
    for (std::size_t length = kShortest; length < levels.size(); length *= 2)
        stretches.push_back(length);
    stretches.push_back(levels.size());
    const double level = rule.level / static_cast<double>(stretches.size() + std::size(kHeads));
    return std::ranges::any_of(
               stretches,
               [&](std::size_t length) {
                   return hasTrend(levels.first(length), level, rule.tolerance);
               }) ||
           std::ranges::any_of(kHeads, [&](std::size_t head) {
               return standsApart(levels, head, level, rule.tolerance);
           });
}

}  // namespace

std::size_t settlingRounds(std::span<const double> levels, const SettlingRule& rule) {
    const std::size_t size = (levels.size() + kMostBlocks - 1) / kMostBlocks;  // rounds per block
    std::vector<double> blocks;
    for (std::size_t i = 0; size > 0 && i + size <= levels.size(); i += size)
        blocks.push_back(report::quantile(levels.subspan(i, size), 0.5));
    for (std::size_t left_out = 0;
         left_out <= blocks.size() / 2 && blocks.size() - left_out >= kShortest; ++left_out)
        if (!settles(std::span(blocks).subspan(left_out), rule)) return left_out * size;
    return 0;
}

namespace {

// ---- Assessment ---------------------------------------------------------------------------------

constexpr double kAlpha = 0.05;  // of the interval

// With a single round, frames have no counterpart to compare with.
bool isComparable(const RoundTimes& rounds) { return rounds.size() > 1; }

// Half of the median's interval over the median; infinite if there are too few times.
double halfWidth(const RoundTimes& rounds) {
    const std::vector<double> times = allTimes(rounds);
    return report::relativeHalfWidth(report::medianInterval(
        times, kAlpha,
        report::effectiveSamples(isComparable(rounds) ? withoutProfile(rounds) : times)));
}

}  // namespace

Assessment assess(const RoundTimes& rounds, std::span<const RoundTimes> parts) {
    Assessment result{.settling = settlingRounds(roundLevels(rounds))};
    const RoundTimes kept(
        rounds.begin() + static_cast<std::ptrdiff_t>(result.settling), rounds.end());
    const std::vector<double> relative = withoutProfile(kept);
    const SteadyRule rule;
    if (isComparable(kept) && relative.size() >= rule.window)
        result.steady = isSteady(relative, rule);
    result.median = report::quantile(allTimes(kept), 0.5);
    double width = halfWidth(kept);
    for (const RoundTimes& part : parts) {
        const RoundTimes kept_part(
            part.begin() + static_cast<std::ptrdiff_t>(result.settling), part.end());
        if (report::quantile(allTimes(kept_part), 0.5) >= kLeastPart * result.median)
            width = std::max(width, halfWidth(kept_part));
    }
    if (std::isfinite(width)) result.relative_half_width = width;
    return result;
}

bool isEnough(const Assessment& assessment, double precision) {
    return precision > 0.0 && assessment.steady.value_or(false) &&
           assessment.relative_half_width.has_value() &&
           *assessment.relative_half_width <= precision;
}

// ---- Trust in times of passes -------------------------------------------------------------------

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
