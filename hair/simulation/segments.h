#pragma once

#include <cstdint>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"

// Collision of guide segments with bodies: /simulation/collision/parts.
namespace hair::simulation {

// Moves segments out of bodies after each substep of `shape` and `ftl`, the solvers with positions
// and previous positions as their whole state: shaders/simulation/segments.comp. Keeps segment
// lengths. Borrows nothing.
class SegmentPass {
public:
    SegmentPass(
        const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
        const SimulationSettings& settings);

    // Saves the positions at the start of a substep. They must be written before. Afterwards the
    // solver may overwrite them.
    void recordStart(engine::Commands& commands, const engine::Buffer& positions) const;

    // Runs after the solver's substep. `frame` and `frame_before`: the head at the substep's end
    // and start.
    void record(
        engine::Commands& commands, const GuideAddresses& guides, const gpu::RigidFrame& frame,
        const gpu::RigidFrame& frame_before) const;

private:
    std::uint32_t strand_count_;
    std::uint32_t keeps_rest_;
    engine::Buffer starts_;  // vec4 [strand][vertex], m
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
