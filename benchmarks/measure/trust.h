#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/stage.h"
#include "benchmarks/report/report.h"
#include "engine/frame_loop.h"

// Tests whether a series of samples still drifts.

namespace benchmarks::measure {

// Kendall's correlation of samples with their order: Mann 1945, Nonparametric tests against trend,
// Econometrica 13. It assumes independent samples under the null hypothesis.
struct Trend {
    double score;  // rising pairs less falling pairs, in order
    double p;      // two-sided, for a score at least as far from 0
};

// Exact for at most 33 samples without ties. Otherwise it is the normal approximation with the
// variance for ties (Kendall 1970, Rank Correlation Methods, 4.4), as with `auto` of
// scipy.stats.kendalltau. Fewer than two samples, or all equal samples, have no trend: p is 1.
Trend trend(std::span<const double> samples);

// Median of the slopes between all pairs, in the samples' unit per sample: Theil 1950, Sen 1968.
// Throws engine::Error for fewer than two samples.
double medianSlope(std::span<const double> samples);

struct SteadyRule {
    std::size_t window = 32;    // number of samples at the end that are tested
    double level = 0.01;  // at most this share of windows of white noise is judged to drift
    double tolerance = 0.01;  // a drift over the window below this share of its median is ignored
};

// True if the last window shows no trend that is both significant and large enough to matter. False
// while there are fewer samples than the window has. A wrong result of drift costs only a few more
// samples, because the next window is tested too.
bool isSteady(std::span<const double> samples, const SteadyRule& rule = {});

// Times of rounds that play the same frames, [round][frame], ms. Every round has the same number of
// frames.
using RoundTimes = std::vector<std::vector<double>>;

// Each time divided by the median of the same frame in all rounds, round by round. This removes the
// differences between frames, which are neither drift nor noise. A single round gives all ones.
std::vector<double> withoutProfile(const RoundTimes& rounds);

// The median of each round in withoutProfile(); 1 for a typical round.
std::vector<double> roundLevels(const RoundTimes& rounds);

// All times in order.
std::vector<double> allTimes(std::span<const std::vector<double>> rounds);

// Assessment of the frame time from a mode's rounds so far.
struct Assessment {
    std::size_t settling = 0;  // rounds to leave out at the start: settlingRounds()
    std::optional<bool> steady;  // no drift in the last 32 frames; absent: too few to tell
    double median = 0.0;  // ms, of the rounds that are not left out, like the following
    // Half of the median's 95 % interval, relative to the median; absent: too few times for an
    // interval. The interval assumes independent times. Their number is that of effectiveSamples()
    // after the pattern common to all rounds is removed. As each round has every frame once, the
    // interval is too wide rather than too narrow where frames differ much.
    std::optional<double> relative_half_width;
};

// Parts below this share of the whole need not be known to a precision.
inline constexpr double kLeastPart = 0.02;

// Needs at least one round. All rounds must have the same number of frames. `parts` are the times
// of parts of the same frames: the relative half width is then that of the least known among them
// and the whole. Parts below kLeastPart of the whole do not count.
Assessment assess(const RoundTimes& rounds, std::span<const RoundTimes> parts = {});

// True if no more rounds are needed: the last frames were steady, and the interval is narrow.
bool isEnough(const Assessment& assessment, double precision);

struct SettlingRule {
    double level = 0.01;  // at most this share of series of independent levels without a trend
                          // loses a round
    double tolerance = 0.01;  // as a share; smaller changes are ignored
};

// Number of rounds at the start to leave out because times were still settling, from one level per
// round: the fewest after which nothing settles. Times are settling if
//   - the next 8, 16, 32 ... rounds, or all remaining ones, show a trend by Mann and Kendall's test
// (trend()), and the median of their first quarter differs from that of their last; or
//   - the next 2, 3 or 4 rounds are all above or all below all later ones, and their median
// differs. For k of n rounds in random order the first happens with a probability of 2 /
// binomial(n, k).
// Differences must exceed the tolerance. Each test has its share of the level (Bonferroni). Long
// stretches find slow drift, short ones fast settling. A single round cannot be told from noise.
//
// Returns 0 if fewer than 8 rounds would be left. Also returns 0 if leaving out half of the rounds
// is not enough: times that drift to the end do not settle, and no part of them is better than
// another. Long series are tested in 64 blocks of rounds.
std::size_t settlingRounds(std::span<const double> levels, const SettlingRule& rule = {});

// Checks whether times of passes can be trusted.

// Greatest time that a submission and the wait for it add to a pass by itself, ms.
inline constexpr double kSubmissionCost = 0.5;

// Largest error of a pass, as a share of the whole frame. A smaller error does not mislead about
// where the time goes.
inline constexpr double kFrameShare = 0.02;

// Faults of a device's timestamps: compares isolated frames by timestamps with frames whose passes
// were submitted and waited for one by one, using the fastest of each. A pass is named if it
// differs by more than report::kTrustTolerance, kSubmissionCost and kFrameShare together. Empty:
// the timestamps are right.
std::vector<std::string> timestampFaults(
    std::span<const engine::FrameRecord> isolated, std::span<const engine::FrameRecord> wall_clock);

// Plays frames in one timing mode.
struct PlayedFrames {
    std::function<void()> play;  // one frame
    std::function<std::vector<engine::FrameRecord>()> finish;  // waits; frames since the last call
};

// Alternates isolated frames with frames whose passes are submitted and waited for one at a time,
// and returns the result of timestampFaults(). A fault of the device persists, but a disturbance
// passes: while there are faults, more pairs are played, up to 16 and while `is_time` is true. An
// empty `is_time` sets no limit.
std::vector<std::string> checkTimestamps(
    const PlayedFrames& timestamped, const PlayedFrames& clocked,
    const std::function<bool()>& is_time = {});

// Checks the timestamps of a case in the same way, and their rate too (trust.timestamp_rate),
// without a time limit. Passes of some microseconds are shorter than their submission. On a GPU,
// work of 10 ms is therefore planted in one pass after another, and both clocks must find all of it
// there and nowhere else.
std::vector<std::string> checkTimestamps(Stage& stage, report::CaseResult& result);

// The verdict on a case's timestamps.
struct TimestampJudgement {
    enum class Verdict { right, wrong, unchecked };
    Verdict verdict = Verdict::unchecked;
    std::vector<std::string> faults;  // for an unchecked case, from frames that were not alternated
};

// Judges the timestamps of isolated frames. On a processor they are compared with wall-clock frames
// that were played anyway; alternating pairs are played only if the two differ. On other devices
// planted work is used as in checkTimestamps(). Both take at most `seconds`; whatever does not fit
// is unchecked. `known` remembers the passes found right. In a run, frames of the same passes are
// not checked again, and unchecked passes are checked later. It may be null.
TimestampJudgement judgeTimestamps(
    Stage& stage, std::span<const engine::FrameRecord> isolated,
    std::span<const engine::FrameRecord> wall_clock, double seconds, DeviceKnowledge* known,
    report::CaseResult& result);

}  // namespace benchmarks::measure
