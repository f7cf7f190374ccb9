#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"
#include "hair/simulation/solvers.h"

namespace hair::simulation {

struct RodRest;

// Elastic rods of /simulation/material, which neither stretch nor shear: see
// hair/reference/rod.h. Positions are output alone; the state is in orientations and velocities.
// Strands work in units of their own and positions are sums of edges, so that 32 bits are enough.
// The first segment leaves the follicle as it does at rest, turned with the head.
class RodSolver : public GuideSolver {
public:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    void recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const override;
    const RestBalance* balance() const override { return balance_ ? &*balance_ : nullptr; }
    std::vector<const engine::Buffer*> state() const override { return {&motion_}; }

private:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const RodRest& rest);

    std::optional<RestBalance> balance_;
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
