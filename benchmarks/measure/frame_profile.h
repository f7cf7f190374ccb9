#pragma once

#include <span>
#include <vector>

namespace benchmarks {

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

}  // namespace benchmarks
