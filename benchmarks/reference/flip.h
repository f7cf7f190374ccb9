#pragma once

#include <cstdint>
#include <span>

// FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, FLIP: A
// Difference Evaluator for Alternating Images, HPG. It estimates the differences that a viewer sees
// when flipping between two pictures.
namespace benchmarks::reference {

// Mean error of a picture, 0 to 1, for the paper's display: 0.7 m wide with 3840 px, seen from 0.7
// m (67 px per degree). Both pictures are [row][column] RGBA, display-referred, of `width` x
// `height` px; alpha is ignored. Throws engine::Error for different sizes or empty pictures.
double flipError(
    std::span<const std::uint8_t> reference, std::span<const std::uint8_t> picture,
    std::uint32_t width, std::uint32_t height);

}  // namespace benchmarks::reference
