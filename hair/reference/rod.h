#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

// One strand as an elastic rod, in double: what the `rod` solver on the GPU is tested against, and
// shares nothing with. Vertices carry mass, segments carry an orientation whose third axis lies
// along them, as in Kugelstadt and Schoemer 2016, Position and orientation based Cosserat rods.
// Rods neither stretch nor shear (a hair's own weight stretches it by a part in 10^6), so that the
// rotations of the segments are the only unknowns and lengths always hold. A step is implicit
// Euler; each of its iterations is a Newton step for the whole strand at once. As in Deul et al.
// 2018, Direct position-based solver for stiff rods, that takes time in proportion to its length;
// but it is the motion that is eliminated, from the tip up, as Featherstone 1983, The calculation
// of robot dynamics using articulated-body inertias, does it, and not the motion that leaves a
// system of the forces. That system gets ever worse conditioned for stiff rods of many short
// segments, this one does not. Tension straightens: Tournier et al. 2015, Stable constrained
// dynamics.
namespace hair::reference {

struct RodMaterial {
    double density = 1320.0;  // kg/m^3
    double radius = 37e-6;  // m, of a circle of the section's area
    double ellipticity = 1.0;  // longer over shorter axis of the section
    double youngs_modulus = 3.9e9;  // Pa
    double shear_modulus = 0.6e9;  // Pa
};

// Every vector is [vertex], root first; segment i ends in vertex i, so entry 0 of what segments
// have is the follicle's, which the head moves. Joint i is where segments i - 1 and i meet.
struct RodRest {
    std::vector<glm::dvec3> points;  // m
    std::vector<double> lengths;  // of segments, m
    std::vector<double> masses;  // of vertices, kg
    std::vector<double> inertias;  // of segments, round any axis, kg m^2
    std::vector<double> bend_stiffness;  // of joints, N m/rad
    std::vector<double> twist_stiffness;  // of joints, N m/rad
    std::vector<glm::dquat> orientations;  // of segments; the follicle's is the first one's
    std::vector<glm::dquat> half_rotations;  // at joints, half of the way from one to the next
    double ellipticity = 1.0;  // bends round a frame's first axis are as much stiffer than that
};

struct RodState {
    glm::dvec3 root{0.0};
    std::vector<glm::dvec3> edges;  // of segments, m
    std::vector<glm::dvec3> velocities;
    std::vector<glm::dquat> orientations;
    std::vector<glm::dvec3> angular_velocities;  // rad/s, axes of space
    // Of Integrator::generalized_alpha: accelerations of vertices and segments, as the velocities
    // took them and as forces and inertia have them.
    std::vector<glm::dvec3> accelerations, true_accelerations;  // m/s^2
    std::vector<glm::dvec3> angular_accelerations, true_angular_accelerations;  // rad/s^2
    bool smooth = false;  // they are good for a step of second order
    std::map<std::size_t, glm::dvec3> pins;  // vertices beside the root that are held, and where, m

