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
#include "hair/simulation/forces.h"
#include "hair/simulation/guide_solver.h"
#include "hair/simulation/hair_hair.h"
#include "hair/simulation/head_motion.h"
#include "hair/simulation/probes.h"
#include "hair/simulation/solvers.h"

namespace hair::simulation {

// Divides the simulated time of frames into whole steps and carries the remainder over. Counts time
// in 1/720,720 of a step, so that every ratio p / q of frame to step with q <= 16 is exact and no
// error accumulates. Any other ratio is off by less than 1e-6 steps a frame.
class FixedStep {
public:
    // `step` > 0, s.
    explicit FixedStep(double step);

    // Returns the steps to simulate for a frame that advances `frame_time` >= 0, s.
    std::uint32_t stepsFor(double frame_time);

    // The time carried over to the next step, in steps, below 1.
    double remainder() const;

    void reset() { parts_ = 0; }

private:
    double step_;
    std::int64_t parts_ = 0;  // time carried over to the next step
};

// The copy of the guides that a step writes, relative to the present copy. Earlier frames may still
// be drawing the copy that was drawn last. Steps into the other copy need not wait for them.
enum class Copy { other, same };

// The state of a simulation right after construction, on the host.
struct SettledState {
    std::vector<std::vector<std::byte>> buffers;
};

// Slow results of an earlier construction from the same groom, settings and seed, on the same
// device by the same program. Borrowed.
struct MadeBefore {
    std::span<const BakedField* const> fields{};  // [distance field], null: missing; or empty
    const SettledState* settled = nullptr;  // null: missing
};

// Guides between two steps, for drawing. If steps do not divide frames, frames advance by unequal
// numbers of steps, and guides that are drawn where the last step left them jump. Between the last
// two steps they move evenly. They are then drawn one time step late. A position is linear between
// two steps, so a turn by an angle a in a step cuts off at most the sagitta, a^2 / 8 of the radius.
class GuideInterpolation {
public:
    GuideInterpolation(const engine::Device& device, std::uint32_t vertex_count);

    static engine::MemoryRows rows(std::uint64_t vertices) {
        return {"simulation", {{"guide drawn positions", engine::bytesOf<glm::vec4>(vertices)}}};
    }

    // Writes the positions at a share, 0 to 1, of the way from those at address `from` to those at
    // `to`, both vec4 [vertex], m.
    void
    record(engine::Commands& commands, std::uint64_t from, std::uint64_t to, double share) const;

    const engine::Buffer& positions() const { return positions_; }  // vec4 [vertex], m

private:
    std::uint32_t vertex_count_;
    engine::Buffer positions_;
    engine::ComputePipeline pipeline_;
};

// The guides on the device and the compute passes that move them. A time step is recordWind, then,
// if there is one, recordVolume (hasVolume), recordForce (hasForce) and recordPulls (hasPulls),
// then recordStep. Simulated time is the number of recorded steps times the time step: nothing
// depends on frames or clocks. Solver `none` keeps the guides at rest on the head, and records
// nothing if the head stands still. Borrows the device.
class Simulation {
public:
    // The groom needs at least one strand and two vertices per strand. `field_meshes[i]` is the
    // mesh of settings.distance_fields[i]. `deforming` is the mesh under the hair if
    // settings.animation plays a clip; it is borrowed. Settles the guides for settings.settle_steps
    // (see settle). Uses `made` unchanged, except a settled state that does not fit. Throws Error
    // for inconsistent settings, Unsupported for anything that the device can't do.
    Simulation(
        const engine::Device& device, const groom::Groom& groom, const SimulationSettings& settings,
        std::uint32_t seed, std::span<const groom::Mesh> field_meshes = {},
        const MadeBefore& made = {}, const groom::DeformingMesh* deforming = nullptr);

    // Without those of interpolate().
    static engine::MemoryRows rows(
        const engine::DeviceInfo& device, const groom::GroomSize& size,
        const SimulationSettings& settings);

    // Bodies::warnings().
    std::vector<std::string> bodyWarnings() const { return bodies_.warnings(); }

    // For MadeBefore. These wait for the device.
    BakedField readField(std::size_t index) const { return bodies_.fields()[index].read(*device_); }
    SettledState readSettled() const;

    // Records the effect of air on every vertex, by the wind at the current time; it lasts until
    // the next recording. Record it without wind too, so that frames with and without wind do the
    // same work.
    void recordWind(engine::Commands& commands) const;

    // Whether hair touches or shelters hair.
    bool hasVolume() const { return hair_hair_.has_value(); }
    // Slows the air by the hair that it has passed, and adds the accelerations of hair-hair
    // contact. Call it after recordWind.
    void recordVolume(engine::Commands& commands) const;

    // Whether the scene supplies a force: /simulation/force.
    bool hasForce() const { return force_.has_value(); }
    // Adds the force's accelerations. Call it after recordVolume.
    void recordForce(engine::Commands& commands) const;

