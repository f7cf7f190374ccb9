#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "engine/frame_loop.h"
#include "engine/pictures.h"
#include "hair/rendering/renderer.h"
#include "tests/rendering/device_hair.h"

namespace hair::rendering {

using Pixels = std::vector<std::uint8_t>;  // [row][column] RGBA, top row first

// The number of pixels that differ between two pictures of one size by more than this many steps
// in a channel.
inline std::size_t differingPixels(const Pixels& a, const Pixels& b, int steps = 0) {
    if (a.size() != b.size() || a.empty())
        throw std::invalid_argument(
            "cannot compare pictures of " + std::to_string(a.size() / 4) + " and " +
            std::to_string(b.size() / 4) + " pixels");
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        const auto differs = [&](std::size_t channel) {
            return std::abs(a[i + channel] - b[i + channel]) > steps;
        };
        count += differs(0) || differs(1) || differs(2);
    }
    return count;
}

// The thesis's case at rest: 86 guides grown on the head, 64 strands a triangle, 4 pieces a
// segment.
inline Settings thesisAtRest() {
    Settings settings;
    settings.simulation.solver = Solver::none;
    settings.strands.backend = Backend::tessellation;
    return settings;
}

inline Settings with(Settings settings, Backend backend) {
    settings.strands.backend = backend;
    return settings;
}

inline std::filesystem::path
writePicture(const std::filesystem::path& path, const Settings& settings, const Pixels& pixels) {
    engine::writePng(path, settings.render.width, settings.render.height, pixels);
    return path;
}

// The first frame of a case.
inline Pixels drawCase(const engine::Device& device, const Settings& settings) {
    benchmarks::measure::Case picture(device, settings, HAIRBENCH_SOURCE_DIR "/scenes");
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
    loop.finish();
    return picture.picture();
}

// The same case without its hair, because strands of no width cover nothing.
inline Pixels drawBald(const engine::Device& device, Settings settings) {
    settings.strands.root_width = 0.0f;
    settings.strands.tip_width = 0.0f;
    settings.strands.density = 1;
    settings.strands.tessellation = 1;
    return drawCase(device, settings);
}

// A groom and a mesh of the test's own making.
inline Pixels drawGroom(
    const engine::Device& device, const Settings& settings, const groom::Groom& groom,
    const groom::Mesh* mesh, const groom::StrandSet* offsets = nullptr) {
    const DeviceHair hair(device, groom, settings, offsets);
    Renderer renderer(device, settings, hair.view(), {.head = mesh});
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
    loop.finish();
    return engine::readOutput(device, renderer.target());
}

}  // namespace hair::rendering
