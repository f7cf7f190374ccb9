#pragma once

#include <cstdint>
#include <span>
#include <vector>

// Differences of pictures of one size, [row][column] RGBA, over the red, green and blue of all
// pixels; display values count from 0 to 1.
namespace benchmarks {

using Picture = std::vector<std::uint8_t>;

// Root of the mean square difference.
double rootMeanSquare(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

// What a level of detail changes from one step of a path to the next beyond what the step changes
// anyway: root mean square of (b - a) - (full_b - full_a).
double popping(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b);

// The mean red: what white things cover of a black picture.
double whiteShare(std::span<const std::uint8_t> picture);

}  // namespace benchmarks
