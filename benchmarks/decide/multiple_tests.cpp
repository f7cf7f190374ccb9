#include "benchmarks/decide/multiple_tests.h"

#include <algorithm>
#include <numeric>

#include "engine/error.h"

namespace benchmarks {

std::vector<double> falseDiscoveryAdjusted(std::span<const double> p_values) {
    if (!std::ranges::all_of(p_values, [](double p) { return p >= 0.0 && p <= 1.0; }))
        throw engine::Error("false discovery rate", "a p-value is outside [0, 1]");
    std::vector<std::size_t> descending(p_values.size());
    std::iota(descending.begin(), descending.end(), std::size_t{0});
    std::ranges::sort(descending, std::greater<>{}, [&](std::size_t i) { return p_values[i]; });
    std::vector<double> adjusted(p_values.size());
    double smallest = 1.0;
    std::size_t rank = p_values.size();
    for (const std::size_t i : descending) {
        const double ratio = static_cast<double>(p_values.size()) / static_cast<double>(rank--);
        smallest = std::min(smallest, p_values[i] * ratio);
        adjusted[i] = smallest;
    }
    return adjusted;
}

}  // namespace benchmarks
