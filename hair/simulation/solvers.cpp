#include <algorithm>
#include <cassert>
#include <iterator>

#include "hair/simulation/solver.h"
#include "hair/simulation/solver_ftl.h"
#include "hair/simulation/solver_rest.h"
#include "hair/simulation/solver_rod.h"
#include "hair/simulation/solver_shape.h"

namespace hair {

namespace {

struct Row {
    Solver solver;
    std::uint32_t substeps;  // of its own choice
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

constexpr Row kSolvers[] = {
    {Solver::none, 1, makeNone},
    {Solver::shape, 1, make<ShapeSolver>},
    {Solver::ftl, 1, make<FtlSolver>},
    {Solver::rod, 8, make<RodSolver>},
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
    return settings.substeps > 0 ? settings.substeps : rowOf(settings.solver).substeps;
}

SimulationSettings settingsOfSubstep(SimulationSettings settings) {
    const std::uint32_t substeps = substepsOf(settings);
    settings.time_step =
        static_cast<float>(double{settings.time_step} / static_cast<double>(substeps));
    settings.substeps = 1;
    return settings;
}

}  // namespace hair
