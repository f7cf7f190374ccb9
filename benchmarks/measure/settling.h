#pragma once

#include <cstddef>
#include <span>

namespace benchmarks {

struct SettlingRule {
    double level = 0.01;  // of independent levels without a trend, so many series lose a round
    double tolerance = 0.01;  // a smaller change is none, as a share
};

// How many rounds at the start are to be left out because times still settled, from one level per
// round: the fewest after which nothing settles. Something does where
//   - the next 8, 16, 32 ... rounds, or all that are left, show a trend by Mann and Kendall's test
//     (steady_state.h), and the median of their first quarter is off that of their last; or
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

}  // namespace benchmarks
