#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

#include "hair/simulation/solver.h"
#include "hair/simulation/solver_ftl.h"
#include "hair/simulation/solver_rest.h"
#include "hair/simulation/solver_rod.h"
#include "hair/simulation/solver_shape.h"

namespace hair {

namespace {

struct Row {
    Solver solver;
    double longest_substep;  // of its own choice, s
    std::unique_ptr<GuideSolver> (*make)(
        const engine::Device&, const Groom&, const SimulationSettings&);
};

template <class Made>
std::unique_ptr<GuideSolver>
make(const engine::Device& device, const Groom& groom, const SimulationSettings& settings) {
    return std::make_unique<Made>(device, groom, settings);
}

std::unique_ptr<GuideSolver>
makeNone(const engine::Device& device, const Groom& groom, const SimulationSettings& settings) {
    if (settings.motion.keyframes.empty()) return nullptr;
    return std::make_unique<RestSolver>(device, groom);
}

constexpr double kTimeStep = std::numeric_limits<double>::infinity();  // however long

constexpr Row kSolvers[] = {
    {Solver::none, kTimeStep, makeNone},
    {Solver::shape, kTimeStep, make<ShapeSolver>},
    {Solver::ftl, kTimeStep, make<FtlSolver>},
    {Solver::rod, 1.0 / 480.0, make<RodSolver>},
};

const Row& rowOf(Solver solver) {
    const Row* row = std::ranges::find(kSolvers, solver, &Row::solver);
    assert(row != std::end(kSolvers));
    return *row;
}

}  // namespace

std::unique_ptr<GuideSolver>
makeSolver(const engine::Device& device, const Groom& groom, const SimulationSettings& settings) {
    return rowOf(settings.solver).make(device, groom, settings);
}

std::uint32_t substepsOf(const SimulationSettings& settings) {
    if (settings.substeps > 0) return settings.substeps;
    const double substeps = double{settings.time_step} / rowOf(settings.solver).longest_substep;
    // Time steps are rounded to a float: 8.0000001 is 8.
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(substeps - 1e-4)));
}

SimulationSettings settingsOfSubstep(SimulationSettings settings) {
    const std::uint32_t substeps = substepsOf(settings);
    settings.time_step =
        static_cast<float>(double{settings.time_step} / static_cast<double>(substeps));
    settings.substeps = 1;
    return settings;
}

}  // namespace hair
