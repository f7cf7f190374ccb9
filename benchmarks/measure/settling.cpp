#include "benchmarks/measure/settling.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "benchmarks/decide/steady_state.h"
#include "benchmarks/statistics.h"

namespace benchmarks {

namespace {

constexpr std::size_t kShortest = 8;  // 2 / 8! is below any share of the level
constexpr std::size_t kMostBlocks = 64;  // the tests take time with the cube of it
constexpr std::size_t kHeads[] = {2, 3, 4};

using Levels = std::span<const double>;

bool areOff(Levels some, Levels others, double tolerance) {
    const double usual = quantile(others, 0.5);
    return std::abs(quantile(some, 0.5) - usual) > tolerance * std::abs(usual);
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
    const std::size_t size = (levels.size() + kMostBlocks - 1) / kMostBlocks;  // rounds to a block
    std::vector<double> blocks;
    for (std::size_t i = 0; size > 0 && i + size <= levels.size(); i += size)
        blocks.push_back(quantile(levels.subspan(i, size), 0.5));
    for (std::size_t left_out = 0;
         left_out <= blocks.size() / 2 && blocks.size() - left_out >= kShortest; ++left_out)
        if (!settles(std::span(blocks).subspan(left_out), rule)) return left_out * size;
    return 0;
}

}  // namespace benchmarks
