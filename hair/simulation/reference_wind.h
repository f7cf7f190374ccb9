#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/settings.h"
#include "hair/simulation/reference_factors.h"

// What air does to hair, in double and straight from the equations. Every span is the vertices of
// one strand, root first, in m; accelerations are in m/s^2 and zero at the root.
namespace hair::reference {

using ConstPoints = std::span<const glm::dvec3>;

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

// For one whole step under gravity and drag, where the vertices' velocity is
// (positions - previous) / step.sub, m/s. The tangent is halfway between those of the segments at
// the vertex; that of the segment above where these lie on each other.
std::vector<glm::dvec3> dragAccelerations(
    ConstPoints positions, ConstPoints previous, const SimulationSettings& settings,
    std::uint32_t seed, const Step& step, double time);

// windAccelerations or dragAccelerations, as the settings' mode says.
std::vector<glm::dvec3> airAccelerations(
    ConstPoints positions, ConstPoints previous, const SimulationSettings& settings,
    std::uint32_t seed, std::uint32_t strand, const Step& step, double time);

}  // namespace hair::reference
