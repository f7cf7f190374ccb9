#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/roofline.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "hair/settings.h"

// Compares strand back ends in more than their times: /run/compare_backends.
namespace benchmarks::run {

// The area that a case's hair covers without blending.
struct Covered {
    std::uint64_t samples = 0;  // of the rendered pixels
    std::uint64_t pixels = 0;  // pixels of the picture with a covered sample
};

// Counts the covered samples from two pictures, [row][column] RGBA, that differ only in the hair,
// which is white in one and black in the other. The difference of a pixel is the share of its
// `samples` that show hair. Throws engine::Error for pictures of different sizes.
Covered coveredBy(
    std::span<const std::uint8_t> white, std::span<const std::uint8_t> black,
    std::uint32_t samples);

// Compares the picture of each case of a run with the picture by `tessellation` and with one of 64
// samples per pixel.
class BackendComparison {
public:
    // Adds image.flip.tessellation, image.flip.many_samples, strands.*, device.* and the counts
    // points, covered_samples and covered_pixels to a measured case; `picture` is its last picture.
    // Adds a warning for anything that cannot be determined. Replays the case's simulation and
    // draws some pictures, but leaves its settings and results unchanged.
    void
    add(const engine::Device& device, measure::Case& test_case, hair::Settings settings,
        std::span<const std::uint8_t> picture, report::CaseResult& result);

private:
    // A picture to compare with, by the first back end that can draw it here.
    struct Reference {
        std::vector<std::uint8_t> pixels;  // empty if it is missing
        std::string missing;  // reason
    };
    // `settings` may differ from the case's settings only as Case::rendererOf() allows; `state` is
    // the hash of the drawn state.
    const Reference& reference(
        const engine::Device& device, const measure::Case& test_case, hair::Settings settings,
        std::span<const hair::Backend> ways, const std::string& state);

    std::optional<measure::DeviceLimits> limits_;
    std::map<std::string, Reference> references_;  // by state, settings and extensions
};

}  // namespace benchmarks::run
