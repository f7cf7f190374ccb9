#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

// Whether a series of samples still drifts.
namespace benchmarks::measure {

// Kendall's correlation of samples with their order: Mann 1945, Nonparametric tests against trend,
// Econometrica 13. It takes samples to be independent where there is no trend.
struct Trend {
    double score;  // pairs that rise less pairs that fall, in order
    double p;      // two-sided, of a score at least as far from 0
};

// Exact for at most 33 samples without ties, otherwise the normal approximation with the variance
// for ties (Kendall 1970, Rank Correlation Methods, 4.4): scipy.stats.kendalltau's `auto`. Fewer
// than two samples, or all of them equal, have no trend: p is 1.
Trend trend(std::span<const double> samples);

// Median of the slopes between all pairs, in the samples' unit per sample: Theil 1950, Sen 1968.
// At least two samples, or engine::Error.
double medianSlope(std::span<const double> samples);

struct SteadyRule {
    std::size_t window = 32;    // the last so many samples are looked at
    double level = 0.01;        // of white noise, at most this share of windows seem to drift
    double tolerance = 0.01;    // a drift over the window below this share of its median is none
};

// Whether the last window shows no trend that is both significant and large enough to matter. False
// while there are fewer samples than the window has. A window that wrongly seems to drift costs a
// few samples more, as the next one is looked at.
bool isSteady(std::span<const double> samples, const SteadyRule& rule = {});

// Times of rounds that play the same frames, [round][frame], ms. Every round has as many frames.
using RoundTimes = std::vector<std::vector<double>>;

// Each time over the median of the same frame in all rounds, one round after the other: what is
// left when frames have more or less to do, which is no drift and no noise. Nothing is left of a
// single round: all ones.
std::vector<double> withoutProfile(const RoundTimes& rounds);

// The median of each round in withoutProfile(), 1 for a round like most.
std::vector<double> roundLevels(const RoundTimes& rounds);

// All times in order.
std::vector<double> allTimes(std::span<const std::vector<double>> rounds);

// What a mode's rounds say of the frame time so far.
struct Assessment {
    std::size_t settling = 0;  // rounds at the start to leave out: settlingRounds()
    std::optional<bool> steady;  // no drift in the last 32 frames; absent: too few to tell
    double median = 0.0;  // ms, of the rounds that are not left out, as what follows
    // Half the median's 95 % interval over it; absent: too few times for an interval. The interval
    // is that of independent times, as few as effectiveSamples() finds when what every round does
    // alike is taken out. As each round has every frame once, this is too wide rather than too
    // narrow where frames differ much.
    std::optional<double> relative_half_width;
};

// At least one round, and as many frames in each.
Assessment assess(const RoundTimes& rounds);

// Whether no more rounds are needed: the last frames were steady, and the interval is narrow.
bool isEnough(const Assessment& assessment, double precision);

struct SettlingRule {
    double level = 0.01;  // of independent levels without a trend, so many series lose a round
    double tolerance = 0.01;  // a smaller change is none, as a share
};

// How many rounds at the start are to be left out because times still settled, from one level per
// round: the fewest after which nothing settles. Something does where
//   - the next 8, 16, 32 ... rounds, or all that are left, show a trend by Mann and Kendall's test
//   (trend()),
//     and the median of their first quarter is off that of their last; or
//   - the next 2, 3 or 4 rounds are all above or all below all that follow, which of n rounds in
//     random order happens to k with a chance of 2 / binomial(n, k), and their median is off
// by more than the tolerance. Each test has its share of the level (Bonferroni). Long stretches
// find what creeps, short ones what settles soon; what a single round does can't be told from
// noise.
//
// 0 with fewer than 8 rounds left to look at; and 0 where leaving out half the rounds would not do:
// what drifts to the end does not settle, and no part of it is better than another. Long series are
// looked at in 64 blocks of rounds.
std::size_t settlingRounds(std::span<const double> levels, const SettlingRule& rule = {});

}  // namespace benchmarks::measure
