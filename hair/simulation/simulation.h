#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/settings.h"
#include "hair/simulation/bodies.h"
#include "hair/simulation/condition.h"
#include "hair/simulation/force.h"
#include "hair/simulation/guide_view.h"
#include "hair/simulation/hair_hair.h"
#include "hair/simulation/head_motion.h"
#include "hair/simulation/pulls.h"
#include "hair/simulation/segments.h"
#include "hair/simulation/skinned_roots.h"
#include "hair/simulation/solvers.h"
#include "hair/simulation/wind.h"

namespace hair::simulation {

// Turns the simulated time that frames advance into whole steps and carries the rest over. Time is
// counted in whole parts of a step, 720,720 of them, so that every ratio p / q of frame to step
// with q <= 16 is exact and no error builds up; any other is off by less than 1e-6 steps a frame.
class FixedStep {
public:
    // step > 0, s.
    explicit FixedStep(double step);

    // Steps to simulate for a frame that advances `frame_time` >= 0, s.
    std::uint32_t stepsFor(double frame_time);

    void reset() { parts_ = 0; }

private:
    double step_;
    std::int64_t parts_ = 0;  // time that waits for the next step
};

// Which of its two copies of the guides a step leaves them in. Pictures of earlier frames may still
// be drawn of the one that was drawn last: steps into the other one need not wait for them.
enum class Copy { other, same };

// The state of a simulation after construction, on the host.
struct SettledState {
    std::vector<std::vector<std::byte>> buffers;
};

// What takes long to make of a simulation, of one that was made of the same groom, settings and
// seed on the same device by the same program. Borrowed.
struct MadeBefore {
    std::span<const BakedField* const> fields{};  // [distance field], null: not there; or empty
    const SettledState* settled = nullptr;  // null: not there
};

// B of device memory that a Simulation takes, its distance fields as fieldBytes() has them.
std::uint64_t simulationBytes(
    const engine::DeviceInfo& device, const groom::GroomSize& size,
    const SimulationSettings& settings);

// The guides on the device and the compute passes that move them. A time step is recordWind,
// recordVolume where hasVolume, recordForce where hasForce, recordPulls where hasPulls, then
// recordStep. Simulated time is the
// number of recorded steps times the time step: nothing depends on frames or clocks. Solver `none`
// keeps the guides at rest on the head, and records nothing where that stands still. Between
// submissions the device's work is ordered by the barriers that are recorded here. Borrows the
// device.
class Simulation {
public:
    // The groom needs at least one strand and two vertices; `field_meshes[i]` is the mesh of
    // settings.distance_fields[i]; `deforming` is the mesh under the hair where settings.animation
    // plays one, and is borrowed. Settles the guides (see settle) for settings.settle_steps. What
    // was made before is taken as it is; a settled state that does not fit is not.
    // Throws Error for settings that make no sense, Unsupported for what the device can't do.
    Simulation(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        std::uint32_t seed, std::span<const groom::Mesh> field_meshes = {},
        const MadeBefore& made = {}, const groom::DeformingMesh* deforming = nullptr);

    // Bodies::warnings().
    std::vector<std::string> bodyWarnings() const { return bodies_.warnings(); }

    // For MadeBefore. They wait for the device.
    BakedField readField(std::size_t index) const { return bodies_.fields()[index].read(*device_); }
    SettledState readSettled() const;

    // What air does to every vertex, by the wind of the current time, until it is recorded again.
    // Recorded without wind too, so that frames with and without do the same work.
    void recordWind(engine::Commands& commands) const;

    // Whether hair acts on hair.
    bool hasVolume() const { return hair_hair_.has_value(); }
    // Adds the accelerations that hair gives hair. After recordWind.
    void recordVolume(engine::Commands& commands) const;

    // Whether the scene brings a force along: /simulation/force.
    bool hasForce() const { return force_.has_value(); }
    // Adds its accelerations. After recordVolume.
    void recordForce(engine::Commands& commands) const;

    // Whether a hand pulls at some time.
    bool hasPulls() const { return !settings_.pulls.empty(); }
    // Adds the accelerations of hands that pull now. After recordForce.
    void recordPulls(engine::Commands& commands) const;

    // One time step under gravity and the air and accelerations recorded last. Positions are then
    // visible to compute and to the stages before the rasteriser. A frame's first step goes into
    // the other copy of the guides, those after it into the same.
    void recordStep(engine::Commands& commands, Copy into = Copy::other);

