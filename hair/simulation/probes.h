#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

namespace hair::simulation {

// Whether any probe is wanted.
bool hasProbes(const ProbeSettings& settings);

// Probes: quantities of guides, computed on the device in each frame beside the state, which they
// never change. docs/physics.md defines them. Values of a frame stay on the device until read(), so
// that no frame waits.
class Probes {
public:
    // For `most_frames` frames. Throws Error if /run/probes names guides that the groom lacks.
    Probes(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const ProbeSettings& probes, std::uint32_t most_frames);

    static engine::MemoryRows rows(
        const groom::GroomSize& size, Solver solver, const ProbeSettings& probes,
        std::uint32_t most_frames);

    // Names of the values of a frame, as in a report without its "probe.": "length_error.mean".
    static std::vector<std::string> names(const ProbeSettings& probes, Solver solver);

    // Records the values of the next frame. Equal guides give equal bits.
    void record(engine::Commands& commands, const ProbedGuides& guides);

    // Returns the values of all recorded frames, [value][frame], in the units of docs/physics.md.
    // Waits for the device.
    std::vector<std::vector<double>> read() const;

private:
    const engine::Device* device_;
    std::uint32_t first_guide_;
    std::uint32_t guide_count_;
    std::uint32_t quantities_ = 0;
    float line_density_;  // kg/m
    std::uint32_t most_frames_;
    std::uint32_t frames_ = 0;  // recorded
    std::uint32_t results_per_frame_;
    engine::Buffer rest_;  // vec4 [strand][vertex], m; w: mass, kg
    engine::Buffer rows_;  // float [row][guide]
    engine::Buffer wanted_;  // gpu::ProbeResult [result]
    engine::Buffer results_;  // float [frame][result]
    engine::ComputePipeline guides_;
    engine::ComputePipeline reduce_;
};

}  // namespace hair::simulation
