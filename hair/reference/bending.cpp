#include "hair/reference/bending.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace hair::reference {
namespace {

// Solves a symmetric positive definite system, stored row by row: Cholesky, then both triangular
// solves.
std::vector<double> solvePositive(std::vector<double> a, std::vector<double> b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
    return b;
}

// An unknown angle: along `direction` it turns everything below the vertex `about`.
struct Angle {
    std::size_t segment;
    glm::dvec3 direction;
    glm::dvec3 about;
};

}  // namespace

void bendStrand(Points positions, ConstPoints rest, const BendStep& step) {
    const std::size_t count = positions.size();
    const auto frames = segmentFrames(positions, rest, step.frame);
    std::vector<glm::dvec3> edges(count), tangents(count);
    std::vector<double> lengths(count);
    std::vector<bool> rigid(count);
    const glm::dvec3 first = rest[1] - rest[0];
    tangents[0] = step.frame * (glm::length(first) < kShortest ? glm::dvec3(0.0, 1.0, 0.0)
                                                               : glm::normalize(first));
    std::vector<Angle> angles;
    for (std::size_t i = 1; i < count; ++i) {
        edges[i] = positions[i] - positions[i - 1];
        lengths[i] = glm::distance(rest[i], rest[i - 1]);
        rigid[i] = glm::length(edges[i]) < kShortest || lengths[i] < kShortest;
        tangents[i] = rigid[i] ? tangents[i - 1] : glm::normalize(edges[i]);
        if (rigid[i]) continue;
        const glm::dvec3 sum = tangents[i - 1] + tangents[i];
        const glm::dvec3 axis = glm::length(sum) < 1e-3 ? tangents[i] : glm::normalize(sum);
        const glm::dvec3 side = sideways(axis);
        angles.push_back({i, side, positions[i - 1]});
        angles.push_back({i, glm::cross(axis, side), positions[i - 1]});
    }

    const std::size_t size = angles.size();
    std::vector<double> matrix(size * size), right(size);
    const glm::dvec3 root_moved = step.root - positions[0];
    // Adds |f + sum of angle * g|^2 / 2, in the metric given, to the substep's energy.
    const auto add = [&](std::size_t upTo, const auto& metric, const glm::dvec3& residual,
                         const auto& gradient) {
        std::vector<glm::dvec3> gradients;
        for (const Angle& angle : angles)
            if (angle.segment <= upTo) gradients.push_back(gradient(angle));
        for (std::size_t a = 0; a < gradients.size(); ++a) {
            const glm::dvec3 weighed = metric * gradients[a];
            right[a] += glm::dot(gradients[a], residual);
            for (std::size_t b = 0; b <= a; ++b)
                matrix[a * size + b] += glm::dot(weighed, gradients[b]);
        }
    };
    for (std::size_t i = 1; i < count; ++i) {
        const glm::dvec3 carried = root_moved + glm::cross(step.turn, positions[i] - positions[0]);
        add(i, step.masses[i], step.pushes[i] - step.masses[i] * carried, [&](const Angle& angle) {
            return glm::cross(angle.direction, positions[i] - angle.about);
        });
    }
    glm::dvec3 force{0.0};
    for (std::size_t i = count - 1; i > 0; --i) {
        force += step.pushes[i] + step.turning_pushes[i] - step.masses[i] * root_moved;
        if (rigid[i]) continue;
        const double tension = std::fmax(glm::dot(force, tangents[i]), 0.0);
        const glm::dmat3 across = tension * glm::length(edges[i]) *
                                  (glm::dmat3(1.0) - glm::outerProduct(tangents[i], tangents[i]));
        add(i, across, -(across * step.turn), [](const Angle& angle) { return angle.direction; });
    }
    for (std::size_t a = 0; a < size; ++a) {
        const std::size_t i = angles[a].segment;
        const glm::dvec3 goal = frames[i - 1] * (rest[i] - rest[i - 1]);
        right[a] += step.stiffness * glm::dot(angles[a].direction, glm::cross(edges[i], goal));
        matrix[a * size + a] += step.damping * step.stiffness * glm::dot(edges[i], edges[i]);
    }

    const std::vector<double> turns = solvePositive(std::move(matrix), std::move(right));
    glm::dvec3 turn = step.turn;
    glm::dvec3 place = step.root;
    positions[0] = place;
    for (std::size_t i = 1, a = 0; i < count; ++i) {
        for (; a < size && angles[a].segment == i; ++a) turn += turns[a] * angles[a].direction;
        glm::dvec3 direction(0.0, 1.0, 0.0);
        if (!rigid[i]) {
            const glm::dvec3 bounded = turn / std::fmax(glm::length(turn), 1.0);
            const glm::dvec3 gain = glm::cross(bounded, edges[i]);
            direction = glm::normalize(edges[i] + gain + 0.5 * glm::cross(bounded, gain));
        }
        if (lengths[i] >= kShortest) place += lengths[i] * direction;
        positions[i] = place;
    }
}

}  // namespace hair::reference
