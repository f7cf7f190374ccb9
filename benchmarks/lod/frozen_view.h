#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "benchmarks/measure/case.h"
#include "engine/frame_loop.h"
#include "hair/rendering/renderer.h"

// Pictures of the hair of one frame, drawn with settings other than the case's.
namespace benchmarks::lod {

// [row][column] RGBA, display values.
using Picture = std::vector<std::uint8_t>;

// Differences of pictures of one size, [row][column] RGBA, are over the red, green and blue of all
// pixels; display values count from 0 to 1.

// Root of the mean square difference.
double rootMeanSquare(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

// Returns the change by level of detail between two steps of a path, beyond the change that the
// steps make in any case: the root mean square of (b - a) - (full_b - full_a).
double popping(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b);

// The mean red of a picture with a black background: the share that white hair covers.
double whiteShare(std::span<const std::uint8_t> picture);

// Medians of isolated frames, ms.
struct LodTimes {
    double strands = 0.0;  // the pass
    double frame = 0.0;    // from submission to completion
};

// Returns the settings with a forced level of detail.
hair::Settings atLevel(hair::Settings settings, float level);

// White hair alone on black, opaque, with 16 samples per pixel. Its mean is the area that the hair
// covers.
hair::Settings coverageOf(hair::Settings settings);

// Zooms the camera in so that the square just contains the hair's bounding sphere. The resolution
// of the measure then does not depend on the distance.
hair::CameraSettings
zoomedOn(const hair::rendering::StrandView& view, const hair::CameraSettings& camera);

// Pictures of the frozen hair with one set of settings.
class FrozenView {
public:
    FrozenView(
        const engine::Device& device, const measure::Case& hair, const hair::Settings& settings);

    void setCamera(const hair::CameraSettings& camera) { renderer_.setCamera(camera); }
    std::uint64_t strands() const { return renderer_.plan().strands(); }

    // Throws Interrupted.
    void draw();

    // Medians of the frames since the last call.
    LodTimes times();

    Picture picture();

    // Linear light, [row][column] RGB; requires a tone map in the settings.
    std::vector<float> radiance();

private:
    const engine::Device& device_;
    hair::rendering::StrandView view_;
    hair::rendering::Renderer renderer_;
    engine::FrameLoop loop_;
};

}  // namespace benchmarks::lod
