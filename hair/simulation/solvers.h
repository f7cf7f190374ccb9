#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"

// The solvers: what moves guides, and the table of them.
namespace hair::simulation {

// What /simulation/rest: balanced made of the guides.
struct RestBalance {
    std::uint32_t stiffened = 0;  // guides that are stiffer than the settings say
    double stiffest = 1.0;  // the greatest factor among them
    std::vector<std::uint32_t>
        unbalanced;  // guides that keep the groom's shape as their rest shape

    // A guide that is balanced.
    void add(double stiffening) {
        if (stiffening > 1.0) ++stiffened;
        stiffest = std::max(stiffest, stiffening);
    }
};

// What moves guides. It reads the positions and previous positions that are behind
// SubstepPush::from and writes all of those behind SubstepPush::guides, which may be the same, and
// may keep more state of its own.
class GuideSolver {
public:
    virtual ~GuideSolver() = default;

    // Records one substep: integrate, hold the strands together, push them out of bodies. The
    // caller fills in the push constants but `solver` and `first_strand`, says what is touched of
    // the guides (Commands::uses), and orders the work before and after by barriers; the solver
    // says what it touches of its own.
    virtual void record(engine::Commands& commands, gpu::SubstepPush push) const = 0;

    // Derives the state of its own from positions and previous positions that someone else wrote.
    virtual void recordAdopt(engine::Commands&, gpu::SubstepPush) const {}

    // From now on there may be bodies, also where the constructor's settings had none. Throws as
    // the constructor.
    virtual void expectBodies(const engine::Device&) {}

    // Where the settings ask for a balanced rest shape and the solver has rest shapes; else null.
    virtual const RestBalance* balance() const { return nullptr; }

    // Corrects the balanced rest shape by what a substep without bodies moved guides by that were
    // at rest as the groom has them, [strand][vertex], axes of the groom, m. False: there is
    // nothing left to correct, and it is not called again.
    virtual bool correctBalance(const engine::Device&, std::span<const glm::vec3>) { return false; }

    // The state of its own, to save and restore.
    virtual std::vector<const engine::Buffer*> state() const { return {}; }
};

// Whether an animation deforms the mesh under the hair: solvers read SubstepPush::roots.
inline bool hasSkinnedRoots(const SimulationSettings& settings) {
    return !settings.animation.clip.empty();
}

// B of device memory that a solver keeps for guides.
struct SolverSizes {
    std::uint64_t all = 0;
    std::uint64_t state = 0;  // of these, what state() gives
};

SolverSizes solverSizes(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings);

// The settings' solver; null where nothing moves: `none` without keyframes or animation. Throws
// Unsupported for what the device can't do.
std::unique_ptr<GuideSolver> makeSolver(
    const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
    const gpu::Step& step);

// /simulation/time_step, and /simulation/substeps of it or the solver's own number where that is 0.
gpu::Step stepOf(const SimulationSettings& settings);

}  // namespace hair::simulation
