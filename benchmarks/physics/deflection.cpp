#include "benchmarks/physics/deflection.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace benchmarks::physics {

std::vector<glm::dvec3> deflected(
    std::span<const double> shape, double segment, const glm::dvec3& direction,
    const glm::dvec3& sideways) {
    double steepest = 0.0;
    for (std::size_t i = 1; i < shape.size(); ++i)
        steepest = std::max(steepest, std::abs(shape[i] - shape[i - 1]));
    std::vector<glm::dvec3> points{glm::dvec3(0.0)};
    for (std::size_t i = 1; i < shape.size(); ++i) {
        const double slope = kSmallSlope * (shape[i] - shape[i - 1]) / steepest;
        points.push_back(
            points.back() +
            segment * (slope * sideways + std::sqrt(1.0 - slope * slope) * direction));
    }
    return points;
}

double amountOf(
    std::span<const double> shape, std::span<const glm::dvec3> positions,
    const glm::dvec3& sideways) {
    double sum = 0.0;
    for (std::size_t i = 0; i < shape.size(); ++i)
        sum += shape[i] * glm::dot(positions[i], sideways);
    return sum;
}

}  // namespace benchmarks::physics
