#pragma once

#include <cstddef>
#include <span>

// Whether a series of samples still drifts.
namespace benchmarks {

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

}  // namespace benchmarks
