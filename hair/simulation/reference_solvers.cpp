#include <algorithm>
#include <cassert>
#include <iterator>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "hair/simulation/reference_factors.h"
#include "hair/simulation/reference_ftl.h"
#include "hair/simulation/reference_solver.h"
#include "hair/simulation/reference_solver_rod.h"

namespace hair::reference {

namespace {

std::vector<glm::dvec3> moved(ConstPoints points, const RigidMotion& motion) {
    std::vector<glm::dvec3> result;
    for (const glm::dvec3& point : points) result.push_back(motion(point));
    return result;
}

void pushOutAll(const Substep& substep, ConstPoints before) {
    for (std::size_t i = 1; i < before.size(); ++i)
        substep.positions[i] = substep.push_out(substep.positions[i], before[i]);
}

// `none`: the head carries every vertex.
void stepRest(const Substep& substep, const SimulationSettings&, const Step&) {
    for (std::size_t i = 0; i < substep.rest.size(); ++i) {
        substep.previous[i] = substep.positions[i];
        substep.positions[i] = substep.frame(substep.rest[i]);
    }
}

// The order of thesis section 3.2, then collisions.
void stepShape(const Substep& substep, const SimulationSettings& settings, const Step& step) {
    const std::size_t vertices = substep.rest.size();
    const Points positions = substep.positions;
    const auto rest = moved(substep.rest, substep.frame);
    const glm::dmat3 root_frame = glm::mat3_cast(substep.frame.rotation);
    double length = 0.0;
    for (std::size_t i = 1; i < vertices; ++i)
        length += glm::distance(substep.rest[i], substep.rest[i - 1]);
    const double local = localFactor(settings, step, length / static_cast<double>(vertices - 1));

    const std::vector<glm::dvec3> before(positions.begin(), positions.end());
    substep.previous[0] = positions[0];
    positions[0] = rest[0];
    integrate(
        positions, substep.previous, substep.accelerations, keptFactor(settings, step), step.sub);
    pullToRest(positions, rest, globalFactor(settings, step));
    for (std::uint32_t i = 0; i < settings.local.iterations; ++i)
        pullToShape(positions, substep.rest, local, root_frame);
    for (std::uint32_t i = 0; i < settings.length.iterations; ++i) projectLengths(positions, rest);
    pushOutAll(substep, before);
}

// Follow the leader.
void stepFtl(const Substep& substep, const SimulationSettings& settings, const Step& step) {
    reference::stepFtl(
        substep.positions, substep.previous, moved(substep.rest, substep.frame),
        {.accelerations = substep.accelerations,
         .substep = step.sub,
         .velocity_kept = keptFactor(settings, step),
         .global_stiffness = globalFactor(settings, step),
         .velocity_correction = double{settings.ftl.velocity_correction}},
        substep.push_out);
}

using Function = void (*)(const Substep&, const SimulationSettings&, const Step&);

// A solver without a state of its own.
template <Function kFunction>
class Stateless : public Solver {
public:
    Stateless(const Groom&, const SimulationSettings& settings, const Step& step)
        : settings_(settings), step_(step) {}

    void step(const Substep& substep) override { kFunction(substep, settings_, step_); }

private:
    SimulationSettings settings_;
    Step step_;
};

template <class Made>
std::unique_ptr<Solver>
make(const Groom& groom, const SimulationSettings& settings, const Step& step) {
    return std::make_unique<Made>(groom, settings, step);
}

struct Row {
    hair::Solver solver;
    std::unique_ptr<Solver> (*make)(const Groom&, const SimulationSettings&, const Step&);
};

constexpr Row kSolvers[] = {
    {hair::Solver::none, make<Stateless<stepRest>>},
    {hair::Solver::shape, make<Stateless<stepShape>>},
    {hair::Solver::ftl, make<Stateless<stepFtl>>},
    {hair::Solver::rod, make<RodSolver>},
};

}  // namespace

std::unique_ptr<Solver>
makeSolver(const Groom& groom, const SimulationSettings& settings, const Step& step) {
    if (settings.solver == hair::Solver::none && settings.motion.keyframes.empty()) return nullptr;
    const Row* row = std::ranges::find(kSolvers, settings.solver, &Row::solver);
    assert(row != std::end(kSolvers));
    return row->make(groom, settings, step);
}

}  // namespace hair::reference
