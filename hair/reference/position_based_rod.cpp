#include "hair/reference/position_based_rod.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>

#include "hair/reference/constraints.h"
#include "hair/reference/wind.h"

namespace hair::reference {
namespace {

// Lower bound on a segment's length in C_s, over the strand's mean. Only coincident points fall
// below.
constexpr double kLeastConstraintLength = 0.1;

// Gradient of a constraint with three components by a quaternion's (x, y, z, w).
using TurnGradient = glm::dmat4x3;

// `change` gives the constraint's change with each of the four numbers.
template <class Change>
TurnGradient gradientOf(const Change& change) {
    TurnGradient gradient;
    const glm::dquat units[] = {
        {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.0}};
    for (int column = 0; column < 4; ++column) gradient[column] = change(units[column]);
    return gradient;
}

glm::dvec3 imaginary(const glm::dquat& q) { return {q.x, q.y, q.z}; }

struct PositionBasedStep {
    RodState& state;
    const RodRest& rest;
    const PositionBasedRodParameters& parameters;
    std::vector<glm::dvec3> before;  // positions of the vertices, m
    std::vector<glm::dquat> orientations_before;
    std::vector<glm::dvec3> positions;  // m
    std::vector<glm::dmat3> inverse_masses;  // inverse masses of vertices, 1/kg
    std::vector<double> inverse_inertias;  // inverse masses of quaternions, 1/(kg m^2)
    std::vector<glm::dvec3> stretch_multipliers;
    std::vector<glm::dvec3> joint_multipliers;

    std::size_t size() const { return rest.lengths.size(); }
    double per_square() const { return 1.0 / (parameters.substep * parameters.substep); }

