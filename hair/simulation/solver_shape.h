#pragma once

#include "engine/pipeline.h"
#include "hair/simulation/shape_plan.h"
#include "hair/simulation/solver.h"

namespace hair {

// The thesis's solver: Verlet, then global, local (Han and Harada 2012) and length constraints
// (thesis section 3).
class ShapeSolver : public GuideSolver {
public:
    // Throws what planShape does.
    ShapeSolver(
        const engine::Device& device, const Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    void expectBodies(const engine::Device& device) override;

private:
    std::uint32_t strand_count_;
    ShapePlan plan_;
    engine::Buffer rest_edges_;
    engine::Buffer local_stiffness_;
    engine::Buffer parameters_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair
