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

// How far pictures are from others: docs/rendering.md says what the figures are.
namespace benchmarks::reference {

struct PictureErrors {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    double rmse = 0.0;
    std::optional<double> psnr;  // dB; absent where it is infinite
    double ssim = 0.0;
    double flip = 0.0;
    // Mean linear light of the picture over that of the reference; absent where that is black.
    std::optional<double> light_ratio;
};

// Compares two files, PNG or EXR; writes FLIP's error map where `map` is not empty. Throws
// engine::Error where the environment of references is missing, files can't be read or their sizes
// differ.
PictureErrors comparePictures(
    const std::filesystem::path& reference, const std::filesystem::path& picture,
    const std::filesystem::path& map);

// Holds the pictures of a run's cases against /run/reference.
class ReferenceComparison {
public:
    // Adds the metrics image.* to `result`. Where the environment is missing it adds a warning,
    // once. `rgba` is [row][column], top row first. Throws as comparePictures.
    void
    add(const std::filesystem::path& reference, std::uint32_t width, std::uint32_t height,
        std::span<const std::uint8_t> rgba, report::CaseResult& result);

private:
    bool isPossible(report::CaseResult& result);

    engine::ScratchFolder folder_;
    std::optional<bool> possible_;  // once it is known
};

// Runs a tool of benchmarks/reference/ in the environment of scripts/setup --reference and hands
// over each line that it writes to stdout. Throws engine::Error of one line, or Interrupted.
// $HAIRBENCH_REFERENCE_PYTHON is an interpreter to use instead.
void runReferenceTool(
    const std::string& script, const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line);

// Throws the error of a missing environment before the work that would need it.
void checkReferenceTool();

}  // namespace benchmarks::reference