    void predict(std::span<const glm::dvec3> accelerations, const RodRoot& root, const RodAir* air);
    void projectSegment(std::size_t i);
    void projectJoint(std::size_t i);
    void iterate();
    void finish();
};

void PositionBasedStep::predict(
    std::span<const glm::dvec3> accelerations, const RodRoot& root, const RodAir* air) {
    const double h = parameters.substep;
    before = state.positions();
    orientations_before = state.orientations;
    std::vector<glm::dmat3> drag(size(), glm::dmat3(0.0));
    if (air) {
        std::vector<glm::dvec3> axes;
        for (const glm::dquat& orientation : state.orientations)
            axes.push_back(orientation * glm::dvec3(0.0, 0.0, 1.0));
        drag = air->rates(tangentsBetween(axes), state.velocities);
    }
    state.root = root.rotation * rest.points[0] + root.translation;
    state.orientations[0] = root.rotation * rest.orientations[0];
    positions = {state.root};
    inverse_masses = {glm::dmat3(0.0)};
    inverse_inertias = {0.0};
    for (std::size_t i = 1; i < size(); ++i) {
        glm::dvec3 velocity = parameters.velocity_kept * state.velocities[i] + h * accelerations[i];
        if (air) velocity = withDrag(velocity, drag[i], air->velocities[i], h);
        const auto pin = state.pins.find(i);
        const bool held = pin != state.pins.end();
        positions.push_back(held ? pin->second : before[i] + h * velocity);
        inverse_masses.push_back(
            held ? glm::dmat3(0.0)
                 : glm::inverse(rest.masses[i] * (glm::dmat3(1.0) + h * drag[i])));
        inverse_inertias.push_back(1.0 / (4.0 * rest.inertias[i]));
        const glm::dvec3 turn = h * parameters.velocity_kept * state.angular_velocities[i];
        state.orientations[i] = glm::normalize(glm::dquat(1.0, 0.5 * turn) * state.orientations[i]);
    }
    stretch_multipliers.assign(size(), glm::dvec3(0.0));
    joint_multipliers.assign(size(), glm::dvec3(0.0));
}

void PositionBasedStep::projectSegment(std::size_t i) {
    const double mean = std::max(
        std::accumulate(rest.lengths.begin(), rest.lengths.end(), 0.0) /
            static_cast<double>(size() - 1),
        1e-6);
    const double length = std::max(rest.lengths[i], kLeastConstraintLength * mean);
    const glm::dquat q = state.orientations[i];
    const glm::dquat e3(0.0, 0.0, 0.0, 1.0);
    const auto axis = [&](const glm::dquat& a, const glm::dquat& b) {
        return imaginary(a * e3 * glm::conjugate(b));
    };
    // A segment without length at rest has no direction term.
    const double share = rest.lengths[i] / length;
    const glm::dvec3 residual = (positions[i] - positions[i - 1]) / length - share * axis(q, q);
    // The gradient of a unit segment: a shorter segment turns like one.
    const TurnGradient gradient =
        gradientOf([&](const glm::dquat& unit) { return -(axis(unit, q) + axis(q, unit)); });
    const double compliance = per_square() / (parameters.stretch_stiffness * length);
    const glm::dmat3 denominator = (inverse_masses[i - 1] + inverse_masses[i]) / (length * length) +
                                   inverse_inertias[i] * gradient * glm::transpose(gradient) +
                                   glm::dmat3(compliance);
    glm::dvec3& multiplier = stretch_multipliers[i];
    const glm::dvec3 more = -(glm::inverse(denominator) * (residual + compliance * multiplier));
    multiplier += more;
    positions[i - 1] -= inverse_masses[i - 1] * more / length;
    positions[i] += inverse_masses[i] * more / length;
    const glm::dvec4 turn = inverse_inertias[i] * (glm::transpose(gradient) * more);
    state.orientations[i] = glm::normalize(q + glm::dquat(turn.w, turn.x, turn.y, turn.z));
}

void PositionBasedStep::projectJoint(std::size_t i) {
    const glm::dquat half = rest.half_rotations[i];
    const glm::dquat back = glm::conjugate(half);
    const glm::dquat above = state.orientations[i - 1];
    const glm::dquat here = state.orientations[i];
    // Linear in both orientations.
    const auto rotation = [&](const glm::dquat& first, const glm::dquat& second) {
        return back * glm::conjugate(first) * second * back;
    };
    const double nearer = rotation(above, here).w < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 residual = nearer * imaginary(rotation(above, here));
    const TurnGradient by_above = gradientOf(
        [&](const glm::dquat& unit) { return nearer * imaginary(rotation(unit, here)); });
    const TurnGradient by_here = gradientOf(
        [&](const glm::dquat& unit) { return nearer * imaginary(rotation(above, unit)); });
    const glm::dvec3 compliance =
        per_square() /
        (4.0 * glm::dvec3(rest.bend_stiffness[i], rest.bend_stiffness[i], rest.twist_stiffness[i]));
    glm::dmat3 denominator = inverse_inertias[i - 1] * by_above * glm::transpose(by_above) +
                             inverse_inertias[i] * by_here * glm::transpose(by_here);
    for (int axis = 0; axis < 3; ++axis) denominator[axis][axis] += compliance[axis];
    glm::dvec3& multiplier = joint_multipliers[i];
    const glm::dvec3 more = -(glm::inverse(denominator) * (residual + compliance * multiplier));
    multiplier += more;
    const auto turn = [&](std::size_t segment, const TurnGradient& gradient) {
        const glm::dvec4 by = inverse_inertias[segment] * (glm::transpose(gradient) * more);
        glm::dquat& orientation = state.orientations[segment];
        orientation = glm::normalize(orientation + glm::dquat(by.w, by.x, by.y, by.z));
    };
    turn(i, by_here);
    if (i > 1) turn(i - 1, by_above);
}

void PositionBasedStep::iterate() {
    std::vector<std::size_t> down, up;
    for (std::size_t i = 1; i < size(); ++i) (i % 2 == 1 ? down : up).push_back(i);
    std::ranges::reverse(up);
    for (std::size_t k = 0; k < down.size(); ++k) {
        projectSegment(down[k]);
        projectJoint(down[k]);
        if (k >= up.size()) continue;
        projectSegment(up[k]);
        projectJoint(up[k]);
    }
}

void PositionBasedStep::finish() {
    const double h = parameters.substep;
    for (std::size_t i = 1; i < size(); ++i) {
        state.velocities[i] =
            state.pins.contains(i) ? glm::dvec3(0.0) : (positions[i] - before[i]) / h;
        state.edges[i] = positions[i] - positions[i - 1];
        const glm::dquat turn = state.orientations[i] * glm::conjugate(orientations_before[i]);
        state.angular_velocities[i] = 2.0 / h * (turn.w < 0.0 ? -1.0 : 1.0) * imaginary(turn);
    }
}

}  // namespace

void stepPositionBasedRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const PositionBasedRodParameters& parameters, const RodAir* air) {
    assert(accelerations.size() == rest.lengths.size());
    PositionBasedStep step{
        .state = state,
        .rest = rest,
        .parameters = parameters,
        .before = {},
        .orientations_before = {},
        .positions = {},
        .inverse_masses = {},
        .inverse_inertias = {},
        .stretch_multipliers = {},
        .joint_multipliers = {}};
    step.predict(accelerations, root, air);
    for (std::uint32_t i = 0; i < parameters.iterations; ++i) step.iterate();
    step.finish();
}

}  // namespace hair::reference