    // Simulates steps without wind, the scene's own force and hands and waits for them; time stands
    // still.
    void settle(std::uint32_t steps);

    // Back to the state after construction, after all that was recorded or submitted before.
    void recordReset(engine::Commands& commands);
    // The same at once, when the device is done with what was submitted before.
    void reset();

    // Goes on from the present state with the wind, colliders, motion and pulls of `settings`,
    // which are the same in everything else. The state that reset() goes back to stays as it is: it
    // is of the old ones. The device must be done with what was submitted. Throws Error as the
    // constructor; nothing has changed then. Makes only pipelines that are needed for the first
    // time, so that it can be called for every frame.
    void carryOn(const SimulationSettings& settings);

    // Positions and those one substep earlier, [strand][vertex], m.
    void setState(std::span<const glm::vec3> positions, std::span<const glm::vec3> previous);

    // Holds vertices where they are from now on; numbers of [strand][vertex]. Roots are held anyway
    // and move with the head.
    void pin(std::span<const std::uint32_t> vertices);

    // Copied from the device after all that was submitted before, [strand][vertex], m.
    std::vector<glm::vec3> readPositions() const;
    std::vector<glm::vec3> readPrevious() const;
    // True at vertices in contact with a body and at all below them on the strand.
    std::vector<bool> readContacts() const;

    // How the guides are now. Waits for the device.
    GuideCondition condition() const;
    // Where /simulation/rest asks for a balanced rest shape and the solver has one; else null.
    const RestBalance* balance() const { return solver_ ? solver_->balance() : nullptr; }

    // Whether a step records anything: `none` does so only where the head moves.
    bool moves() const { return solver_ != nullptr; }
    double time() const { return static_cast<double>(steps_) * double{step_.whole}; }
    // The head's rigid motion now; where an animation deforms it, the mean of the guides' roots.
    RigidMotion pose() const { return poseAt(time()); }
    // What of it /simulation/motion does, after the animation.
    RigidMotion carried() const { return motion_.at(time()); }
    GuideView guides() const;

private:
    RigidMotion poseAt(double time) const;
    // How guides have moved since rest with their roots now, [guide].
    std::vector<RigidMotion> rootMotions() const;
    void recordSubsteps(
        engine::Commands& commands, std::uint32_t count, std::uint32_t from_copy, double from,
        double to) const;
    GuideAddresses addresses(std::uint32_t copy) const;
    GuideAddresses addresses() const { return addresses(current_); }
    std::vector<gpu::VertexCondition> inspect() const;
    // Lets bodies keep no vertex farther away than it is now, and brings the solver's rest shape
    // into balance by substeps of guides that should stay at rest.
    void balanceRest(std::span<const glm::vec3> start);
    PullPass pullPassOf(const SimulationSettings& settings) const;
    std::array<gpu::GuideParameters, 2> parametersWith(const gpu::Bodies& bodies) const;
    std::vector<glm::vec4> withMasses(std::span<const glm::vec3> positions) const;
    std::vector<const engine::Buffer*> state() const;

    const engine::Device* device_;
    SimulationSettings settings_;
    gpu::Step step_;
    std::uint32_t strand_count_;
    std::uint32_t vertices_per_strand_;
    std::uint32_t seed_;
    std::vector<bool> pinned_;  // [strand][vertex]
    HeadMotion motion_;
    std::optional<SkinnedRoots> roots_;
    Bodies bodies_;
    engine::Buffer rest_positions_;
    std::array<engine::Buffer, 2> positions_;  // [copy]
    std::array<engine::Buffer, 2> previous_;  // [copy]
    std::uint32_t current_ = 0;  // copy
    engine::Buffer accelerations_;
    engine::Buffer parameters_;  // gpu::GuideParameters [copy]
    WindPass wind_;
    std::optional<ForcePass> force_;
    std::optional<PullPass> pulls_;  // from the first pull on
    std::optional<HairHair> hair_hair_;
    std::optional<SegmentPass> segments_;  // where they keep out of bodies
    std::unique_ptr<GuideSolver> solver_;  // null: nothing moves
    std::vector<engine::Buffer> settled_;  // state() after construction
    std::uint64_t steps_ = 0;
};

}  // namespace hair::simulation
