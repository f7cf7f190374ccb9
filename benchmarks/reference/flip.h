#pragma once

#include <cstdint>
#include <span>

// FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, FLIP: A
// Difference Evaluator for Alternating Images, HPG; what a viewer sees who flips between two
// pictures.
namespace benchmarks::reference {

// Mean error of a picture, 0 to 1, for a display 0.7 m wide of 3840 px seen from 0.7 m (67 px a
// degree), the paper's. Both are [row][column] RGBA, display-referred, of `width` x `height` px;
// alpha is ignored. Sizes that differ, and empty pictures, are an engine::Error.
double flipError(
    std::span<const std::uint8_t> reference, std::span<const std::uint8_t> picture,
    std::uint32_t width, std::uint32_t height);

}  // namespace benchmarks::reference
