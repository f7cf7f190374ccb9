#include "benchmarks/lod_difference.h"

#include <cassert>
#include <cmath>

namespace benchmarks {

namespace {

// Of difference(i), i running over the colours of all pixels.
template <class Difference>
double rootMeanSquareOf(std::size_t bytes, Difference difference) {
    double sum = 0.0;
    for (std::size_t i = 0; i < bytes; ++i) {
        if (i % 4 == 3) continue;  // alpha
        const double d = difference(i) / 255.0;
        sum += d * d;
    }
    return std::sqrt(sum / (0.75 * static_cast<double>(bytes)));
}

}  // namespace

double rootMeanSquare(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
    assert(a.size() == b.size());
    return rootMeanSquareOf(a.size(), [&](std::size_t i) { return int{a[i]} - int{b[i]}; });
}

double popping(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b) {
    assert(a.size() == b.size() && a.size() == full_a.size() && a.size() == full_b.size());
    return rootMeanSquareOf(a.size(), [&](std::size_t i) {
        return (int{b[i]} - int{a[i]}) - (int{full_b[i]} - int{full_a[i]});
    });
}

double whiteShare(std::span<const std::uint8_t> picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); i += 4) sum += picture[i] / 255.0;
    return sum / (0.25 * static_cast<double>(picture.size()));
}

}  // namespace benchmarks
