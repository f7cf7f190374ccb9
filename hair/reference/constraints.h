#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/gpu_structs.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// The simulation's equations, one function each, in double precision, written directly from the
// papers: references for the GPU. Nothing here is shared with the shaders or with the code that
// feeds them.
//
// Every span is the vertices of one strand, root first, in m. The root is pinned: it has infinite
// mass, every other vertex mass 1. Segment i ends in vertex i, so segment 1 starts at the root.
// Iterations are red-black: first segments that end in odd vertices move, then those that end in
// even ones. A segment shorter than kShortest has no direction of its own.
namespace hair::reference {

using Points = std::span<glm::dvec3>;
using ConstPoints = std::span<const glm::dvec3>;
struct VertexContact;  // below

constexpr double kShortest = 1e-9;  // m, shortest segment with a direction

// Returns a unit vector perpendicular to `v` and to the axis of its smallest component; the second
// axis if `v` is 0.
glm::dvec3 sideways(const glm::dvec3& v);

// Thesis eq. 9 with friction. Leaves the root alone. `previous` becomes the positions before the
// call.
void integrate(
    Points positions, Points previous, ConstPoints accelerations, double velocity_kept,
    double substep);

// Returns v' = velocity + h K (air - v'): the velocity after an implicit step h of a free vertex to
// which everything else gives `velocity`.
glm::dvec3
withDrag(const glm::dvec3& velocity, const glm::dmat3& rate, const glm::dvec3& air, double h);

// Returns the fraction that remains of a later movement of the vertex across its tangent:
// 1 / (1 + h k), where k is the double eigenvalue of K.
double inverseMassIn(const glm::dmat3& rate, double h);

// Fraction of the vertices' inverse masses that air leaves, [vertex]: inverseMassIn(). Empty: 1.
using InverseMasses = std::span<const double>;

// Thesis eq. 10: an implicit step of a spring by the fraction c / (1 + c), where c is the spring's
// stiffness times the inverse mass.
void pullToRest(
    Points positions, ConstPoints rest, double stiffness, InverseMasses inverse_masses = {});

// Returns the frames of the segments, [vertex]: entry 0 is the root's, entry i >= 1 that of segment
// i. A frame turns the rest strand's directions into the current ones: R_0 = root_frame; R_1 is R_0
// followed by the smallest rotation from R_0 s_1 to t_1; R_i = P_i R_(i-1) Q_i^-1, where P_i and
// Q_i are the smallest rotations t_(i-1) -> t_i and s_(i-1) -> s_i of unit tangents now (t) and at
// rest (s). Opposite tangents turn round an axis perpendicular to the first tangent and to the
// coordinate axis of its smallest component. A segment without a direction at rest or now takes the
// tangent of the segment before it, or R_0 s_1 if it is the first. Rest tangents do likewise, the
// first with +y.
std::vector<glm::dmat3> segmentFrames(
    ConstPoints positions, ConstPoints rest, const glm::dmat3& root_frame = glm::dmat3(1.0));

// Thesis eq. 11, one red-black iteration with the frames of its start; Han and Harada 2012.
void pullToShape(
    Points positions, ConstPoints rest, double stiffness,
    const glm::dmat3& root_frame = glm::dmat3(1.0), InverseMasses inverse_masses = {});

// Thesis eq. 12, one red-black iteration. Coinciding vertices are separated along +y.
void projectLengths(Points positions, ConstPoints rest, InverseMasses inverse_masses = {});

// Moves the strand to the nearest positions, in the metric of the masses, at which segments have
// their rest lengths, by `passes` passes of simulation/constraints/length.glsl, which has the
// equations. 0 passes: no change. `met`: contact of each vertex with bodies; empty: none.
void solveLengths(
    Points positions, ConstPoints rest, std::uint32_t passes, InverseMasses inverse_masses = {},
    std::span<const VertexContact> met = {});

// Gap to a capsule with its margin.
struct CapsuleGap {
    double gap;  // from it to a point; negative inside
    glm::dvec3 normal;  // unit, away from the axis
};
CapsuleGap capsuleGap(const glm::dvec3& point, const Collider& collider, double margin);

// Returns the point where the straight path between two points first enters a capsule, without its
// margin, and the capsule's gap there. Absent if the path does not enter or starts inside.
std::optional<std::pair<glm::dvec3, CapsuleGap>>
entryInto(const Collider& collider, const glm::dvec3& from, const glm::dvec3& to);

// A vertex after contact with bodies, with the tangent plane of the last body that it touches, or
// else of the nearest.
struct VertexContact {
    glm::dvec3 position;
    glm::dvec3 normal{0.0};  // outward; 0 if there is no body
    double height = 0.0;  // of the plane along the normal
    bool touches = false;
    double held = 0.0;  // fraction of its motion along the surface that friction removes
};
// Returns the contact of a vertex that moved from `before` to `position`.
using PushOut = std::function<VertexContact(const glm::dvec3& position, const glm::dvec3& before)>;

// Contact of one vertex with every capsule, in list order, each in the frame that it moves with;
// sliding is the motion relative to the capsule. The vertex goes the shortest way to the capsule's
// surface plus margin; from a point on the axis it goes along the perpendicular described above. If
// its path enters the capsule, it goes no farther in than the tangent plane at the entry. Friction
// removes its motion along the surface, at most the coefficient times the depth: Macklin et al.
// 2014, Unified particle physics for real-time applications, eq. 24.
struct Contact {
    const SimulationSettings& settings;
    simulation::RigidMotion frame;  // of the head at the end of the substep
    simulation::RigidMotion frame_before;  // of the head at its start

