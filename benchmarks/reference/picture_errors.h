#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/report/report.h"
#include "engine/process.h"

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

// Errors between pictures: docs/rendering.md defines the figures.

struct PictureErrors {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    double rmse = 0.0;
    std::optional<double> psnr;  // dB; absent if infinite
    double ssim = 0.0;
    double flip = 0.0;
    // Ratio of the picture's mean linear light to the reference's; absent if the reference is
    // black.
    std::optional<double> light_ratio;
};

// Compares two files, PNG or EXR, and writes FLIP's error map if `map` is not empty. Throws
// engine::Error if the Python environment for references is missing, files can't be read, or their
// sizes differ.
PictureErrors comparePictures(
    const std::filesystem::path& reference, const std::filesystem::path& picture,
    const std::filesystem::path& map);

// Compares the pictures of a run's cases with /run/reference.
class ReferenceComparison {
public:
    // Adds the metrics image.* to `result`. If the environment is missing, it adds a warning once.
    // `rgba` is [row][column], top row first. Throws like comparePictures().
    void
    add(const std::filesystem::path& reference, std::uint32_t width, std::uint32_t height,
        std::span<const std::uint8_t> rgba, report::CaseResult& result);

private:
    bool isPossible(report::CaseResult& result);

    engine::ScratchFolder folder_;
    std::optional<bool> possible_;  // unset until known
};

// Runs a tool of benchmarks/reference/ in the environment of scripts/setup --reference, and passes
// on each line that it writes to stdout. Throws engine::Error with one line, or Interrupted.
// $HAIRBENCH_REFERENCE_PYTHON selects another interpreter.
void runReferenceTool(
    const std::string& script, const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line);

// Throws the error for a missing environment before the work that would need it.
void checkReferenceTool();

}  // namespace benchmarks::reference
