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

// The simulation's equations, one function each, in double and straight from the papers: what the
// GPU is tested against. Nothing here is shared with the shaders or with what feeds them.
//
// Every span is the vertices of one strand, root first, in m. The root is pinned: it has infinite
// mass, every other vertex mass 1. Segment i ends in vertex i, so segment 1 holds the root.
// Iterations are red-black: segments that end in odd vertices move first, then those that end in
// even ones. A segment shorter than kShortest has no direction of its own.
namespace hair::reference {

using Points = std::span<glm::dvec3>;
using ConstPoints = std::span<const glm::dvec3>;
struct Pushed;  // below

constexpr double kShortest = 1e-9;  // m, of a segment that has a direction

// A unit vector at right angles to `v` and to the axis that it has least of; the second axis where
// `v` is 0.
glm::dvec3 sideways(const glm::dvec3& v);

// Thesis eq. 9 with friction; leaves the root alone. `previous` becomes the positions before the
// call.
void integrate(
    Points positions, Points previous, ConstPoints accelerations, double velocity_kept,
    double substep);

// What air leaves of the vertices' inverse masses, [vertex]: wind.h. Empty: all of them.
using Lightness = std::span<const double>;

// Thesis eq. 10: an implicit step of a spring that is c / (1 + c), c the spring's stiffness times
// the inverse mass.
void pullToRest(Points positions, ConstPoints rest, double stiffness, Lightness lightness = {});

// Frames of the segments, [vertex]: entry 0 is the root's, entry i >= 1 that of segment i. A frame
// turns the rest strand's directions into the current one's: R_0 = root_frame, R_1 is R_0 followed
// by the smallest rotation that takes R_0 s_1 to t_1, and R_i = P_i R_(i-1) Q_i^-1 with P_i, Q_i
// the smallest rotations t_(i-1) -> t_i and s_(i-1) -> s_i of unit tangents now (t) and at rest
// (s). Opposite tangents turn round an axis that is perpendicular to the first and to the
// coordinate axis it has least of. A segment that has no direction at rest or now takes the tangent
// of the segment before it, the first one R_0 s_1; the rest tangent likewise, the first one +y.
std::vector<glm::dmat3> segmentFrames(
    ConstPoints positions, ConstPoints rest, const glm::dmat3& root_frame = glm::dmat3(1.0));

// Thesis eq. 11, one red-black iteration with the frames of its start; Han and Harada 2012.
void pullToShape(
    Points positions, ConstPoints rest, double stiffness,
    const glm::dmat3& root_frame = glm::dmat3(1.0), Lightness lightness = {});

// Thesis eq. 12, one red-black iteration. Vertices that coincide are parted along +y.
void projectLengths(Points positions, ConstPoints rest, Lightness lightness = {});

// The nearest positions, in the metric of the masses, whose segments have their rest lengths, by so
// many passes of simulation/constraints/length.glsl, where the equations are. Zero: as they are.
// `met`: what bodies did to each vertex; empty: there are none.
void solveLengths(
    Points positions, ConstPoints rest, std::uint32_t passes, Lightness lightness = {},
    std::span<const Pushed> met = {});

// Of a capsule and the margin round it.
struct CapsuleGap {
    double gap;  // from it to a point; negative inside
    glm::dvec3 normal;  // unit, away from the axis
};
CapsuleGap capsuleGap(const glm::dvec3& point, const Collider& collider, double margin);

// Where the straight way from a point outside of a capsule to another first enters it, margin
// apart, as the capsule's gap there; absent where it does not, or starts inside.
std::optional<std::pair<glm::dvec3, CapsuleGap>>
entryInto(const Collider& collider, const glm::dvec3& from, const glm::dvec3& to);

// Where bodies leave a vertex: with the tangent plane of the last that it touches, else of the
// nearest.
struct Pushed {
    glm::dvec3 position;
    glm::dvec3 normal{0.0};  // outward; 0 where there is no body
    double height = 0.0;  // of the plane along the normal
    bool touches = false;
    double held = 0.0;  // share of its motion along the surface that friction takes back
};
// For a vertex that has moved from `before` to `position`.
using PushOut = std::function<Pushed(const glm::dvec3& position, const glm::dvec3& before)>;

// Contact of one vertex with every capsule, in the list's order, each in the frame that it moves
// with: what slides on it is the motion relative to it. The vertex goes to the capsule's surface,
// the margin away, the shortest way; from a point on the axis along the perpendicular described
// above. Where its way leads into the capsule it goes no farther in than the plane at which it
// enters. Friction takes back what it moved along the surface, at most the coefficient times the
// depth: Macklin et al. 2014, Unified particle physics for real-time applications, eq. 24.
struct Contact {
    const SimulationSettings& settings;
    simulation::RigidMotion frame;  // of the head at the end of the substep
    simulation::RigidMotion frame_before;  // of the head at its start

