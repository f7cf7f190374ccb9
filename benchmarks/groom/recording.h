#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/scene/scene.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

// Strands of a simulation, written to a file.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::groom {

struct RecordingOptions {
    std::filesystem::path out;
    std::uint32_t frames = 60;
    bool guides = false;  // the simulated guides instead of the strands that are drawn
};

// Whether a file holds every frame of a simulation; others hold the last alone.
bool holdsFrames(const std::filesystem::path& file);

struct Recorded {
    hair::groom::StrandSet strands;  // of the first frame where the file holds all, of the last
    std::vector<std::string> warnings;  // of the case, and what the format can't hold
};

// Plays a scene's frames, with progress and without drawing them, and writes the strands. Throws
// engine::Error, also where the strands that are drawn change from frame to frame and the file
// holds every frame; Interrupted, and then nothing is written.
Recorded recordStrands(
    const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
    const RecordingOptions& options, measure::HairCache& cache);

}  // namespace benchmarks::groom
