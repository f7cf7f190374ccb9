#pragma once

#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

namespace benchmarks {

// Each p-value as Benjamini and Hochberg adjust it (1995, Controlling the false discovery rate, J.
// R. Statist. Soc. B 57): the smallest rate of false discoveries at which its test is among the
// rejected, in the order given; scipy.stats.false_discovery_control. The rate holds for tests that
// are independent or positively dependent (Benjamini and Yekutieli 2001), as passes are that slow
// down together. Values outside [0, 1] are an engine::Error.
std::vector<double> falseDiscoveryAdjusted(std::span<const double> p_values);

// A decision may be tried after 12 pairs, after 24 and after 48. Each try has a third of the whole
// level (Bonferroni): whatever makes one go on, the chance of any false decision, and the rate of
// false discoveries at whichever try it ends, is at most the sum. Spending functions that leave
// more for the last try (O'Brien and Fleming 1979) would have little left for the first, at which
// most gates should end.
inline constexpr std::size_t kStages[] = {12, 24, 48};

inline constexpr double stageLevel(double whole_level) {
    return whole_level / static_cast<double>(std::size(kStages));
}

}  // namespace benchmarks
