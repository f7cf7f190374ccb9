#pragma once

#include <cstddef>
#include <span>

namespace benchmarks {

// The smallest slowdown of one metric, a share, that a gate of 48 pairs calls a regression in nine
// of ten gates on a machine whose pairs of one build differ by `differences` = ln(A2/A1), where
// `decisive_change` is tau and nothing else of the gate's `metrics` is slower, so that it has to
// hold against the strictest step of Benjamini and Hochberg.
//
// A gate is drawn as 48 of the differences, with replacement, either sign being as likely in pairs
// of one build. A slowdown s moves all 48 by ln(1 + s), so that the gate finds it if the lower end
// of the 48's signed-rank interval, at the level of the last decision, is above ln(1 + tau) -
// ln(1 + s). The result is the s for which that is so in 90 % of the draws. At least two
// differences or engine::Error. The draws are the same every time.
double
smallestSlowdown(std::span<const double> differences, double decisive_change, std::size_t metrics);

}  // namespace benchmarks
