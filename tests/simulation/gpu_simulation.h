#pragma once

#include <vector>

#include "engine/commands.h"
#include "engine/device.h"
#include "engine/transfer.h"
#include "hair/simulation/simulation.h"

namespace hair::simulation {

inline constexpr Solver kSolvers[] = {
    Solver::shape,
    Solver::ftl,
    Solver::rod,
    Solver::stable_cosserat,
    Solver::position_based_rod,
    Solver::augmented_mass_spring};
// Solvers whose whole state is positions and previous positions. gpu_rod_test.cpp tests the rest.
inline constexpr Solver kSolversOfPositions[] = {Solver::shape, Solver::ftl};

// Records wind, hair-hair interaction, forces, hands and a step, `steps` times, and waits.
inline void advance(const engine::Device& device, Simulation& simulation, int steps) {
    runOnce(device, [&](engine::Commands& commands) {
        for (int i = 0; i < steps; ++i) {
            simulation.recordWind(commands);
            if (simulation.hasVolume()) simulation.recordVolume(commands);
            if (simulation.hasForce()) simulation.recordForce(commands);
            if (simulation.hasPulls()) simulation.recordPulls(commands);
            simulation.recordStep(commands);
        }
    });
}

}  // namespace hair::simulation
