#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/settings.h"

// Equilibria of Kirchhoff's inextensible rods, and their limits: shooting from the tip, or rods of
// many short segments, in double precision.
namespace benchmarks::physics {

// Stiffness of a cross-section, N m^2.
struct SectionStiffness {
    double strong;  // E I of bending along the section's longer axis
    double weak;  // E I of bending along its shorter axis
    double twisting;  // G J
};

// The stiffness of an ellipse with the half axes a and b: I = pi a^3 b / 4 and pi a b^3 / 4, J = pi
// a^3 b^3 / (a^2 + b^2) (Timoshenko and Goodier 1951, Theory of elasticity).
SectionStiffness sectionStiffness(const hair::MaterialSettings& material);

// A rod that is clamped at the origin and lies in the x-y plane, the plane of its strong bending.
struct ClampedRod {
    SectionStiffness section;
    double weight;  // per length, along -y, N/m
    double length;  // m
    double clamp;  // angle of its tangent at the clamp from -y towards +x, rad
    double turn = 0.0;  // natural curvature times length, towards a growing angle, rad
};

// Stability of the rod against leaving its plane. It is positive while the planar state is stable,
// 0 where a bent state out of the plane branches off, and 1 for a straight rod without weight.
// Small rotations a2 and a3 of the section round its axis d2 in the plane and its tangent d3, by
// the arc length s, obey
//   M2' = k M3 + n3 a2,         M2 = B (a2' - k a3) + M a3,
//   M3' = -k M2 - n2 a2,        M3 = C (a3' + k a2) - M a2,
//   a2 = a3 = 0 at the clamp,   M2 = M3 = 0 at the tip.
// k is the curvature, M the moment, n2 and n3 the weight below along d2 and d3 of the planar rod, B
// the weak and C the twisting stiffness. These are Kirchhoff's equations, m' + t x n = 0,
// linearised about the planar state. The function returns the determinant of (a2, a3) at the clamp
// over that at the tip. For a level, straight clamp and infinite stiffness in the plane, it
// vanishes at weight L^3 = 12.85 sqrt(B C): Prandtl 1899, Kipp-Erscheinungen; Timoshenko and Gere
// 1961, Theory of elastic stability.
double outOfPlaneStability(const ClampedRod& rod);

// The smallest length at which the rod leaves its plane, m; absent if it stays up to `most`.
std::optional<double> bucklingLength(ClampedRod rod, double most);

// The smallest turn at which the rod leaves its plane, rad, searched in steps of 1 rad and refined
// between them; absent if it stays up to `most`. Accurate to 1e-4.
std::optional<double> leavingTurn(ClampedRod rod, double most);

// The tip of the rod that has left its plane towards +z, m; absent if it stays.
std::optional<glm::dvec3> buckledTip(const ClampedRod& rod);

// A weightless rod that is clamped straight down above level ground and pressed onto it. Its tip
// sticks to the ground below the clamp and turns freely. It is an elastica with the force (Q, P) of
// the ground, P upward, s from the tip, and psi the tangent's angle from the vertical:
//   psi'' = Q cos psi - P sin psi,  psi'(0) = 0,  psi(1) = 0,  x(1) = 0,  y(1) = 1 - compression.
// Lengths are relative to the rod's, forces to E I / L^2. It slips where Q / P reaches the
// coefficient of friction: Sano, Yamaguchi and Wada 2017, Slip morphology of elastic strips on
// frictional rigid substrates; Romero et al. 2021, Physical validation of simulators in computer
// graphics.
struct PressedRod {
    double compression;
    double pressure;  // P
    double shear;  // |Q|
    glm::dvec2 middle;  // distance from the vertical through the clamp, and height
};

// Its shape for this Q / P, on the branch that begins where the straight rod buckles (P = 20.19,
// tan sqrt(P) = sqrt(P)). Absent if Q / P does not reach the value before the rod itself touches
// the ground.
std::optional<PressedRod> pressedRod(double force_ratio);

// A clamped rod of equal, rigid segments with elastic joints, which moves in the x-y plane. The
// unknowns are the angles of its segments from -y towards +x, so its length never changes:
//   sum_k M_ik a''_k = Q_i + sum_k l^2 mu_ik sin(a_k - a_i) a'_k^2,   M_ik = l^2 mu_ik cos(a_i -
//   a_k)
// mu_ik is the mass below both segments, l a segment's length, and Q_i the generalised force: the
// joints' moments EI / l times their bend (twice that at the clamp), the field on the masses, and
// the air's pressure along each segment, normal to it. With the masses of a continuous
// rod (half of a segment's at the tip), its error falls with the square of l.
struct PlanarRod {
    double stiffness;  // EI, N m^2; 0: a chain
    double length;  // m
    double clamp;  // rad
    double turn = 0.0;  // natural curvature times length, towards a growing angle, rad
    glm::dvec2 root{0.0};  // m
    std::vector<double> masses;  // [segment], of the vertex at its lower end, kg
    // Acceleration of a mass at a position (x, y), m/s^2.
    std::function<glm::dvec2(const glm::dvec2&)> field;
    glm::dvec2 wind{0.0};  // velocity of the air, m/s
    // Force per length, N/m, of a flow across the rod, m/s; an odd function. Empty: no air.
    std::function<double(double)> pressure{};
};

// A hair of the settings' material that hangs from a clamp at the origin under their weight, in
// their air if its mode is `drag`. Its rest shape is straight. m
PlanarRod planarHair(const hair::SimulationSettings& settings, std::size_t segments, double length);

// Vertices at these angles, from the root on, m.
std::vector<glm::dvec2> planarPoints(const PlanarRod& rod, std::span<const double> angles);

// The angles at rest near these, by Newton's method. Absent if there are none.
std::optional<std::vector<double>> planarRest(const PlanarRod& rod, std::vector<double> angles);

// The growth rate of small motions about a state at rest, 1/s: the greatest real part of the
// eigenvalues. Positive: the state is unstable in its plane. It is the limit of ln |exp(A t)| / t
// of the linear equations y' = A y, which repeated squaring finds without eigenvalues.
double planarGrowth(const PlanarRod& rod, std::span<const double> rest);

// Advances a moving rod by Runge and Kutta's method of fourth order.
void advancePlanar(
    const PlanarRod& rod, std::vector<double>& angles, std::vector<double>& rates, double step);

}  // namespace benchmarks::physics
