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

// What one solver of rods does otherwise than another.
struct RodMethod {
    const char* shader;  // of a substep
    const char* packed_shader;  // the same where the device has 64-bit integers
    std::uint32_t scratch_rows;  // vec4 for each vertex
    std::uint32_t iterations;
    double stretching = 0.0;  // modulus of stretch and shear over the density, m^2/s^2
    double integrity = 0.0;  // of `augmented_mass_spring`: its settings
    double angular = 0.0;
    RodIntegrator integrator = RodIntegrator::implicit_euler;
    double damping = 0.0;  // of `rod`: the material's, s
};

// `rod`: rods which neither stretch nor shear; hair/reference/rod.h.
RodMethod rodMethod(const SimulationSettings& settings);
// `stable_cosserat`: hair/reference/stable_cosserat.h.
RodMethod stableCosseratMethod(const SimulationSettings& settings);
// `position_based_rod`: hair/reference/position_based_rod.h.
RodMethod positionBasedMethod(const SimulationSettings& settings);
// `augmented_mass_spring`: hair/reference/augmented_mass_spring.h. Its orientations follow the
// edges.
RodMethod augmentedMassSpringMethod(const SimulationSettings& settings);

// B of device memory that RodSolver keeps for guides.
SolverSizes
rodSizes(const engine::DeviceInfo& device, const groom::GroomSize& size, const RodMethod& method);

// Elastic rods of /simulation/material by one of those methods. Positions are output alone; the
// state is in orientations, velocities and edges. Strands work in units of their own and positions
// are sums of edges, so that 32 bits are enough. The first segment leaves the follicle as it does
// at rest, turned with the head.
class RodSolver : public GuideSolver {
public:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step, const RodMethod& method);

    void record(engine::Commands& commands, gpu::SubstepPush push) const override;
    void recordAdopt(engine::Commands& commands, gpu::SubstepPush push) const override;
    const RestBalance* balance() const override { return balance_ ? &*balance_ : nullptr; }
    std::vector<const engine::Buffer*> state() const override;

private:
    RodSolver(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        const gpu::Step& step, const RodMethod& method, const RodRest& rest);

    std::optional<RestBalance> balance_;
    std::uint32_t strand_count_;
    std::uint32_t most_strands_;  // in a dispatch
    engine::Buffer segments_;
    engine::Buffer units_;
    engine::Buffer motion_;
    std::optional<engine::Buffer>
        accelerations_;  // where the method needs those of a substep before
    engine::Buffer scratch_;
    engine::Buffer parameters_;
    engine::ComputePipeline step_;
    engine::ComputePipeline adopt_;
};

}  // namespace hair::simulation
