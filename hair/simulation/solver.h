#pragma once

#include <memory>
#include <vector>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/settings.h"

namespace hair {

// What moves guides. It reads and writes the positions and previous positions that are behind
// StepPush::guides, and may keep more state of its own.
class GuideSolver {
public:
    virtual ~GuideSolver() = default;

    // Records one substep: integrate, hold the strands together, push them out of bodies. The
    // caller fills in the push constants but `solver` and `first_strand`, and orders the work
    // before and after by barriers.
    virtual void record(engine::Commands& commands, gpu::StepPush push) const = 0;

    // Derives the state of its own from positions and previous positions that someone else wrote.
    virtual void recordAdopt(engine::Commands&, gpu::StepPush) const {}

    // From now on there may be bodies, also where the constructor's settings had none. Throws as
    // the constructor.
    virtual void expectBodies(const engine::Device&) {}

    // The state of its own, to save and restore.
    virtual std::vector<const engine::Buffer*> state() const { return {}; }
};

// The settings' solver; null where nothing moves: `none` without keyframes. `settings.time_step` is
// a substep. Throws Unsupported for what the device can't do.
std::unique_ptr<GuideSolver>
makeSolver(const engine::Device& device, const Groom& groom, const SimulationSettings& settings);

// Substeps of a time step: /simulation/substeps, or the solver's own number where that is 0.
std::uint32_t substepsOf(const SimulationSettings& settings);

// The same simulation with its substep as the time step.
SimulationSettings settingsOfSubstep(SimulationSettings settings);

}  // namespace hair
