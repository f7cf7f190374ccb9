#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "benchmarks/scene.h"
#include "engine/device.h"
#include "hair/settings.h"

namespace benchmarks {

// What was exported, for the closing line.
struct MitsubaExport {
    std::uint32_t strands = 0;
    std::size_t points = 0;
    std::size_t triangles = 0;
};

// Plays the scene up to `frame`, from 0, with progress, and writes what is then drawn into
// `folder`: hair.txt, head_0.ply and so on, and, when those are whole, scene.xml. Throws
// Interrupted.
MitsubaExport exportMitsuba(
    const engine::Device& device, const Scene& scene, const hair::Settings& settings,
    std::uint32_t frame, const std::filesystem::path& folder);

}  // namespace benchmarks
