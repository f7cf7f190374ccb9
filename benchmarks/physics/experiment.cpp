#include "benchmarks/physics/experiment.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "benchmarks/interrupt.h"
#include "benchmarks/measure.h"
#include "benchmarks/physics/worst.h"
#include "engine/commands.h"
#include "hair/simulation/solver.h"

namespace benchmarks::physics {

namespace {

constexpr std::uint32_t kBatch = 64;  // steps per submission
constexpr std::uint32_t kSeed = 1;

std::vector<glm::vec3> toFloat(std::span<const glm::dvec3> points) {
    return {points.begin(), points.end()};
}

hair::Groom groomOf(const std::vector<glm::dvec3>& points) {
    return {
        .strand_count = 1,
        .vertices_per_strand = static_cast<std::uint32_t>(points.size()),
        .points = toFloat(points),
        .root_normals = {},
        .root_triangles = {}};
}

bool hasWind(const hair::WindSettings& wind) {
    return wind.mode == hair::WindMode::drag || wind.strength != 0.0f;
}

}  // namespace

hair::Groom straightStrand(std::uint32_t segments, double length, const glm::dvec3& direction) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i <= segments; ++i)
        points.push_back(length * i / segments * direction);
    return groomOf(points);
}

hair::Groom curvedStrand(std::uint32_t segments, double length, double curvature) {
    std::vector<glm::dvec3> points;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const double angle = curvature * length * i / segments;
        points.emplace_back((1.0 - std::cos(angle)) / curvature, -std::sin(angle) / curvature, 0.0);
    }
    return groomOf(points);
}

Experiment::Experiment(
    const engine::Device& device, const hair::Groom& groom,
    const hair::SimulationSettings& settings)
    : device_(&device), settings_(settings),
      substep_(double{settings.time_step} / hair::stepOf(settings).count),
      simulation_(device, groom, settings, kSeed) {}

void Experiment::advance(std::uint32_t steps) {
    const bool wind = hasWind(settings_.wind);
    while (steps > 0) {
        if (interrupted()) throw Interrupted{};
        const std::uint32_t batch = std::min(steps, kBatch);
        device_->runOnce([&](engine::Commands& commands) {
            for (std::uint32_t i = 0; i < batch; ++i) {
                if (wind) simulation_.recordWind(commands);
                simulation_.recordStep(commands);
            }
        });
        steps -= batch;
    }
}

bool Experiment::settle(double distance, double seconds) {
    const std::uint32_t look = stepsIn(0.1);
    std::vector<glm::dvec3> before = positions();
    for (std::uint32_t i = 0; i < stepsIn(seconds); i += look) {
        advance(look);
        std::vector<glm::dvec3> now = positions();
        if (greatestDistance(now, before) <= distance) return true;
        before = std::move(now);
    }
    return false;
}

void Experiment::place(std::span<const glm::dvec3> positions) {
    const std::vector<glm::vec3> points = toFloat(positions);
    simulation_.setState(points, points);
}

void Experiment::launch(
    std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities) {
    std::vector<glm::vec3> previous;
    for (std::size_t i = 0; i < positions.size(); ++i)
        previous.emplace_back(positions[i] - substep_ * velocities[i]);
    simulation_.setState(toFloat(positions), previous);
}

void Experiment::pin(std::uint32_t vertex) { simulation_.pin(std::span(&vertex, 1)); }

std::vector<glm::dvec3> Experiment::positions() const {
    const std::vector<glm::vec3> points = simulation_.readPositions();
    return {points.begin(), points.end()};
}

std::uint32_t Experiment::stepsIn(double seconds) const {
    return std::max(1u, static_cast<std::uint32_t>(std::lround(seconds / timeStep())));
}

double greatestDistance(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        greatest = worst(greatest, glm::distance(a[i], b[i]));
    return greatest;
}

}  // namespace benchmarks::physics
