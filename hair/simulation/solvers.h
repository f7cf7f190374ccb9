#pragma once

#include <memory>

#include "engine/device.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"

// The list of solvers, for code that chooses one.
namespace hair::simulation {

// Returns the solver's memory.
SolverSizes solverSizes(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings);

// Makes the solver of the settings; null if nothing moves: `none` without keyframes or animation.
// Throws Unsupported for anything that the device can't do.
std::unique_ptr<GuideSolver> makeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step);

// Returns /simulation/time_step and its /simulation/substeps; 0 substeps means the solver's own
// number.
gpu::Step stepOf(const SimulationSettings& settings);

}  // namespace hair::simulation
