#include "benchmarks/physics/trajectory.h"

#include <cmath>

#include <glm/common.hpp>

#include "benchmarks/physics/experiment.h"
#include "benchmarks/physics/worst.h"

namespace benchmarks::physics {

namespace {

constexpr int kSamples = 60;
constexpr double kInterval = 1.0 / 30.0;  // s
constexpr std::uint32_t kPoints = 8;

// As a share of a step: what rounding of the step's length makes of a whole number.
constexpr double kNoFraction = 1e-3;

std::vector<glm::dvec3> every(const std::vector<glm::dvec3>& points, std::uint32_t stride) {
    std::vector<glm::dvec3> some;
    for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
    return some;
}

}  // namespace

Trajectory playRelease(
    const engine::Device& device, const hair::SimulationSettings& settings,
    std::uint32_t segments) {
    Experiment experiment(
        device, straightStrand(segments, kTrajectoryLength, {1.0, 0.0, 0.0}), settings);
    Trajectory trajectory;
    std::uint32_t step = 0;
    const auto goTo = [&](std::uint32_t target) {
        experiment.advance(target - step);
        step = target;
        return every(experiment.positions(), segments / kPoints);
    };
    for (int i = 1; i <= kSamples; ++i) {
        const double steps = i * kInterval / experiment.timeStep();
        const auto whole = static_cast<std::uint32_t>(steps + kNoFraction);
        std::vector<glm::dvec3> sample = goTo(whole);
        const double fraction = steps - whole;
        if (fraction > kNoFraction) {
            const std::vector<glm::dvec3> next = goTo(whole + 1);
            for (std::size_t point = 0; point < sample.size(); ++point)
                sample[point] = glm::mix(sample[point], next[point], fraction);
        }
        trajectory.push_back(std::move(sample));
    }
    return trajectory;
}

double differenceOf(const Trajectory& a, const Trajectory& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        greatest = worst(greatest, greatestDistance(a[i], b[i]));
    return greatest / kTrajectoryLength;
}

}  // namespace benchmarks::physics
