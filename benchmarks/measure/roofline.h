#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "benchmarks/measure/case.h"
#include "engine/device.h"
#include "hair/settings.h"

// The roofline of drawing strands (Williams, Waterman and Patterson 2009, Roofline: An Insightful
// Visual Performance Model): what a back end must move and calculate at the least, what the device
// can do, and the least time that follows.
namespace benchmarks::measure {

// Kinds of stages that arithmetic is done in. Stages between vertex and rasteriser, tessellation
// and geometry, count as vertex, task and mesh stages as compute.
enum class StageKind { compute, vertex, fragment };
const char* stageName(StageKind kind);

// Of which a stated model makes bytes and operations: docs/measuring.md.
struct StrandCounts {
    std::uint64_t guide_vertices = 0;
    std::uint64_t root_triangles = 0;
    std::uint64_t strands = 0;
    std::uint64_t segments = 0;  // of a guide
    std::uint64_t pieces = 0;  // of a segment
    std::uint64_t covered_samples = 0;
    std::uint64_t covered_pixels = 0;
    std::uint64_t lights = 0;
    std::uint64_t color_bytes = 4;  // of a sample

    // Different ones; those between two segments count once.
    std::uint64_t points() const { return strands * (segments * pieces + 1); }
};

struct StrandWork {
    double bytes = 0.0;  // from and to memory, each datum once for each pass that needs it
    std::map<StageKind, double> operations;  // floating-point; those of 0 are absent
};

// What drawing the strands once takes a back end at the least. Absent where nothing is known of the
// back end.
std::optional<StrandWork> strandWork(hair::Backend backend, const StrandCounts& counts);

// What a device can do, each by some measurements.
struct DeviceLimits {
    std::vector<double> copy_bandwidth;  // GB/s, read and written
    std::map<StageKind, std::vector<double>> arithmetic;  // GFLOP/s, by single precision
};

// Measures for about a second. Waits for the device. The vertex stage is measured with points, the
// fragment stage with a triangle that fills a picture.
DeviceLimits measureLimits(const engine::Device& device);

// ms: stages and memory work beside each other, so the slowest of them is the limit. By medians.
double leastTime(const StrandWork& work, const DeviceLimits& limits);

}  // namespace benchmarks::measure
