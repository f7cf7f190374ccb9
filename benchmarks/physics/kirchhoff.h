#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "hair/settings.h"

// Kirchhoff's inextensible rods in equilibrium, and where their equilibria end: shooting from the
// tip, in double precision.
namespace benchmarks::physics {

// What a cross-section resists with, N m^2.
struct SectionStiffness {
    double strong;  // E I of bending along the section's longer axis
    double weak;  // E I of bending along its shorter axis
    double twisting;  // G J
};

// Of an ellipse with the half axes a and b: I = pi a^3 b / 4 and pi a b^3 / 4, J = pi a^3 b^3 /
// (a^2
// + b^2) (Timoshenko and Goodier 1951, Theory of elasticity).
SectionStiffness sectionStiffness(const hair::MaterialSettings& material);

// A rod that is clamped at the origin and lies in the x-y plane, which its strong bending is in.
struct ClampedRod {
    SectionStiffness section;
    double weight;  // per length, along -y, N/m
    double length;  // m
    double clamp;  // angle of its tangent there from -y toward +x, rad
    double turn = 0.0;  // by how much it curves toward a growing angle without weight, rad
};

// What holds the rod in its plane: positive while nothing disturbs it for good, 0 where a bent
// state out of the plane branches off, 1 without weight if the rod is straight. Small rotations a2
// and a3 of the section round its axis d2 in the plane and its tangent d3, by the arc length s,
// obey
//   M2' = k M3 + n3 a2,         M2 = B (a2' - k a3) + M a3,
//   M3' = -k M2 - n2 a2,        M3 = C (a3' + k a2) - M a2,
//   a2 = a3 = 0 at the clamp,   M2 = M3 = 0 at the tip,
// k the curvature, M the moment and n2, n3 the weight below along d2 and d3 of the rod in its
// plane, B the weak and C the twisting stiffness: Kirchhoff's equations, m' + t x n = 0, linearised
// about that state. Returned is the determinant of (a2, a3) at the clamp over that at the tip.
// Where the rod resists bending in the plane without end, it is clamped level and straight, it
// vanishes at weight L^3 = 12.85 sqrt(B C): Prandtl 1899, Kipp-Erscheinungen; Timoshenko and Gere
// 1961, Theory of elastic stability.
double outOfPlaneStability(const ClampedRod& rod);

// The least length at which the rod leaves its plane; absent where it stays up to `most`. m
std::optional<double> bucklingLength(ClampedRod rod, double most);

// The least turn, of those in steps of 1 rad and between them, at which the rod leaves its plane;
// absent where it stays up to `most`. Good to 1e-4. rad
std::optional<double> leavingTurn(ClampedRod rod, double most);

// The tip of the rod that has left its plane toward +z, m; absent where it stays.
std::optional<glm::dvec3> buckledTip(const ClampedRod& rod);

// A rod without weight that is clamped straight down over level ground and pressed onto it, whose
// tip sticks to the ground under the clamp and turns freely. The elastica with the force (Q, P) of
// the ground, P upward, s from the tip, psi the tangent's angle from the vertical:
//   psi'' = Q cos psi - P sin psi,  psi'(0) = 0,  psi(1) = 0,  x(1) = 0,  y(1) = 1 - compression.
// Lengths are over the rod's, forces over E I / L^2. It slips where Q / P is the coefficient of
// friction: Sano, Yamaguchi and Wada 2017, Slip morphology of elastic strips on frictional rigid
// substrates; Romero et al. 2021, Physical validation of simulators in computer graphics.
struct PressedRod {
    double compression;
    double pressure;  // P
    double shear;  // |Q|
    glm::dvec2 middle;  // distance from the vertical through the clamp, and height
};

// Its shape where Q / P is that, on the branch that begins where the straight rod buckles (P =
// 20.19, tan sqrt(P) = sqrt(P)). Absent where Q / P never gets there before the rod itself touches
// the ground.
std::optional<PressedRod> pressedRod(double force_ratio);

}  // namespace benchmarks::physics
