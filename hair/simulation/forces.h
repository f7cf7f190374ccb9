#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/gpu_structs.h"
#include "hair/groom/groom.h"
#include "hair/groom/groom_size.h"
#include "hair/settings.h"
#include "hair/simulation/guide_solver.h"
#include "hair/simulation/head_motion.h"

// Forces on guides: wind, a function of the scene, hands that pull, and springs to the guides'
// places in a file.
namespace hair::simulation {

// ---- Wind ---------------------------------------------------------------------------------------

// Returns the wind's direction, a unit vector. Throws Error for a direction without length.
glm::dvec3 windDirection(const WindSettings& settings);

// Returns four unit vectors at `cone_angle` from the wind's direction d, 90 degrees apart round it:
// toward u, v, -u and -v, with u = perpendicular(d) and v = d x u. Throws Error for a direction
// without length.
std::array<glm::dvec3, 4> windCone(const WindSettings& settings);

// Thesis eq. 13 with simulated time instead of the frame number: sin^2(gust_rate time) + 0.5.
double windMagnitude(const WindSettings& settings, double time);

// gpu::AirDrag in double precision, and the rate of the drag along the hair.
//
// Air of velocity u along a hair exerts the force c mu u per length, with c = `drag_along`. c is 4
// pi / ln(4 nu x / (u r^2)) at a distance x from the end that the air meets (Glauert and Lighthill
// 1955, The axisymmetric boundary layer on a long thin cylinder), and 2 pi / (ln(2 L / r) - 3/2) of
// a hair of length L in creeping flow (Batchelor 1970, Slender-body theory), half of the drag
// across. Its logarithm hardly varies, so c is a setting. The drag's rate c mu / (pi r^2 rho) is
// some 1/s, as slow as hair's friction; drag across has 10 to 100/s. So the drag along the hair is
// an explicit acceleration, taken with the velocity at the time step's start: hair at rest and hair
// at its terminal speed feel the exact force at any step, and free hair, whose speed relative to
// the air falls as exp(-rate t), is off by first order in the step. The rate is limited to 1 over
// the time step, so no step reverses that speed.
struct DragFactors {
    double inertial;
    double viscous;
    double along;  // 1/s
};
DragFactors dragFactors(const WindSettings& settings, const MaterialSettings& material);

// Air that drags guides in every substep of a solver: shaders/simulation/air_drag.glsl.
struct AirAtGuides {
    const engine::Buffer* velocities = nullptr;  // vec4 [strand][vertex], m/s; null: no drag
    gpu::AirDrag drag{};
    float along = 0.0f;  // rate of the drag along the hair, 1/s
};

// Throws Error for wind with a direction without length.
void checkWind(const WindSettings& settings);

// The effect of air on every guide vertex in a time step. Thesis mode writes an acceleration to
// GuideAddresses::accelerations. Drag mode writes that of the drag along the hair; solvers apply
// the drag of air() across it.
class WindPass {
public:
    // Throws like checkWind.
    WindPass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    static engine::MemoryRows rows(std::uint64_t vertices, WindMode mode);

    // `settings` must have the same mode and have passed checkWind.
    void setWind(const WindSettings& settings) noexcept { settings_ = settings; }

    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

    // Records still air instead. In thesis mode still air has no effect.
    void recordCalm(engine::Commands& commands, const GuideAddresses& guides) const;

    // Returns the air, which stands still until something is recorded; without velocities in thesis
    // mode. Valid as long as the pass.
    AirAtGuides air() const;

private:
    void
    recordThesis(engine::Commands& commands, const GuideAddresses& guides, double magnitude) const;
    void recordAir(
        engine::Commands& commands, const GuideAddresses& guides, double speed, double time) const;

    WindSettings settings_;
    MaterialSettings material_;
    double step_;  // s, a whole one
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
    std::optional<engine::Buffer> air_;  // in drag mode
};

// ---- The scene's own force ----------------------------------------------------------------------

// Evaluates the function of /simulation/force at every guide vertex, and adds the acceleration to
// GuideAddresses::accelerations for a whole time step.
class ForcePass {
public:
    // Throws Error if the file was not read or does not compile.
    ForcePass(
        const engine::Device& device, std::uint32_t vertex_count,
        const SimulationSettings& settings);

