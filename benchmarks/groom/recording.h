#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/measure.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

// Writes the strands of a simulation to a file.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::groom {

struct RecordingOptions {
    std::filesystem::path out;  // empty: no strands are written
    std::uint32_t frames = 60;
    bool guides = false;  // simulated guides instead of the drawn strands
    bool probes = false;  // also record /run/probes, which must ask for some
    std::string metadata = {};  // JSON text that a .npz also holds
};

// Whether the file is an array of NumPy, or an archive of arrays; both hold every frame.
bool isArray(const std::filesystem::path& file);

// Whether the file's format holds every frame of a simulation; other formats hold only the last.
bool holdsFrames(const std::filesystem::path& file);

struct Recorded {
    hair::groom::StrandSet strands;  // of the first frame if the file holds all, otherwise of the
                                     // last
    std::vector<std::string> warnings;  // about the case, and about data that the format cannot
                                        // hold
    std::optional<measure::PlayedProbes> probes;  // of the same frames
};

// Plays a case's frames once, with progress and without drawing them, and writes the strands.
// `directory` is that of the files that the settings name; `name` stands in the file. Throws
// engine::Error, also if the file holds every frame and the drawn strands' point counts or widths
// change between frames. Throws Interrupted, and then writes nothing.
Recorded recordStrands(
    const engine::Device& device, const std::filesystem::path& directory, const std::string& name,
    const hair::Settings& settings, const RecordingOptions& options, measure::HairCache& cache);

}  // namespace benchmarks::groom
