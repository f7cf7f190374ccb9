#pragma once

#include "engine/pipeline.h"
#include "hair/groom/groom.h"
#include "hair/simulation/guide_solver.h"

namespace hair::simulation {

// Follow the leader: Verlet and the pull toward the rest position. Then, from the root down, every
// segment is restored to its length by moving only its lower end, and the upper end's velocity is
// corrected for it. Mueller, Kim and Chentanez 2012, Fast simulation of inextensible hair and fur.
// Exactly inextensible in one pass; no bending resistance. A pinned vertex below the root stays,
// and the segment that ends in it may change its length. The corrections are part of the previous
// positions.
class FtlSolver : public GuideSolver {
public:
    FtlSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;

private:
    std::uint32_t strand_count_;
    engine::Buffer parameters_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair::simulation