    std::vector<glm::dvec3> positions() const;  // m
};

// x -> rotation * x + translation, from where the head was at rest.
struct RodRoot {
    glm::dquat rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    glm::dvec3 translation{0.0};
};

// The points at rest, m. Orientations at rest are parallel transport from the first one. A segment
// shorter than kShortest has the direction of the one before it, the first one +y.
RodRest makeRodRest(std::span<const glm::dvec3> points, const RodMaterial& material);

RodState rodAtRest(const RodRest& rest, const RodRoot& root = {});

// The state at these positions that has come from `previous` in `substep`. Orientations at rest
// go along by segmentFrames of constraints.h.
RodState rodFrom(
    const RodRest& rest, std::span<const glm::dvec3> positions,
    std::span<const glm::dvec3> previous, double substep, const RodRoot& root = {});

// Air round a rod. It accelerates vertices by K (U - v), K of the step's start, v of its end.
struct RodAir {
    std::span<const glm::dvec3> velocities;  // U, m/s
    // K of the vertices with these tangents and velocities, 1/s, symmetric and never negative.
    std::function<std::vector<glm::dmat3>(
        std::span<const glm::dvec3> tangents, std::span<const glm::dvec3> velocities)>
        rates;
};

// generalized_alpha: Chung and Hulbert 1993, A time integration algorithm for structural dynamics
// with improved numerical dissipation, with half of the fastest motions left after a step, in the
// variables of Arnold and Bruels 2007, Convergence of the generalized-alpha scheme for constrained
// mechanical systems. Of second order; alpha_m = 0, alpha_f = 1/3, gamma = 5/6, beta = 4/9. Where
// the last Newton step of a step before turned a segment by more than kSmoothTurn, vertices were
// pushed since, or there is air, a step is implicit Euler's: a strand that whips gains energy
// otherwise.
enum class Integrator { implicit_euler, generalized_alpha };

constexpr double kSmoothTurn = 1e-3;  // rad

// How the step goes, beside what acts on the rod.
struct RodScheme {
    std::uint32_t iterations = 2;
    Integrator integrator = Integrator::implicit_euler;
    // tau of Kelvin's and Voigt's material, s: a joint's torque is its stiffness times its bend and
    // twist, and times their rate and tau. Implicit Euler is as if there were the substep of it in
    // every force, which counts.
    double damping = 0.0;
};

// One step under these accelerations of the vertices, m/s^2, with the follicle where `root` has it
// at the step's end, and in this air, if any. Velocities are multiplied by `velocity_kept` first.
void stepRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, double substep, double velocity_kept, const RodScheme& scheme,
    const RodAir* air = nullptr);

// The same by implicit Euler without more damping than that.
void stepRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, double substep, double velocity_kept, std::uint32_t iterations,
    const RodAir* air = nullptr);

// Moves the vertices to `positions`, as collisions do: velocities change by as much, and segments
// turn along. Lengths come back in the next step.
void pushRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> positions, double substep);

// Kinetic energy and that of bending and twist, J. Weight is the caller's.
double rodEnergy(const RodState& state, const RodRest& rest);

// What a joint between two frames does that coincide at rest, in the axes of space.
struct Joint {
    double energy;  // J
    glm::dvec3 torque;  // on the second frame, N m; the first gets its opposite
    glm::dmat3 stiffness;  // torque per rotation of the second against the first, N m/rad
};

// A clamp is half of the joint between the second frame and its mirror image in the first.
enum class Clamp { no, yes };

// Bending by an angle b between the third axes costs -4 K ln cos(b / 2), a torque of 2 K tan(b /
// 2): the discrete elastica of Bobenko and Suris 1999, Discrete time Lagrangian mechanics on Lie
// groups, which is integrable as the smooth one is, and which few segments suffice for. Beyond 120
// degrees the torque goes on as a straight line. A clamp has half of the energy at twice the angle,
// the stiffnesses being those at the single angle. Twisting by t round the axis that is left after
// the smallest rotation between the third axes costs K t^2 / 2, which fades where the axes are more
// than 120 degrees apart: there is no such rotation between opposite ones.
//
// Of a section with the axes' ratio e K is K (e cos^2 p + sin^2 p / e), p the direction of the
// bend's axis from the first axis of the frame halfway between the two: the longer of the section's
// axes is the frame's second.
Joint bendAndTwist(
    const glm::dquat& first, const glm::dquat& second, double bend_stiffness,
    double twist_stiffness, Clamp clamp, double ellipticity = 1.0);

// The smallest rotation between unit vectors; between opposite ones, round an axis perpendicular to
// the first and to the coordinate axis it has least of.
glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to);

// The rotation that done twice is `rotation`, of unit length, the short way round.
glm::dquat halfOf(const glm::dquat& rotation);

}  // namespace hair::reference