    VertexContact operator()(const glm::dvec3& position, const glm::dvec3& before) const {
        VertexContact pushed{.position = position};
        double nearest = std::numeric_limits<double>::infinity();
        for (const Collider& collider : settings.colliders) {
            const bool on_head = collider.follows == Follows::head;
            const simulation::RigidMotion now = on_head ? frame : simulation::RigidMotion{};
            const simulation::RigidMotion then = on_head ? frame_before : simulation::RigidMotion{};
            const double margin = settings.collision.margin;
            glm::dvec3 here = seenFrom(now, pushed.position);
            const glm::dvec3 there = seenFrom(then, before);
            // A fast vertex stays in front of the plane at its entry.
            double held_back = 0.0;
            const auto entry =
                settings.collision.continuous ? entryInto(collider, there, here) : std::nullopt;
            if (entry) {
                const auto& [place, surface] = *entry;
                held_back = std::fmax(glm::dot(surface.normal, place - here), 0.0);
                here += held_back * surface.normal;
                pushed.position = now(here);
                if (held_back > 0.0) nearest = std::numeric_limits<double>::infinity();
            }
            const CapsuleGap surface = capsuleGap(here, collider, margin);
            if (surface.gap >= nearest) continue;
            nearest = held_back > 0.0 ? 0.0 : std::fmax(surface.gap, 0.0);
            pushed.normal = now.rotation * surface.normal;
            pushed.height = glm::dot(pushed.normal, pushed.position) - surface.gap;
            if (surface.gap >= 0.0 && held_back == 0.0) continue;
            const double depth = std::fmax(-surface.gap, 0.0);
            const glm::dvec3 without_friction = here + depth * surface.normal;
            const glm::dvec3 moved = without_friction - there;
            const glm::dvec3 slid = moved - glm::dot(moved, surface.normal) * surface.normal;
            const double most = double{settings.collision.friction} * (held_back + depth);
            pushed.held = glm::length(slid) > most ? most / glm::length(slid) : 1.0;
            pushed.position = now(without_friction - pushed.held * slid);
            pushed.touches = true;
        }
        return pushed;
    }

    static glm::dvec3 seenFrom(const simulation::RigidMotion& motion, const glm::dvec3& point) {
        return glm::conjugate(motion.rotation) * (point - motion.translation);
    }
};

// The scalings described in hair/simulation/stiffness.h, from its text and not from its code: the
// step relative to 1/60 s, 10 iterations and segments of 0.15/7 m.

// gpu::Step in double precision.
struct Step {
    double whole = 0.0;  // s
    double sub = 0.0;  // s
    std::uint32_t count = 1;
};

inline Step inDouble(const gpu::Step& step) {
    return {.whole = step.whole, .sub = step.sub, .count = step.count};
}

// Returns the fraction of the velocity left after a substep.
double keptFactor(const SimulationSettings& settings, const Step& step);
// Returns k_G of thesis eq. 10 for a substep.
double globalFactor(const SimulationSettings& settings, const Step& step);
// Returns k_L of thesis eq. 11 for an iteration on a strand with this mean segment length, m.
double localFactor(const SimulationSettings& settings, const Step& step, double segment_length);

// Returns substep^2 K of the local constraint with an energy, for the same strand.
double bendFactor(const SimulationSettings& settings, const Step& step, double segment_length);

struct FtlStep {
    ConstPoints accelerations;  // m/s^2
    std::span<const glm::dmat3> drag{};  // dragRates() of wind.h; empty: no air
    ConstPoints air{};  // m/s, if there is drag
    double substep = 0.0;  // s
    double velocity_kept = 1.0;
    double global_stiffness = 0.0;
    double velocity_correction = 0.0;  // s_damping of eq. 9
};

// One substep of follow the leader for one strand: Mueller, Kim and Chentanez 2012, Fast simulation
// of inextensible hair and fur, section 3. `rest` is the rest strand on the head at its present
// pose, and gives positions[0]. `previous` becomes the positions minus substep times velocity, with
// the velocities of eq. 9.
void stepFtl(
    Points positions, Points previous, ConstPoints rest, const FtlStep& step,
    const PushOut& push_out);

// Pulls by hands, in double precision, written directly from the equations of
// hair/simulation/forces.h.

// All strands at the start of a time step, [strand][vertex], m.
struct PulledHair {
    std::size_t vertices = 0;  // per strand
    std::span<const glm::dvec3> rest;
    std::span<const glm::dvec3> positions;
    std::span<const glm::dvec3> previous;
    double substep = 0.0;  // s
    double from = 0.0;  // of the time step, s
    double to = 0.0;
};

// Adds the pulls of the settings to accelerations that include everything else, also gravity,
// m/s^2.
void addPulls(
    std::span<const PullSettings> pulls, const PulledHair& hair,
    std::span<glm::dvec3> accelerations);

}  // namespace hair::reference
