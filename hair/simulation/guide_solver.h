#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"

namespace hair::simulation {

// Device addresses of the guides, for passes that move them.
struct GuideAddresses {
    std::uint64_t parameters = 0;  // gpu::GuideParameters, including the next two
    std::uint64_t positions = 0;
    std::uint64_t previous = 0;
    std::uint64_t accelerations = 0;  // vec4 [strand][vertex], m/s^2, without gravity; 0: none
};

// The guides on the device, for code that draws them. Valid as long as the simulation that returned
// it.
struct GuideView {
    // Device address of vec4 [strand][vertex], root first, m; w: inverse mass.
    std::uint64_t positions = 0;
    // Device address of vec4 [strand][vertex]; w: 1 at a vertex in contact with a body and at all
    // vertices below it, else 0.
    std::uint64_t contacts = 0;
    std::uint64_t bodies = 0;  // device address of the gpu::Bodies that the guides collide with
    std::uint32_t strand_count = 0;
    std::uint32_t vertices_per_strand = 0;
};

// Rods whose joints store the energy of shaders/simulation/rod/joint.glsl.
struct ElasticRods {
    std::uint64_t parameters = 0;  // device address of gpu::RodParameters; 0: there are none
    std::uint64_t motion = 0;  // device address of their motion
    std::uint64_t set = 0;  // device address of their set; 0: they take none
};

// The guides on the device, for probes. Valid until the next step.
struct ProbedGuides {
    std::uint64_t parameters = 0;  // gpu::GuideParameters, including the next two
    std::uint64_t positions = 0;
    std::uint64_t previous = 0;
    gpu::RigidFrame frame;  // of the head
    std::uint64_t roots = 0;  // gpu::RigidFrame [strand], if an animation deforms the head
    ElasticRods rods;
};

// The interface of solvers. The list of all solvers, which includes them, is solvers.h.

// Result of /simulation/rest: balanced.
struct RestBalance {
    std::uint32_t stiffened = 0;  // guides stiffened beyond the settings
    double stiffest = 1.0;  // largest stiffening factor
    std::vector<std::uint32_t>
        unbalanced;  // guides that keep the groom's shape as their rest shape

    // Counts a balanced guide.
    void add(double stiffening) {
        if (stiffening > 1.0) ++stiffened;
        stiffest = std::max(stiffest, stiffening);
    }
};

// Moves guides. Reads the positions and previous positions behind SubstepPush::from and writes all
// of those behind SubstepPush::guides, which may be the same. May keep more state of its own.
class GuideSolver {
public:
    virtual ~GuideSolver() = default;

    // A solver with memory of its own hides this.
    static engine::MemoryRows
    rows(const engine::DeviceInfo&, const groom::GroomSize&, const SimulationSettings&) {
        return {};
    }

    // Records one substep: integrate, constrain the strands, push them out of bodies. The caller
    // fills in the push constants except `solver` and `first_strand`, and declares the uses of the
    // guides (Commands::uses) for the first dispatch. The solver declares the uses of its own
    // buffers, and in further dispatches all of them (Commands::usesAgain).
    virtual void record(engine::Commands& commands, gpu::SubstepPush push) const = 0;

    // Derives the solver's own state from positions and previous positions that other code wrote.
    // The set of rods stays as it was.
    virtual void recordAdopt(engine::Commands&, gpu::SubstepPush) const {}

    // The solver's own state that is 0 then instead.
    virtual const engine::Buffer* memory() const { return nullptr; }

    // Allows bodies from now on, even if the constructor's settings had none. Throws like the
    // constructor.
    virtual void expectBodies(const engine::Device&) {}

    // Balance, if the settings ask for it and the solver has rest shapes; else null.
    virtual const RestBalance* balance() const { return nullptr; }

    // Corrects the balanced rest shape. The argument is the movement of guides that were at rest in
    // the groom's shape, in a substep without bodies, [strand][vertex], groom axes, m. Returns
    // false if nothing is left to correct; then it is not called again.
    virtual bool correctBalance(const engine::Device&, std::span<const glm::vec3>) { return false; }

    // The solver's own target positions, vec4 [strand][vertex], groom axes, m, that a cache of the
    // guides' motion moves; null: there are none.
    virtual const engine::Buffer* goals() const { return nullptr; }

    // For the probe of elastic energy.
    virtual ElasticRods elasticRods() const { return {}; }

    // The solver's own state, to save and restore. Its rows have a "settled state" for each.
    virtual std::vector<const engine::Buffer*> state() const { return {}; }
};

// Whether an animation deforms the mesh under the hair. Then solvers read SubstepPush::roots.
inline bool hasSkinnedRoots(const SimulationSettings& settings) {
    return !settings.animation.clip.empty();
}

}  // namespace hair::simulation
