#pragma once

#include <span>

#include "benchmarks/decide/signed_rank.h"

// How well a median is known, without assuming a distribution.
namespace benchmarks {

// The sample's median and two of its order statistics between which the distribution's median lies,
// for independent samples: David and Nagaraja 2003, Order Statistics, 7.1. `samples` may count as
// `effective` independent ones, fewer than they are: the ranks then lie further apart, in the same
// proportion to what is between the ends. An infinite interval with confidence 1 where so few can
// give none (2^(1 - n) > alpha). No sample is an engine::Error.
MedianInterval medianInterval(std::span<const double> samples, double alpha, double effective);
MedianInterval medianInterval(std::span<const double> samples, double alpha);

// How many independent samples tell as much of the median as these, in the order in which they were
// taken; between 1 and their number. What counts for a median is how being above it is correlated
// from sample to sample (Heidelberger and Lewis 1984, Quantile estimation in dependent sequences,
// Operations Research 32); these correlations are added up as Geyer's initial monotone sequence
// does (1992, Practical Markov chain Monte Carlo, Statistical Science 7).
double effectiveSamples(std::span<const double> samples);

// Half the interval over the median's magnitude; infinite for a median of 0 or no interval.
double relativeHalfWidth(const MedianInterval& interval);

struct PrecisionRule {
    double target = 0.01;  // relative half width
    double alpha = 0.05;
};

// The stopping rule of a measurement: its median is known well enough, samples being as dependent
// as they look. Looking after every frame makes the last interval somewhat too narrow on average;
// it decides how long to measure and nothing else.
bool isPrecise(std::span<const double> samples, const PrecisionRule& rule = {});

}  // namespace benchmarks
