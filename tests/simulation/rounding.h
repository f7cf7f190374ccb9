#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "hair/reference/solvers.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {

// How far the device may be from the reference after some steps. The bound comes from the problem
// and not from the device: a second reference is disturbed by the rounding of a float in every
// vertex after every step, and the distance between the two says how far the solver spreads one
// rounding a step.
struct Rounding {
    double spread;     // m
    double roundings;  // of a vertex in a step

    // The device rounds once per pull and sweep, independently, so its error is larger by the root
    // of their number; twice that, because it may divide and take roots to less than a float's
    // precision.
    double bound() const { return 2.0 * std::sqrt(roundings) * spread; }
};

// Corrections of a vertex in a step that round. Where a strand is solved or followed as a whole,
// each vertex has the roundings of all above it; one pass more is for what bodies pushed.
inline double pulls(const SimulationSettings& settings, std::uint32_t vertices_per_strand) {
    if (settings.solver == Solver::ftl) return vertices_per_strand;
    if (settings.length.method == LengthMethod::iterate)
        return settings.local.iterations + settings.length.iterations;
    return settings.local.iterations + vertices_per_strand * (settings.length.iterations + 1.0);
}

inline Rounding roundingAfter(
    int steps, const groom::Groom& groom, const SimulationSettings& settings, std::uint32_t seed) {
    reference::Reference solver(groom, settings, seed);
    reference::Reference rounded(groom, settings, seed);
    std::mt19937 random(1);
    for (int i = 0; i < steps; ++i) {
        solver.step();
        rounded.step();
        auto positions = std::vector(rounded.positions().begin(), rounded.positions().end());
        for (std::size_t v = 0; v < positions.size(); ++v)
            positions[v] *= glm::dvec3(1.0) + 0x1p-24 * randomVector(random);
        rounded.setState(
            positions, std::vector(rounded.previous().begin(), rounded.previous().end()));
    }
    return {
        largestDifference(rounded.positions(), solver.positions()),
        2.0 + 2.0 * pulls(settings, groom.vertices_per_strand)};
}

}  // namespace hair::simulation