    // Records the time step that starts at `time`.
    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

private:
    std::uint32_t vertex_count_;
    engine::ComputePipeline pipeline_;
};

// ---- Hands --------------------------------------------------------------------------------------

// The hand of a pull during a time step.
struct Hand {
    glm::dvec3 position;  // at the end of the step, m
    glm::dvec3 velocity;  // mean over the step, m/s
};

// Returns the hand in the time step from `from` to `to` (s); none if it does not pull. It pulls in
// steps with a middle between its first and last key, that is for most of each of these steps. So
// keys at multiples of the step work as written, however they are rounded. Before its first key and
// after its last, the hand is at that key's position.
//
// The implicit spring needs the hand's position at the end of the step. It uses the mean velocity,
// not the path's velocity at one time, because keys may be much closer than steps, and the path
// between them may be arbitrarily fast.
std::optional<Hand> handIn(const PullSettings& pull, double from, double to);

// Throws Error for pulls (/simulation/pulls/N) at missing vertices, and for keys with times that
// don't ascend.
void checkPulls(
    std::span<const PullSettings> pulls, std::uint32_t guides, std::uint32_t vertices_per_guide);

// Adds the acceleration of every guide vertex by the hands to GuideAddresses::accelerations, for a
// whole time step.
//
// A critically damped spring with the stiffness k and the damping c = 2 sqrt(k) holds vertex x at
// the hand h. Its acceleration a of x follows implicit Euler, which is stable for every k and time
// step dt: from the states of vertex and hand at the end of the step,
//     a = k (h' - x') + c (w - v'),   v' = v + dt (f + a),   x' = x + dt v',
// with the hand's velocity w and the known acceleration f: gravity and the buffer's contents. Hence
//     a = (k (h' - x - dt (v + dt f)) + c (w - v - dt f)) / (1 + c dt + k dt^2).
// At rest f + a = 0 and h - x = -f / k: the spring's own equilibrium, whatever the step.
//
// A vertex at a rest distance d from x gets a exp(-(d / radius)^2). With radius 0, only x gets a.
//
// Hands pull one after the other, each on the buffer that the earlier ones left. So a vertex held
// by several hands goes to their common equilibrium, and no further.
class PullPass {
public:
    // `pulls` must have passed checkPulls.
    PullPass(
        const engine::Device& device, std::uint32_t strand_count, std::uint32_t vertices_per_strand,
        const gpu::Step& step, std::vector<PullSettings> pulls);

    static engine::MemoryRows rows() { return {"simulation", {{"guide pull", sizeof(glm::vec4)}}}; }

    // `pulls` must have passed checkPulls.
    void setPulls(std::vector<PullSettings> pulls) noexcept { pulls_ = std::move(pulls); }

    // Records the time step that starts at `time`.
    void record(engine::Commands& commands, const GuideAddresses& guides, double time) const;

private:
    std::uint32_t vertex_count_;
    std::uint32_t vertices_per_strand_;
    gpu::Step step_;
    std::vector<PullSettings> pulls_;
    engine::Buffer held_;  // vec4: acceleration of the held vertex
    engine::ComputePipeline hold_;
    engine::ComputePipeline spread_;
};

// ---- Guides in a file ---------------------------------------------------------------------------

// The interval of a cache's samples that a time lies in.
struct CacheInterval {
    std::size_t before = 0;  // sample
    std::size_t after = 0;  // the next sample; `before` itself at the first or the last
    double fraction = 0.0;  // of the way between them, [0, 1)
};

// `times` must ascend. Before the first and after the last, time stands still.
CacheInterval intervalAt(const std::vector<double>& times, double time);

// Motion of guides from a file: groom::GuideCache. It moves the rest positions, which every solver
// reads: `none` puts guides there, the others hold roots there, and the global shape constraint
// pulls to them. Solvers with goals of their own get these moved by the same way.
//
// If guides follow, every vertex also has a critically damped spring with the stiffness k and the
// damping c = 2 sqrt(k) to its place h in the file, by the equations of PullPass:
//     a = (k (h' - x - dt (v + dt f)) + c (w - v - dt f)) / (1 + c dt + k dt^2)
// with the mean velocity w of h over the step. A vertex that moves with h stays with it.
class CachePass {
public:
    // `rest_positions` (vec4 [strand][vertex]) must live as long as this. `goals` may be null. Both
    // have their values for the groom at rest.
    CachePass(
        const engine::Device& device, const groom::Groom& groom,
        const engine::Buffer& rest_positions, const engine::Buffer* goals);

    // `size` is the groom's. Goals are GuideSolver::goals().
    static engine::MemoryRows rows(const groom::GroomSize& size, bool has_goals);

    bool follows() const { return stiffness_ > 0.0; }

    // Writes the rest positions and goals at a time, s. The caller orders it before and after other
    // compute work.
    void recordRest(engine::Commands& commands, double time) const;

    // Adds the springs' accelerations of a whole step to GuideAddresses::accelerations. The rest
    // positions must be those at its start. Orders its work after earlier compute work. The caller
    // orders later work.
    void recordFollow(
        engine::Commands& commands, const GuideAddresses& guides, const RigidMotion& head_before,
        const RigidMotion& head_after, double to) const;

private:
    gpu::CachePlace placeAt(double time) const;

    std::vector<double> times_;
    std::uint32_t vertex_count_;
    double stiffness_;  // 1/s^2; 0: guides don't follow
    const engine::Buffer* rest_positions_;
    const engine::Buffer* goals_;
    engine::Buffer samples_;  // vec4 [sample][strand][vertex]
    engine::Buffer goal_offsets_;  // vec4 [strand][vertex]; goals from rest positions
    engine::ComputePipeline rest_;
    engine::ComputePipeline follow_;
};

}  // namespace hair::simulation
