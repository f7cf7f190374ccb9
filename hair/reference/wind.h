#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/reference/constraints.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"

// Effects of air on hair, in double precision, written directly from the equations. The turbulence
// is the curl of a potential. The derivatives come from the chain rule, term by term, and are never
// written out.

namespace hair::reference {

// Returns the velocity of eddies of one size; `point` is in cells. Divergence-free, mean 0 and
// r.m.s. 1 in each component.
//
// The potential's component r at x is the sum over the corners c of x's cell of
// W(x - c) (g_r(c) . (x - c)). This is gradient noise; its weight W is the product over the axes of
// 1 - (6 t^5 - 15 t^4 + 10 t^3), t = |x - c|. Gradients have entries uniformly distributed in (-1,
// 1).
glm::dvec3 curlNoise(const glm::dvec3& point, std::uint32_t seed);

// Sums octaves of curlNoise() at 2^i point + (2^i - 1) (0.37, 0.61, 0.23). Amplitudes are
// proportional to 2^(-i/3) (Kolmogorov), and their squares sum to 1. `point` is in cells of the
// largest eddies.
glm::dvec3 turbulence(const glm::dvec3& point, std::uint32_t octaves, std::uint32_t seed);

// Every span below is the vertices of one strand, root first, in m; accelerations are in m/s^2 and
// zero at the root.

// Returns four random numbers of a strand that sum to 1.
std::array<double, 4> windWeights(std::uint32_t seed, std::uint32_t strand);

// Returns the weighted sum of the cone's four vectors times the strength, m/s^2.
glm::dvec3 strandWind(const WindSettings& settings, const std::array<double, 4>& weights);

// Thesis eq. 13 and 14 for every vertex of a strand.
std::vector<glm::dvec3>
windAccelerations(ConstPoints positions, const glm::dvec3& wind, double magnitude);

// Velocity of the air in drag mode, m/s: the mean wind and the turbulence that it carries.
glm::dvec3
airVelocity(const WindSettings& settings, std::uint32_t seed, const glm::dvec3& point, double time);

// Returns the drag's acceleration of a free hair in air that flows across it with `speed`, m/s^2.
double
dragAcceleration(const WindSettings& settings, const MaterialSettings& material, double speed);

// Returns the tangents at the vertices between segments of these directions, each a unit vector or
// 0; entry i is the segment that ends in vertex i. A tangent is halfway between the directions of
// both segments, or that of the segment above if they fold back on each other. It is 0 if neither
// has a direction, and at the root.
std::vector<glm::dvec3> tangentsBetween(ConstPoints directions);
// Returns the tangents at a strand's vertices, from the directions between these positions.
std::vector<glm::dvec3> tangentsAt(ConstPoints positions);

// Returns K of the acceleration K (U - v), 1/s, by air with the velocity U on vertices with these
// tangents and velocities v. Symmetric and never negative, because air only acts across hair.
std::vector<glm::dmat3> dragRates(
    ConstPoints tangents, ConstPoints velocities, ConstPoints air,
    const SimulationSettings& settings);

// Returns the accelerations by drag along the hair in a time step, m/s^2: the rate drag_along mu /
// (pi r^2 rho), at most 1 over the step, times the air's velocity along the tangent relative to the
// vertex.
std::vector<glm::dvec3> alongAccelerations(
    ConstPoints positions, ConstPoints velocities, ConstPoints air,
    const SimulationSettings& settings, double step);

// Effects of air on a strand during a time step, except for alongAccelerations.
struct Air {
    std::vector<glm::dvec3> accelerations;  // windAccelerations in thesis mode
    std::vector<glm::dvec3> velocities;  // airVelocity in drag mode; else empty
};
Air airAt(
    ConstPoints positions, const SimulationSettings& settings, std::uint32_t seed,
    std::uint32_t strand, double time);

struct VolumeState {
    std::size_t vertices;  // per strand
    std::span<const glm::dvec3> rest;  // [strand][vertex], m
    std::span<const glm::dvec3> positions;  // m
    std::span<const glm::dvec3> previous;  // m, a substep earlier
    Step step;
    simulation::RigidMotion frame;  // of the head at the end of the step
    // Velocity difference of each vertex that friction left in the previous step, m/s, or with a
    // yield stress the elastic displacement in a step, in the head's axes; becomes that of this
    // step. Empty: no previous step. Null: not wanted.
    std::vector<glm::dvec3>* kept = nullptr;
    simulation::RigidMotion frame_before;  // of the head at the start of the step

    std::vector<glm::dvec3> velocities() const;  // [strand][vertex], m/s
};

// Returns the acceleration by hair-hair contact over the next step, [strand][vertex], m/s^2: the
// equations of hair/simulation/hair_hair.h on sparse grids in double precision. Zero if
// settings.hair_hair is off.
std::vector<glm::dvec3>
volumeAccelerations(const SimulationSettings& settings, const VolumeState& state);

// Slows the air at the vertices, m/s, by the hair upstream on the straight line against the flow:
// the equations of hair/simulation/hair_hair.h. Nothing without settings.hair_hair.shelter.
void shelterAir(
    const SimulationSettings& settings, const VolumeState& state, std::vector<glm::dvec3>& air);

}  // namespace hair::reference
