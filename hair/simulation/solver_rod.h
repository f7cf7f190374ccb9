#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

namespace hair::simulation {

struct RodRest;

// Differences between the rod solvers.
struct RodMethod {
    const char* shader;  // of a substep
    std::uint32_t scratch_rows;  // vec4 per vertex
    std::uint32_t iterations;
    double stretching = 0.0;  // modulus of stretch and shear over the density, m^2/s^2
    double integrity = 0.0;  // of `augmented_mass_spring`, and the next
    double angular = 0.0;
    RodIntegrator integrator = RodIntegrator::implicit_euler;
    double damping = 0.0;  // of `rod`: material damping, s
};

// `rod`: rods that neither stretch nor shear; hair/reference/rod.h.
RodMethod rodMethod(const SimulationSettings& settings);
// `stable_cosserat`: hair/reference/stable_cosserat.h.
RodMethod stableCosseratMethod(const SimulationSettings& settings);
// `position_based_rod`: hair/reference/stable_cosserat.h.
RodMethod positionBasedMethod(const SimulationSettings& settings);
// `augmented_mass_spring`: hair/reference/augmented_mass_spring.h. Its orientations follow the
// edges.
RodMethod augmentedMassSpringMethod(const SimulationSettings& settings);

// Elastic rods of /simulation/material by one of these methods. Positions are output only; the
// state is in orientations, velocities and edges. Each strand has its own unit of length, and
// positions are sums of edges, so that 32 bits are enough. The first segment leaves the follicle at
// its rest angle, turned with the head.
class RodSolver : public GuideSolver {
public:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step, const RodMethod& method);

    static engine::MemoryRows
    rows(const engine::DeviceInfo& device, const groom::GroomSize& size, const RodMethod& method);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    void recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const override;
    const RestBalance* balance() const override { return balance_ ? &*balance_ : nullptr; }
    std::vector<const engine::Buffer*> state() const override;
    ElasticRods elasticRods() const override;

private:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step, const RodMethod& method, const RodRest& rest);

    std::optional<RestBalance> balance_;
    bool stretches_;
    std::uint32_t strand_count_;
    std::uint32_t most_strands_;  // per dispatch
    engine::Buffer segments_;
    engine::Buffer units_;
    engine::Buffer motion_;
    std::optional<engine::Buffer>
        accelerations_;  // if the method needs those of the previous substep
    engine::Buffer scratch_;
    engine::Buffer parameters_;
    engine::ComputePipeline step_;
    engine::ComputePipeline adopt_;
};

}  // namespace hair::simulation
