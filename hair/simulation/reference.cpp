#include "hair/simulation/reference.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "hair/simulation/reference_constraints.h"

namespace hair {

Reference::Reference(const Groom& groom, const SimulationSettings& settings, std::uint32_t seed)
    : settings_(settings), seed_(seed), vertices_(groom.vertices_per_strand),
      rest_(groom.points.begin(), groom.points.end()), positions_(rest_), previous_(rest_) {}

void Reference::setState(
    std::span<const glm::dvec3> positions, std::span<const glm::dvec3> previous) {
    assert(positions.size() == rest_.size() && previous.size() == rest_.size());
    positions_.assign(positions.begin(), positions.end());
    previous_.assign(previous.begin(), previous.end());
}

void Reference::step() {
    const double wave = std::sin(double{settings_.wind.gust_rate} * time());
    std::vector<glm::dvec3> accelerations;
    for (std::size_t first = 0; first < rest_.size(); first += vertices_) {
        const auto weights =
            reference::windWeights(seed_, static_cast<std::uint32_t>(first / vertices_));
        const auto strand = reference::windAccelerations(
            std::span(positions_).subspan(first, vertices_),
            reference::strandWind(settings_.wind, weights), wave * wave + 0.5);
        accelerations.insert(accelerations.end(), strand.begin(), strand.end());
    }
    advance(accelerations);
    ++steps_;
}

void Reference::settle() { advance(std::vector(rest_.size(), glm::dvec3(0.0))); }

void Reference::advance(std::span<const glm::dvec3> wind_accelerations) {
    if (settings_.solver == Solver::none) return;
    for (std::size_t first = 0; first < rest_.size(); first += vertices_) {
        const auto rest = std::span<const glm::dvec3>(rest_).subspan(first, vertices_);
        const auto positions = std::span(positions_).subspan(first, vertices_);
        const auto previous = std::span(previous_).subspan(first, vertices_);
        std::vector<glm::dvec3> accelerations(vertices_);
        double length = 0.0;
        for (std::size_t i = 0; i < vertices_; ++i) {
            accelerations[i] = glm::dvec3(settings_.gravity) + wind_accelerations[first + i];
            if (i > 0) length += glm::distance(rest[i], rest[i - 1]);
        }
        const double local = localFactor(length / static_cast<double>(vertices_ - 1));

        positions[0] = previous[0] = rest[0];
        const std::vector<glm::dvec3> before(positions.begin(), positions.end());
        reference::integrate(
            positions, previous, accelerations, keptFactor(), double{settings_.time_step});
        reference::pullToRest(positions, rest, globalFactor());
        for (std::uint32_t i = 0; i < settings_.local.iterations; ++i)
            reference::pullToShape(positions, rest, local);
        for (std::uint32_t i = 0; i < settings_.length.iterations; ++i)
            reference::projectLengths(positions, rest);
        reference::pushOut(positions, before, settings_.colliders, settings_.collision);
    }
}

// The scalings that stiffness.h describes, from its text: the step against 1/60 s, 10 iterations
// and segments of 0.15/7 m.

double Reference::keptFactor() const {
    const double kept = 1.0 - double{settings_.friction};
    if (settings_.stiffness_scaling == StiffnessScaling::thesis) return kept;
    return std::pow(kept, double{settings_.time_step} * 60.0);
}

double Reference::globalFactor() const {
    const double k = settings_.global.stiffness;
    if (settings_.stiffness_scaling == StiffnessScaling::thesis || k == 1.0) return k;
    const double steps = double{settings_.time_step} * 60.0;
    const double c = k / (1.0 - k) * steps * steps;
    return c / (1.0 + c);
}

double Reference::localFactor(double segment_length) const {
    const double k = std::min(double{settings_.local.stiffness}, 0.95);
    if (settings_.stiffness_scaling == StiffnessScaling::thesis || k == 0.0) return k;
    if (segment_length == 0.0) return 0.95;
    const double steps = double{settings_.time_step} * 60.0;
    const double left = std::pow(1.0 - k, 10.0);  // of an error after a reference step
    const double left_by_step =
        std::pow(left, steps * steps * std::pow(0.15 / 7.0 / segment_length, 4.0));
    return std::min(1.0 - std::pow(left_by_step, 1.0 / settings_.local.iterations), 0.95);
}

}  // namespace hair
