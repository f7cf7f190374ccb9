#include "hair/reference/augmented_mass_spring.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "hair/reference/constraints.h"
#include "hair/reference/wind.h"

namespace hair::reference {
namespace {

// Lower bound on the length that springs and edges divide by, over the strand's mean segment. Only
// coincident points fall below.
constexpr double kLeastSpan = 0.1;
constexpr std::size_t kFarthest = 3;  // vertices spanned by a spring
constexpr std::size_t kBand = 3 * kFarthest + 2;  // sub-diagonals of the scalar matrix

// A symmetric positive definite matrix with kBand diagonals below its main one, [row][row -
// column].
using BandMatrix = std::vector<std::array<double, kBand + 1>>;

// Solves in place: Cholesky's L replaces the lower half, and the solution the right-hand side.
void solveBand(BandMatrix& matrix, std::vector<double>& right) {
    const std::size_t size = matrix.size();
    for (std::size_t row = 0; row < size; ++row) {
        const std::size_t first = row > kBand ? row - kBand : 0;
        for (std::size_t column = first; column <= row; ++column) {
            double sum = matrix[row][row - column];
            for (std::size_t k = first; k < column; ++k)
                if (column - k <= kBand) sum -= matrix[row][row - k] * matrix[column][column - k];
            matrix[row][row - column] = column == row ? std::sqrt(sum) : sum / matrix[column][0];
        }
        for (std::size_t k = first; k < row; ++k) right[row] -= matrix[row][row - k] * right[k];
        right[row] /= matrix[row][0];
    }
    for (std::size_t row = size; row-- > 0;) {
        for (std::size_t k = row + 1; k < std::min(size, row + kBand + 1); ++k)
            right[row] -= matrix[k][k - row] * right[k];
        right[row] /= matrix[row][0];
    }
}

struct MassSpringStep {
    RodState& state;
    const RodRest& rest;
    const RodRoot& root;
    const AugmentedMassSpringParameters& parameters;
    std::vector<glm::dvec3> before;  // positions of the vertices, m
    std::vector<glm::dvec3> predicted;  // after free motion, m
    std::vector<glm::dvec3> positions;  // m
    std::vector<glm::dmat3> masses;  // kg, including air
    BandMatrix matrix;  // N/m
    std::vector<double> forces;  // N

    std::size_t size() const { return rest.lengths.size(); }
    double leastSpan() const {
        const double total = std::accumulate(rest.lengths.begin(), rest.lengths.end(), 0.0);
        return kLeastSpan * std::max(total / static_cast<double>(size() - 1), 1e-6);
    }
    bool holds(std::size_t i) const { return i == 0 || state.pins.contains(i); }

