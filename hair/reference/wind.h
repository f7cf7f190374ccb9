#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/reference/constraints.h"
#include "hair/settings.h"

// What air does to hair, in double and straight from the equations. Its turbulence is the curl of a
// potential that is differentiated by the chain rule, term by term, and never written out.
namespace hair::reference {

// One size of eddies, in cells; divergence-free, mean 0 and r.m.s. 1 in each component.
//
// The potential's component r at x is the sum over the corners c of x's cell of
// W(x - c) (g_r(c) . (x - c)): gradient noise, whose weights are the product along the axes of
// 1 - (6 t^5 - 15 t^4 + 10 t^3), t = |x - c|. Gradients have entries evenly distributed in (-1, 1).
glm::dvec3 curlNoise(const glm::dvec3& point, std::uint32_t seed);

// Octaves of curlNoise() at 2^i point + (2^i - 1) (0.37, 0.61, 0.23), their amplitudes proportional
// to 2^(-i/3) (Kolmogorov) and their squares' sum 1. `point` is in the largest eddies' cells.
glm::dvec3 turbulence(const glm::dvec3& point, std::uint32_t octaves, std::uint32_t seed);

// Every span below is the vertices of one strand, root first, in m; accelerations are in m/s^2 and
// zero at the root.

// Four random numbers of a strand that sum to 1.
std::array<double, 4> windWeights(std::uint32_t seed, std::uint32_t strand);

// Sum of the four vectors of the cone, weighed and times the strength, m/s^2.
glm::dvec3 strandWind(const WindSettings& settings, const std::array<double, 4>& weights);

// Thesis eq. 13 and 14 for every vertex of a strand.
std::vector<glm::dvec3>
windAccelerations(ConstPoints positions, const glm::dvec3& wind, double magnitude);

// Velocity of the air in drag mode, m/s: the mean wind and the turbulence that it carries.
glm::dvec3
airVelocity(const WindSettings& settings, std::uint32_t seed, const glm::dvec3& point, double time);

// The drag's acceleration of a free hair in air that flows across it with `speed`, m/s^2.
double
dragAcceleration(const WindSettings& settings, const MaterialSettings& material, double speed);

// The tangents at the vertices, between segments of these directions, each a unit vector or 0
// (entry i is of the one that ends in vertex i): halfway between those of the segments at the
// vertex; that of the segment above where these lie on each other. 0 where neither has one, and at
// the root.
std::vector<glm::dvec3> tangentsBetween(ConstPoints directions);
// The same of a strand at these positions.
std::vector<glm::dvec3> tangentsAt(ConstPoints positions);

// What air with the velocity U does to vertices with these tangents and velocities v: K of the
// acceleration K (U - v), 1/s. Symmetric and never negative, since air brakes across hair alone.
std::vector<glm::dmat3> dragRates(
    ConstPoints tangents, ConstPoints velocities, ConstPoints air,
    const SimulationSettings& settings);

// v' = velocity + h K (air - v'), the end of an implicit step h of a free vertex that all else
// gives this velocity.
glm::dvec3
braked(const glm::dvec3& velocity, const glm::dmat3& rate, const glm::dvec3& air, double h);

// What that leaves of what moves the vertex across its tangent afterwards: 1 / (1 + h k), with k
// the two equal eigenvalues of K.
double lightnessIn(const glm::dmat3& rate, double h);

// What air does to a strand during a time step.
struct Air {
    std::vector<glm::dvec3> accelerations;  // windAccelerations in thesis mode
    std::vector<glm::dvec3> velocities;  // airVelocity in drag mode; else empty
};
Air airAt(
    ConstPoints positions, const SimulationSettings& settings, std::uint32_t seed,
    std::uint32_t strand, double time);

}  // namespace hair::reference
