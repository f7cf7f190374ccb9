#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

// One strand as an elastic rod, in double: a reference for the GPU's `rod` solver that shares no
// code with it. Vertices carry mass. Segments carry an orientation with the third axis along the
// segment, as in Kugelstadt and Schoemer 2016, Position and orientation based Cosserat rods. Rods
// neither stretch nor shear (a hair's own weight stretches it by a part in 10^6), so the segments'
// rotations are the only unknowns and lengths always hold. A step is implicit Euler, and each
// iteration is a Newton step for the whole strand. Its time is proportional to the strand's length,
// as in Deul et al. 2018, Direct position-based solver for stiff rods. But motion is solved for
// directly, by elimination from the tip up as in Featherstone 1983, The calculation of robot
// dynamics using articulated-body inertias. Deul et al. eliminate motion to get a system of forces,
// which is ill-conditioned for stiff rods of many short segments; ours is not. Tension straightens:
// Tournier et al. 2015, Stable constrained dynamics.
namespace hair::reference {

struct RodMaterial {
    double density = 1320.0;  // kg/m^3
    double radius = 37e-6;  // m, of a circle with the section's area
    double ellipticity = 1.0;  // longer over shorter axis of the section
    double section_angle = 0.0;  // rad, of the longer axis at the root from that of the frame
    double twist = 0.0;  // rad/m, beyond that of the points
    double youngs_modulus = 3.9e9;  // Pa
    double shear_modulus = 0.6e9;  // Pa
};

// All vectors are [vertex], root first. Segment i ends in vertex i, so entry 0 of segment data is
// the follicle's, which the head moves. Joint i joins segments i - 1 and i.
struct RodRest {
    std::vector<glm::dvec3> points;  // m
    std::vector<double> lengths;  // of segments, m
    std::vector<double> masses;  // of vertices, kg
    std::vector<double> inertias;  // of segments, round any axis, kg m^2
    std::vector<double> bend_stiffness;  // of joints, N m/rad
    std::vector<double> twist_stiffness;  // of joints, N m/rad
    std::vector<glm::dquat> orientations;  // of segments; the follicle's is the first one's
    std::vector<glm::dquat> half_rotations;  // at joints, half of the rotation from one to the next
    double ellipticity = 1.0;  // factor on the stiffness of bends round a frame's first axis
};

struct RodState {
    glm::dvec3 root{0.0};
    std::vector<glm::dvec3> edges;  // of segments, m
    std::vector<glm::dvec3> velocities;
    std::vector<glm::dquat> orientations;
    std::vector<glm::dvec3> angular_velocities;  // rad/s, axes of space
    // For Integrator::generalized_alpha: accelerations of vertices and segments, as used by the
    // velocities, and true ones from forces and inertia.
    std::vector<glm::dvec3> accelerations, true_accelerations;  // m/s^2
    std::vector<glm::dvec3> angular_accelerations, true_angular_accelerations;  // rad/s^2
    bool smooth = false;  // they are valid for a step of second order
    std::vector<glm::dquat> set;  // at joints, strain at which the share that yields has no torque
    std::map<std::size_t, glm::dvec3> pins;  // held vertices besides the root, and where, m