    void predict(std::span<const glm::dvec3> accelerations, const RodAir* air);
    void add(std::size_t i, std::size_t j, const glm::dmat3& stiffness);
    void stretch(std::size_t i, std::size_t j);
    void turn(std::size_t i);
    void iterate();
    void finish();
};

void MassSpringStep::predict(std::span<const glm::dvec3> accelerations, const RodAir* air) {
    const double h = parameters.substep;
    before = state.positions();
    std::vector<glm::dmat3> drag(size(), glm::dmat3(0.0));
    if (air) {
        std::vector<glm::dvec3> axes;
        for (const glm::dquat& orientation : state.orientations)
            axes.push_back(orientation * glm::dvec3(0.0, 0.0, 1.0));
        drag = air->rates(tangentsBetween(axes), state.velocities);
    }
    state.root = root.rotation * rest.points[0] + root.translation;
    state.orientations[0] = root.rotation * rest.orientations[0];
    predicted = {state.root};
    masses = {glm::dmat3(0.0)};
    for (std::size_t i = 1; i < size(); ++i) {
        glm::dvec3 velocity = parameters.velocity_kept * state.velocities[i] + h * accelerations[i];
        if (air) velocity = withDrag(velocity, drag[i], air->velocities[i], h);
        const auto pin = state.pins.find(i);
        predicted.push_back(pin == state.pins.end() ? before[i] + h * velocity : pin->second);
        masses.push_back(rest.masses[i] * (glm::dmat3(1.0) + h * drag[i]));
    }
    positions = predicted;
}

// Adds a block to rows i, columns j, and to rows j, columns i.
void MassSpringStep::add(std::size_t i, std::size_t j, const glm::dmat3& stiffness) {
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            if (3 * i + row >= 3 * j + column)
                matrix[3 * i + row][3 * i + row - 3 * j - column] +=
                    stiffness[static_cast<int>(column)][static_cast<int>(row)];
}

// The spring from vertex j to i > j.
void MassSpringStep::stretch(std::size_t i, std::size_t j) {
    const double length = glm::distance(rest.points[i], rest.points[j]);
    const double stiffness = parameters.spring_stiffness / std::max(length, leastSpan());
    const glm::dvec3 span = positions[i] - positions[j];
    const double now = std::max(glm::length(span), 1e-6 * leastSpan());
    const glm::dvec3 along = span / now;
    const glm::dvec3 force = stiffness * (now - length) * along;
    const glm::dmat3 projection = glm::outerProduct(along, along);
    const double across = std::max(1.0 - length / now, 0.0);
    const glm::dmat3 hessian = stiffness * (projection + across * (glm::dmat3(1.0) - projection));
    for (int axis = 0; axis < 3; ++axis) {
        forces[3 * i + static_cast<std::size_t>(axis)] -= force[axis];
        forces[3 * j + static_cast<std::size_t>(axis)] += force[axis];
    }
    add(i, i, hessian);
    add(j, j, hessian);
    add(i, j, -hessian);
}

// The angular spring of segment i.
void MassSpringStep::turn(std::size_t i) {
    const glm::dvec3 ghost = root.rotation * (rest.orientations[i] * glm::dvec3(0.0, 0.0, 1.0));
    const glm::dvec3 edge = positions[i] - positions[i - 1];
    const double length = std::max(glm::length(edge), leastSpan());
    const glm::dvec3 along = edge / std::max(glm::length(edge), 1e-6 * leastSpan());
    const glm::dvec3 away = ghost - glm::dot(ghost, along) * along;
    const double sine = glm::length(away);
    if (sine > 0.0) {
        const double angle = std::atan2(sine, glm::dot(ghost, along));
        const glm::dvec3 force =
            parameters.angular_stiffness * rest.lengths[i] / length * angle / sine * away;
        for (int axis = 0; axis < 3; ++axis) {
            forces[3 * i + static_cast<std::size_t>(axis)] += force[axis];
            forces[3 * (i - 1) + static_cast<std::size_t>(axis)] -= force[axis];
        }
    }
    const glm::dmat3 hessian = parameters.angular_stiffness * rest.lengths[i] / (length * length) *
                               (glm::dmat3(1.0) - glm::outerProduct(along, along));
    add(i, i, hessian);
    add(i - 1, i - 1, hessian);
    add(i, i - 1, -hessian);
}

void MassSpringStep::iterate() {
    const double per_square = 1.0 / (parameters.substep * parameters.substep);
    matrix.assign(3 * size(), {});
    forces.assign(3 * size(), 0.0);
    for (std::size_t i = 1; i < size(); ++i) {
        const double integrity = rest.masses[i] * parameters.integrity;
        const glm::dvec3 ghost = root.rotation * rest.points[i] + root.translation;
        const glm::dvec3 force = per_square * (masses[i] * (predicted[i] - positions[i])) +
                                 integrity * (ghost - positions[i]);
        for (int axis = 0; axis < 3; ++axis)
            forces[3 * i + static_cast<std::size_t>(axis)] += force[axis];
        add(i, i, per_square * masses[i] + glm::dmat3(integrity));
        for (std::size_t k = 1; k <= std::min(i, kFarthest); ++k) stretch(i, i - k);
        turn(i);
    }
    // Held vertices do not move.
    for (std::size_t i = 0; i < size(); ++i) {
        if (!holds(i)) continue;
        for (std::size_t row = 3 * i; row < 3 * i + 3; ++row) {
            matrix[row] = {};
            matrix[row][0] = 1.0;
            forces[row] = 0.0;
            for (std::size_t k = 1; k <= kBand && row + k < matrix.size(); ++k)
                matrix[row + k][k] = 0.0;
        }
    }
    solveBand(matrix, forces);
    for (std::size_t i = 1; i < size(); ++i)
        positions[i] += glm::dvec3(forces[3 * i], forces[3 * i + 1], forces[3 * i + 2]);
}

void MassSpringStep::finish() {
    for (std::size_t i = 1; i < size(); ++i) {
        state.velocities[i] = state.pins.contains(i)
                                  ? glm::dvec3(0.0)
                                  : (positions[i] - before[i]) / parameters.substep;
        state.edges[i] = positions[i] - positions[i - 1];
        if (glm::length(state.edges[i]) < 1e-6 * leastSpan()) continue;
        const glm::dvec3 axis = state.orientations[i] * glm::dvec3(0.0, 0.0, 1.0);
        state.orientations[i] = glm::normalize(
            rotationBetween(axis, glm::normalize(state.edges[i])) * state.orientations[i]);
    }
}

}  // namespace

void stepAugmentedMassSpring(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const AugmentedMassSpringParameters& parameters, const RodAir* air) {
    assert(accelerations.size() == rest.lengths.size());
    MassSpringStep step{
        .state = state,
        .rest = rest,
        .root = root,
        .parameters = parameters,
        .before = {},
        .predicted = {},
        .positions = {},
        .masses = {},
        .matrix = {},
        .forces = {}};
    step.predict(accelerations, air);
    for (std::uint32_t i = 0; i < parameters.iterations; ++i) step.iterate();
    step.finish();
}

}  // namespace hair::reference
