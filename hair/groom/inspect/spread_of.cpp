#include "hair/groom/inspect/spread_of.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hair {

Spread spreadOf(std::vector<float>& numbers) {
    if (numbers.empty()) return {};
    const auto quantile = [&](double share) {
        const double rank = share * static_cast<double>(numbers.size() - 1);
        const auto below = numbers.begin() + static_cast<std::ptrdiff_t>(rank);
        std::ranges::nth_element(numbers, below);
        const double fraction = rank - std::floor(rank);
        if (fraction == 0.0) return double{*below};
        return std::lerp(
            double{*below}, double{*std::min_element(below + 1, numbers.end())}, fraction);
    };
    return {
        .minimum = quantile(0.0),
        .quartile1 = quantile(0.25),
        .median = quantile(0.5),
        .quartile3 = quantile(0.75),
        .maximum = quantile(1.0),
        .mean = std::accumulate(numbers.begin(), numbers.end(), 0.0) /
                static_cast<double>(numbers.size())};
}

}  // namespace hair
