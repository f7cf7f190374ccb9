#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "hair/settings.h"

// The roofline of drawing strands (Williams, Waterman and Patterson 2009, Roofline: An Insightful
// Visual Performance Model): the least data and operations of a back end, the device's limits, and
// the resulting minimum time.
namespace benchmarks::measure {

// Kinds of stages with arithmetic. Tessellation and geometry stages count as vertex; task and mesh
// stages count as compute.
enum class StageKind { compute, vertex, fragment };
const char* stageName(StageKind kind);

// Input of the model for bytes and operations: docs/measuring.md.
struct StrandCounts {
    std::uint64_t guide_vertices = 0;
    std::uint64_t root_triangles = 0;
    std::uint64_t strands = 0;
    std::uint64_t segments = 0;  // of a guide
    std::uint64_t pieces = 0;  // of a segment
    std::uint64_t covered_samples = 0;
    std::uint64_t covered_pixels = 0;
    std::uint64_t lights = 0;
    std::uint64_t color_bytes = 4;  // per sample

    // Number of distinct points; those between two segments count once.
    std::uint64_t points() const { return strands * (segments * pieces + 1); }
};

struct StrandWork {
    double bytes = 0.0;  // read and written, each datum once per pass that needs it
    std::map<StageKind, double> operations;  // floating-point; zero counts are absent
};

// The least work for a back end to draw the strands once. Absent if there is no model for the back
// end.
std::optional<StrandWork> strandWork(hair::Backend backend, const StrandCounts& counts);

// The limits of a device, each from several measurements.
struct DeviceLimits {
    std::vector<double> copy_bandwidth;  // GB/s, read and written
    std::map<StageKind, std::vector<double>> arithmetic;  // GFLOP/s, single precision
};

// Measures for about a second and waits for the device. The vertex stage is measured with points,
// the fragment stage with a triangle that fills a picture.
DeviceLimits measureLimits(const engine::Device& device);

// Minimum time, ms. Stages and memory work in parallel, so the slowest is the limit. Uses medians.
double leastTime(const StrandWork& work, const DeviceLimits& limits);

}  // namespace benchmarks::measure

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
