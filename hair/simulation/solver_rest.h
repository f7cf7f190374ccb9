#pragma once

#include "engine/pipeline.h"
#include "hair/simulation/solver.h"

namespace hair {

// Hair frozen on a head that moves: solver `none` with keyframes.
class RestSolver : public GuideSolver {
public:
    RestSolver(const engine::Device& device, const Groom& groom);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;

private:
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
};

}  // namespace hair
