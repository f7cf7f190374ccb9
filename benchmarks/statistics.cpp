#include "benchmarks/statistics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/error.h"

namespace benchmarks {
namespace {

constexpr double kMillisecondsPerSecond = 1000.0;

template <class Order = std::less<>>
std::vector<double> sorted(std::span<const double> samples, Order order = {}) {
    if (samples.empty()) throw engine::Error("statistics", "no samples");
    std::vector<double> copy(samples.begin(), samples.end());
    std::ranges::sort(copy, order);
    return copy;
}

double quantileOfSorted(std::span<const double> values, double p) {
    const double position = static_cast<double>(values.size() - 1) * std::clamp(p, 0.0, 1.0);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], position - static_cast<double>(below));
}

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double relativeDeviation(std::span<const double> values, double mean) {
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    if (squares == 0.0) return 0.0;
    const double deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
    return mean == 0.0 ? std::numeric_limits<double>::infinity() : deviation / std::abs(mean);
}

}  // namespace

Summary summarize(std::span<const double> samples) {
    const std::vector<double> values = sorted(samples);
    const double median = quantileOfSorted(values, 0.5);
    const double mean = sum(values) / static_cast<double>(values.size());
    std::vector<double> deviations = values;
    for (double& value : deviations) value = std::abs(value - median);
    return {
        .count = values.size(),
        .minimum = values.front(),
        .first_quartile = quantileOfSorted(values, 0.25),
        .median = median,
        .third_quartile = quantileOfSorted(values, 0.75),
        .maximum = values.back(),
        .mean = mean,
        .mad = quantileOfSorted(sorted(deviations), 0.5),
        .relative_deviation = relativeDeviation(values, mean)};
}

double quantile(std::span<const double> samples, double p) {
    return quantileOfSorted(sorted(samples), p);
}

double framesPerSecond(std::span<const double> frame_ms) {
    if (frame_ms.empty()) throw engine::Error("statistics", "no samples");
    return kMillisecondsPerSecond * static_cast<double>(frame_ms.size()) / sum(frame_ms);
}

LowRates lowRates(std::span<const double> frame_ms, double fraction) {
    const std::vector<double> longest = sorted(frame_ms, std::greater<>{});
    // The tolerance keeps a product such as 0.01 * 300 = 3.0000000000000004 from counting a fourth
    // frame.
    const double share = fraction * static_cast<double>(longest.size());
    const auto worst = std::clamp(
        static_cast<std::size_t>(std::ceil(share - 1e-9)), std::size_t{1}, longest.size());
    const double worst_mean = sum(std::span(longest).first(worst)) / static_cast<double>(worst);
    const double budget = fraction * sum(longest);
    std::size_t last = 0;
    for (double spent = longest[0]; spent < budget && last + 1 < longest.size();)
        spent += longest[++last];
    return {
        .percentile = kMillisecondsPerSecond / quantile(frame_ms, 1.0 - fraction),
        .mean = kMillisecondsPerSecond / worst_mean,
        .integral = kMillisecondsPerSecond / longest[last]};
}

}  // namespace benchmarks