    // Where the vertex comes to lie that has moved from `before` to `position`.
    Pushed operator()(const glm::dvec3& position, const glm::dvec3& before) const {
        Pushed pushed{.position = position};
        double nearest = std::numeric_limits<double>::infinity();
        for (const Collider& collider : settings.colliders) {
            const bool on_head = collider.follows == Follows::head;
            const simulation::RigidMotion now = on_head ? frame : simulation::RigidMotion{};
            const simulation::RigidMotion then = on_head ? frame_before : simulation::RigidMotion{};
            const double margin = settings.collision.margin;
            glm::dvec3 here = seenFrom(now, pushed.position);
            const glm::dvec3 there = seenFrom(then, before);
            // What comes too fast stays before the plane at which it enters.
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

// The scalings that hair/simulation/stiffness.h describes, from its text and not from its code: the
// step against 1/60 s, 10 iterations and segments of 0.15/7 m.

// gpu::Step in double.
struct Step {
    double whole = 0.0;  // s
    double sub = 0.0;  // s
    std::uint32_t count = 1;
};

inline Step inDouble(const gpu::Step& step) {
    return {.whole = step.whole, .sub = step.sub, .count = step.count};
}

// Fraction of the velocity left after a substep.
double keptFactor(const SimulationSettings& settings, const Step& step);
// k_G of thesis eq. 10 for a substep.
double globalFactor(const SimulationSettings& settings, const Step& step);
// k_L of thesis eq. 11 for an iteration on a strand with this mean segment length, m.
double localFactor(const SimulationSettings& settings, const Step& step, double segment_length);

// substep^2 K of the local constraint with an energy, of such a strand.
double bendFactor(const SimulationSettings& settings, const Step& step, double segment_length);

struct FtlStep {
    ConstPoints accelerations;  // m/s^2
    std::span<const glm::dmat3> drag{};  // dragRates() of wind.h; empty: no air
    ConstPoints air{};  // m/s, where there is drag
    double substep = 0.0;  // s
    double velocity_kept = 1.0;
    double global_stiffness = 0.0;
    double velocity_correction = 0.0;  // s_damping of eq. 9
};

// One substep of follow the leader for one strand: Mueller, Kim and Chentanez 2012, Fast simulation
// of inextensible hair and fur, section 3. `rest` is the rest strand where the head is now, and
// positions[0] is taken from it. `previous` becomes positions less substep times velocity, with
// eq. 9's velocities.
void stepFtl(
    Points positions, Points previous, ConstPoints rest, const FtlStep& step,
    const PushOut& push_out);

// What hands do to hair, in double and straight from the equations of
// hair/simulation/pulls.h.

// Every strand at the start of a time step, [strand][vertex], m.
struct PulledHair {
    std::size_t vertices = 0;  // per strand
    std::span<const glm::dvec3> rest;
    std::span<const glm::dvec3> positions;
    std::span<const glm::dvec3> previous;
    double substep = 0.0;  // s
    double from = 0.0;  // of the time step, s
    double to = 0.0;
};

// Adds what the settings' hands give to accelerations that have all else, gravity too, m/s^2.
void addPulls(
    std::span<const PullSettings> pulls, const PulledHair& hair,
    std::span<glm::dvec3> accelerations);

}  // namespace hair::reference
