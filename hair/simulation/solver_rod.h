#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>

#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

// The solvers of elastic rods, and the rest shape with which a rod hangs as in the groom.
namespace hair::simulation {

// ---- Inverse statics ----------------------------------------------------------------------------

// A rod that hangs under weights, in any consistent units. All arrays are [vertex], root first.
// Segment i and joint i end and start in vertices i - 1 and i. Entry 0 is the follicle, which has
// only an orientation.
struct HangingRod {
    std::vector<glm::dquat> orientations;  // of segments; the third axis is the tangent
    std::vector<glm::dvec3> edges;  // of segments
    std::vector<glm::dvec3> weights;  // on vertices
    std::vector<double> bend_stiffness;  // of joints, torque per angle
    std::vector<double> twist_stiffness;  // of joints, torque per angle
    double ellipticity = 1.0;  // of the section: gpu::RodParameters
};

struct BalancedRod {
    double stiffening;  // factor of all joints, >= 1
    std::vector<glm::dquat> half_rotations;  // at joints, for the rest shape
};

// Returns the rest shape with which the rod is at rest as it hangs. A joint's torque is the moment
// of the weights below it; strain and rest rotation follow joint by joint. So a solution exists
// whenever the joints can bear the moment, but not every equilibrium is stable. Takes the least
// stiffening, to 5 %, for which no joint bends by more than kMostBend under its moment and the
// equilibrium is an energy minimum, also with all loads kLoadMargin times as large: the second
// variation along the rod must be positive, which its elimination from the tip up shows. Absent if
// more than `most_stiffening` would be needed. Hsu et al. 2023, Sag-free initialization for
// strand-based hybrid hair simulation, solve the same problem and stiffen too. Rods with segments
// that neither stretch nor shear need no global solve.
std::optional<BalancedRod> balanceRod(const HangingRod& rod, double most_stiffening);

inline constexpr double kMostBend = 1.5;  // rad; half as much at the follicle
inline constexpr double kLoadMargin = 1.25;

// ---- Solvers ------------------------------------------------------------------------------------

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
    double set_share = 0.0;  // of `rod`: share of the stiffness that yields, and its time, s
    double set_time = 1.0;
    CosseratMethod cosserat = CosseratMethod::direct;  // of `stable_cosserat`
};

// `rod`: rods that neither stretch nor shear; hair/reference/rod.h.
RodMethod rodMethod(const SimulationSettings& settings);
// `stable_cosserat`: hair/reference/compared_rods.h.
RodMethod stableCosseratMethod(const SimulationSettings& settings);
// `position_based_rod`: hair/reference/compared_rods.h.
RodMethod positionBasedMethod(const SimulationSettings& settings);
// `augmented_mass_spring`: hair/reference/compared_rods.h. Its orientations follow the
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
    std::optional<engine::Buffer> set_;  // if hair takes a set
    engine::Buffer scratch_;
    engine::Buffer parameters_;
    engine::ComputePipeline step_;
    engine::ComputePipeline adopt_;
};

}  // namespace hair::simulation