    std::vector<glm::dvec3> positions() const;  // m
};

// x -> rotation * x + translation, from the head's rest position.
struct RodRoot {
    glm::dquat rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    glm::dvec3 translation{0.0};
};

// `points`: at rest, m. Orientations at rest are parallel-transported from the first one. A segment
// shorter than kShortest takes the direction of the segment before it, or +y if it is the first.
RodRest makeRodRest(std::span<const glm::dvec3> points, const RodMaterial& material);

RodState rodAtRest(const RodRest& rest, const RodRoot& root = {});

// Returns the state at these positions that came from `previous` in `substep`. segmentFrames of
// constraints.h carries the rest orientations along.
RodState rodFrom(
    const RodRest& rest, std::span<const glm::dvec3> positions,
    std::span<const glm::dvec3> previous, double substep, const RodRoot& root = {});

// Air round a rod. It accelerates vertices by K (U - v), with K at the start of the step and v at
// its end.
struct RodAir {
    std::span<const glm::dvec3> velocities;  // U, m/s
    // Returns K for vertices with these tangents and velocities, 1/s, symmetric and never negative.
    std::function<std::vector<glm::dmat3>(
        std::span<const glm::dvec3> tangents, std::span<const glm::dvec3> velocities)>
        rates;
};

// generalized_alpha: Chung and Hulbert 1993, A time integration algorithm for structural dynamics
// with improved numerical dissipation, with half of the fastest motions left after a step, in the
// variables of Arnold and Bruels 2007, Convergence of the generalized-alpha scheme for constrained
// mechanical systems. Second order; alpha_m = 0, alpha_f = 1/3, gamma = 5/6, beta = 4/9. A step
// falls back to implicit Euler if the last Newton step of the step before turned a segment by more
// than kSmoothTurn, if vertices were pushed since, or if there is air. Otherwise a whipping strand
// would gain energy.
enum class Integrator { implicit_euler, generalized_alpha };

constexpr double kSmoothTurn = 1e-3;  // rad

// Hair that is held bent takes a set, by Zener's standard linear solid: share s of each joint's
// stiffness belongs to Maxwell's element, whose natural strain q relaxes towards the joint's
// present strain r in the time tau, and the rest to the rest shape. Strains are rotations between
// the frames that coincide at rest. The difference of r and q, 4 tan(angle / 4) round the axis of
// q^-1 r, falls as exp(-t / tau) while r is held. For small angles the laws are those of a linear
// solid: a held moment falls to 1 - s of its first, and the set of free hair falls as exp(-(1 - s)
// t / tau).
//
// A step of h takes r as linear in time, for which the strain e of Maxwell's element is exactly
// e' = E e + D (r' - r), with E = exp(-h / tau) and D = (1 - E) tau / h: Taylor, Pister and
// Goudreau 1970, Thermomechanical analysis of viscoelastic solids. `set` holds the strain p with e'
// = D (r' - p). It relaxes at the start of a step by E towards r, and the joint then pulls to it
// with the stiffness s D K. The step is of second order in h / tau.

// Numerical scheme of a step.
struct RodScheme {
    std::uint32_t iterations = 2;
    Integrator integrator = Integrator::implicit_euler;
    // tau of a Kelvin-Voigt material, s: a joint's torque is its stiffness times the sum of its
    // strain (bend and twist) and tau times the strain rate. Implicit Euler acts like a tau of one
    // substep in every force; this counts as part of `damping`.
    double damping = 0.0;
    double set_share = 0.0;  // s; 0: no set
    double set_time = 1.0;  // tau, s
};

// One step under these vertex accelerations, m/s^2, in this air, if any. `root` places the follicle
// at the end of the step. First multiplies velocities by `velocity_kept`.
void stepRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, double substep, double velocity_kept, const RodScheme& scheme,
    const RodAir* air = nullptr);

// Takes a step by implicit Euler, without further damping.
void stepRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, double substep, double velocity_kept, std::uint32_t iterations,
    const RodAir* air = nullptr);

// Moves the vertices to `positions`, as collisions do: velocities change accordingly, and segments
// turn along. The next step restores lengths.
void pushRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> positions, double substep);

// Returns the kinetic energy plus that of bending and twist, J. The caller adds the weight's. With
// a set, `scheme` and `substep` are those of the step before.
double rodEnergy(
    const RodState& state, const RodRest& rest, const RodScheme& scheme = {}, double substep = 1.0);

// Response of a joint between two frames that coincide at rest, in space axes.
struct Joint {
    double energy;  // J
    glm::dvec3 torque;  // on the second frame, N m; the first gets its opposite
    glm::dmat3 stiffness;  // torque per rotation of the second against the first, N m/rad
};

// A clamp is half of the joint between the second frame and its mirror image in the first.
enum class Clamp { no, yes };

// Bending by an angle b between the third axes costs -4 K ln cos(b / 2), a torque of
// 2 K tan(b / 2): the discrete elastica of Bobenko and Suris 1999, Discrete time Lagrangian
// mechanics on Lie groups. It is integrable like the smooth elastica, and needs few segments.
// Beyond 120 degrees the torque continues linearly. A clamp has half of the energy at twice the
// angle, with stiffnesses for the single angle. Twisting by t round the axis that remains after the
// smallest rotation between the third axes costs K t^2 / 2. This term fades when the axes are more
// than 120 degrees apart, because opposite axes have no smallest rotation.
//
// For a section with the axis ratio e, K becomes K (e cos^2 p + sin^2 p / e), where p is the
// direction of the bend's axis from the first axis of the frame halfway between the two. The longer
// axis of the section is the frame's second axis.
Joint bendAndTwist(
    const glm::dquat& first, const glm::dquat& second, double bend_stiffness,
    double twist_stiffness, Clamp clamp, double ellipticity = 1.0);

// Returns the smallest rotation between unit vectors. For opposite vectors its axis is
// perpendicular to the first vector and to the coordinate axis of its smallest component.
glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to);

// Returns the rotation, of unit length, that gives `rotation` when done twice, the short way round.
glm::dquat halfOf(const glm::dquat& rotation);

// Returns the rotation with the share `kept` of the tangent of a quarter of its angle, at most pi.
glm::dquat quarterTangentOf(const glm::dquat& rotation, double kept);

}  // namespace hair::reference
