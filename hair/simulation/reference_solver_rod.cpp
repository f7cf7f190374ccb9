#include "hair/simulation/reference_solver_rod.h"

#include <algorithm>

#include "hair/simulation/reference_factors.h"

namespace hair::reference {

namespace {

RodRoot rootOf(const RigidMotion& motion) {
    return {.rotation = motion.rotation, .translation = motion.translation};
}

}  // namespace

RodSolver::RodSolver(const Groom& groom, const SimulationSettings& settings, const Step& step)
    : settings_(settings), step_(step) {
    const MaterialSettings& material = settings.material;
    for (std::uint32_t i = 0; i < groom.strand_count; ++i) {
        const auto points = groom.strand(i);
        rests_.push_back(makeRodRest(
            std::vector<glm::dvec3>(points.begin(), points.end()),
            {.density = material.density,
             .radius = material.radius,
             .youngs_modulus = material.youngs_modulus,
             .shear_modulus = material.shear_modulus}));
        states_.push_back(rodAtRest(rests_.back()));
    }
}

void RodSolver::step(const Substep& substep) {
    RodState& state = states_[substep.strand];
    const RodRest& rest = rests_[substep.strand];
    const std::vector<glm::dvec3> before(substep.positions.begin(), substep.positions.end());
    stepRod(
        state, rest, substep.accelerations, rootOf(substep.frame), step_.sub,
        keptFactor(settings_, step_), settings_.rod.iterations);
    std::vector<glm::dvec3> positions = state.positions();
    for (std::size_t i = 1; i < positions.size(); ++i)
        positions[i] = substep.push_out(positions[i], before[i]);
    pushRod(state, rest, positions, step_.sub);
    std::ranges::copy(before, substep.previous.begin());
    std::ranges::copy(positions, substep.positions.begin());
}

void RodSolver::adopt(const Substep& substep) {
    states_[substep.strand] = rodFrom(
        rests_[substep.strand], substep.positions, substep.previous, step_.sub,
        rootOf(substep.frame));
}

}  // namespace hair::reference
