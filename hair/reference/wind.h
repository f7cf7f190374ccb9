#pragma once

#include <array>
#include <cstdint>
#include <vector>

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

// The drag's accelerations for one whole step under gravity and drag, where the vertices' velocity
// is (positions - previous) / step.sub, m/s. The tangent is halfway between those of the segments
// at the vertex; that of the segment above where these lie on each other.
std::vector<glm::dvec3> dragAccelerations(
    ConstPoints positions, ConstPoints previous, const SimulationSettings& settings,
    std::uint32_t seed, const Step& step, double time);

// windAccelerations or dragAccelerations, as the settings' mode says.
std::vector<glm::dvec3> airAccelerations(
    ConstPoints positions, ConstPoints previous, const SimulationSettings& settings,
    std::uint32_t seed, std::uint32_t strand, const Step& step, double time);

}  // namespace hair::reference
