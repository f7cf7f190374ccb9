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

// What compares strand back ends beside their times: /run/compare_backends.
namespace benchmarks::run {

// What a case's hair covers where nothing is blended.
struct Covered {
    std::uint64_t samples = 0;  // of the rendered pixels' samples
    std::uint64_t pixels = 0;  // of the picture, that it covers a sample of
};

// Of two pictures, [row][column] RGBA, that differ in the hair alone, which is white in one and
// black in the other: each pixel's difference is the share of its `samples` that show hair.
// Pictures of different sizes are an engine::Error.
Covered coveredBy(
    std::span<const std::uint8_t> white, std::span<const std::uint8_t> black,
    std::uint32_t samples);

// The cases of a run, whose pictures are each compared with that of `tessellation` and with one of
// 64 samples a pixel.
class BackendComparison {
public:
    // Adds image.flip.tessellation, image.flip.many_samples, strands.* and device.*, and the counts
    // points, covered_samples and covered_pixels to a case that was measured, whose last picture
    // `picture` is; for what can't be had a warning. Plays the case's simulation once more and
    // draws some pictures: for what the case itself is, nothing changes.
    void
    add(const engine::Device& device, measure::Case& test_case, hair::Settings settings,
        std::span<const std::uint8_t> picture, report::CaseResult& result);

private:
    // A picture that others are held against, by the first back end that draws it here.
    struct Reference {
        std::vector<std::uint8_t> pixels;  // none where it is missing
        std::string missing;  // why
    };
    // `settings` may differ from the case's in what Case::rendererOf() allows; `state` is the hash
    // of what is drawn.
    const Reference& reference(
        const engine::Device& device, const measure::Case& test_case, hair::Settings settings,
        std::span<const hair::Backend> ways, const std::string& state);

    std::optional<measure::DeviceLimits> limits_;
    std::map<std::string, Reference> references_;  // by what they show
};

}  // namespace benchmarks::run