    // Whether there is a pull at any time.
    bool hasPulls() const { return !settings_.pulls.empty(); }
    // Adds the accelerations of hands that pull now. Call it after recordForce.
    void recordPulls(engine::Commands& commands) const;

    // Records one time step under gravity and the air and accelerations recorded last. Afterwards,
    // positions are visible to compute and to the stages before the rasteriser. A frame's first
    // step writes the other copy of the guides, later steps write the same copy.
    void recordStep(engine::Commands& commands, Copy into = Copy::other);

    // Makes guides(), drawnTime() and readDrawn() those between the last two steps, once
    // recordInterpolation() has been called. Each step must then be recorded into the other copy.
    void interpolate();
    // Records the guides at a share, 0 to 1, of the last step.
    void recordInterpolation(engine::Commands& commands, double share);

    // Simulates steps without wind, scene force and hands, and waits for them. Simulated time does
    // not advance.
    void settle(std::uint32_t steps);

    // Records the return to the state after construction, after everything recorded or submitted
    // before.
    void recordReset(engine::Commands& commands);
    // Resets at once. The device must have finished everything submitted before.
    void reset();

    // Continues from the present state with the wind, colliders, motion and pulls of `settings`,
    // which must be the same in everything else. reset() still goes back to the old state, made
    // with the old settings. The device must have finished everything submitted. Throws Error like
    // the constructor, and then nothing has changed. Makes only pipelines needed for the first
    // time, so it can be called every frame.
    void carryOn(const SimulationSettings& settings);

    // Sets positions, and positions one substep earlier, [strand][vertex], m.
    void setState(std::span<const glm::vec3> positions, std::span<const glm::vec3> previous);

    // Holds vertices at their present positions from now on; indices into [strand][vertex]. Roots
    // are always held and move with the head.
    void pin(std::span<const std::uint32_t> vertices);

    // Read back after everything submitted before, [strand][vertex], m.
    std::vector<glm::vec3> readPositions() const;
    std::vector<glm::vec3> readPrevious() const;
    // The positions that guides() has.
    std::vector<glm::vec3> readDrawn() const;
    // True at vertices in contact with a body and at all vertices below them on the strand.
    std::vector<bool> readContacts() const;

    // Waits for the device.
    GuideCondition condition() const;
    // Balance, if /simulation/rest asks for it and the solver has a rest shape; else null.
    const RestBalance* balance() const { return solver_ ? solver_->balance() : nullptr; }

    // Whether a step records anything. With `none`, only if the head moves.
    bool moves() const { return solver_ != nullptr; }
    double time() const { return static_cast<double>(steps_) * double{step_.whole}; }
    // The time of guides(): time(), or the time between two steps that they are interpolated to.
    double drawnTime() const;
    // The head's motions at that time, as pose() and carried().
    RigidMotion drawnPose() const { return poseAt(drawnTime()); }
    RigidMotion drawnCarried() const { return motion_.at(drawnTime()); }
    // Returns the head's present rigid motion. If an animation deforms the head, it is the mean of
    // the guides' roots.
    RigidMotion pose() const { return poseAt(time()); }
    // Returns the part of pose() by /simulation/motion, applied after the animation.
    RigidMotion carried() const { return motion_.at(time()); }
    GuideView guides() const;
    // Records the present frames of roots that an animation moves, and returns the present guides,
    // also if guides() are between two steps.
    ProbedGuides recordProbed(engine::Commands& commands) const;

private:
    RigidMotion poseAt(double time) const;
    // Returns the motion of each guide since rest, as given by its root now, [guide].
    std::vector<RigidMotion> rootMotions() const;
    void recordSubsteps(
        engine::Commands& commands, std::uint32_t count, std::uint32_t from_copy, double from,
        double to) const;
    GuideAddresses addresses(std::uint32_t copy) const;
    GuideAddresses addresses() const { return addresses(current_); }
    std::vector<gpu::VertexCondition> inspect() const;
    // Moves rest positions to the cache's first sample, and guides to where they then are.
    void startCache(const groom::Groom& groom);
    void recordFollow(engine::Commands& commands, double from, double to) const;
    // Limits each vertex's margin to its present distance from bodies. Balances the solver's rest
    // shape with substeps in which the guides should stay at rest.
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
    std::optional<PullPass> pulls_;  // since the first pull
    std::optional<HairHair> hair_hair_;
    std::optional<SegmentPass> segments_;  // if segments collide
    std::optional<CachePass> cache_;  // if the groom has a cache
    std::unique_ptr<GuideSolver> solver_;  // null: nothing moves
    std::vector<engine::Buffer> settled_;  // state() after construction
    std::uint64_t steps_ = 0;
    std::optional<GuideInterpolation> interpolation_;
    bool has_earlier_ = false;  // the other copy has the positions before the last step
    std::optional<double> drawn_share_;  // of the last step; absent: guides() is after it
};

}  // namespace hair::simulation
