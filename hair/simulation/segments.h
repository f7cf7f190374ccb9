#pragma once

#include <cstdint>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/device.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/simulation/guide_view.h"

// Segments of guides against bodies: /simulation/collision/parts.
namespace hair::simulation {

// Takes segments out of bodies after each substep of a solver whose whole state is positions and
// previous positions, `shape` and `ftl`: shaders/simulation/segments.comp. Lengths of segments stay
// as they are. Borrows nothing.
class SegmentPass {
public:
    SegmentPass(
        const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
        const SimulationSettings& settings);

    // Keeps the positions that a substep starts from, which are written before; the solver may
    // overwrite them then.
    void recordStart(engine::Commands& commands, const engine::Buffer& positions) const;

    // After the solver's substep. `frame` and `frame_before`: of the head at the substep's end and
    // start.
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
