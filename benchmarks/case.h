#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/frame_loop.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/strand_points.h"
#include "hair/settings.h"
#include "hair/simulation/fixed_step.h"
#include "hair/simulation/simulation.h"

namespace benchmarks {

// One set of settings, ready to play: the groom, its simulation and its renderer. Owns every GPU
// object that it uses; leaving its scope frees them.
class Case {
public:
    // `directory` is what file names in the settings are relative to. Throws engine::Error for
    // files that can't be used, engine::Unsupported for what the device lacks.
    Case(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory);

    // Records the next frame: simulated time advances by /run/frame_time, then a picture is drawn.
    void frame(engine::Passes& passes);

    // Records the simulation of the next frame and no picture: what frame() does first.
    void simulate(engine::Passes& passes);

    // Back to the first frame. The device must be done with what was submitted.
    void reset();

    // The picture of the last frame, [row][column] RGBA, top row first.
    std::vector<std::uint8_t> picture() const;
    std::string pictureHash() const;
    // Of the guides' positions.
    std::string stateHash() const;

    // The strands of the last frame as they are drawn. Waits for the device.
    hair::StrandPoints strands() const;
    // The guides of the last frame, [guide][vertex], m. Waits for the device.
    std::vector<glm::vec3> guides() const { return simulation_.readPositions(); }
    const hair::Groom& groom() const { return groom_; }

    const hair::StrandPlan& plan() const { return renderer_.plan(); }
    std::optional<hair::ExpectedCounts> expected() const { return renderer_.expected(); }
    std::vector<std::pair<std::string, std::uint64_t>> counts() const;

private:
    hair::StrandView view() const;

    const engine::Device& device_;
    hair::Settings settings_;
    std::optional<hair::Mesh> mesh_;
    hair::Groom groom_;
    hair::Simulation simulation_;
    hair::FixedStep fixed_step_;
    hair::GroomBuffers groom_buffers_;
    hair::Renderer renderer_;
};

}  // namespace benchmarks
