#pragma once

#include <vector>

#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/solvers.h"

namespace hair::simulation {

// Rods at rest as the `rod` solver wants them. A segment shorter than 1e-9 m has the direction of
// the one before it, the first one +y; it bends with its neighbours and is not massless.
struct RodRest {
    std::vector<gpu::RodSegment> segments;  // [vertex][strand]
    std::vector<float> units;               // [strand], m
};

RodRest
restOfRods(const groom::Groom& groom, const MaterialSettings& material, const gpu::Step& step);

// Elastic rods of /simulation/material, which neither stretch nor shear: see rod.h.
// Positions are output alone; the state is in orientations and velocities. Strands work in units of
// their own and positions are sums of edges, so that 32 bits are enough. The first segment leaves
// the follicle as it does at rest, turned with the head.
class RodSolver : public GuideSolver {
public:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    void recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const override;
    std::vector<const engine::Buffer*> state() const override { return {&motion_}; }

private:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const RodRest& rest);

    std::uint32_t strand_count_;
    std::uint32_t most_strands_;  // in a dispatch
    engine::Buffer segments_;
    engine::Buffer units_;
    engine::Buffer motion_;
    engine::Buffer scratch_;
    engine::Buffer parameters_;
    engine::ComputePipeline step_;
    engine::ComputePipeline adopt_;
};

}  // namespace hair::simulation
