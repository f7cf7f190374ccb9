#include "hair/reference/compared_rods.h"

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
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "hair/reference/constraints.h"
#include "hair/reference/wind.h"

namespace hair::reference {

// ---- Stable Cosserat rods -----------------------------------------------------------------------

namespace {

// Lower bound on a segment's length in its spring, over the strand's mean. Only coincident points
// fall below.
constexpr double kLeastSpringLength = 0.1;

// ---- Quaternions as vectors of four numbers -----------------------------------------------------

glm::dvec4 toVector(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }
glm::dquat toQuaternion(const glm::dvec4& v) { return {v.w, v.x, v.y, v.z}; }

// Returns the matrix of q -> a q b.
glm::dmat4 sandwich(const glm::dquat& a, const glm::dquat& b) {
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column) {
        glm::dvec4 unit(0.0);
        unit[column] = 1.0;
        matrix[column] = toVector(a * toQuaternion(unit) * b);
    }
    return matrix;
}

glm::dvec3 thirdAxis(const glm::dquat& q) { return q * glm::dvec3(0.0, 0.0, 1.0); }

// ---- Joints -------------------------------------------------------------------------------------

// Returns the part of a joint's stiffness in the quadratic part of its energy, for the components
// of r.
glm::dvec4 excessOf(const RodRest& rest, std::size_t i) {
    const double greatest = std::max(rest.bend_stiffness[i], rest.twist_stiffness[i]);
    const double bend = greatest - rest.bend_stiffness[i];
    return {bend, bend, greatest - rest.twist_stiffness[i], 0.0};
}

// Returns minus the gradient of E_bt by r.
glm::dvec4 pullAt(const RodRest& rest, std::size_t i, const glm::dvec4& r) {
    const double greatest = std::max(rest.bend_stiffness[i], rest.twist_stiffness[i]);
    glm::dvec4 pull = 4.0 * excessOf(rest, i) * r;
    pull.w = r.w < 0.0 ? -4.0 * greatest : 4.0 * greatest;
    return pull;
}

// r of joint i is linear in the orientation of either segment, or in its conjugate.
glm::dmat4 rOfSecond(const RodRest& rest, std::span<const glm::dquat> orientations, std::size_t i) {
    return sandwich(
        glm::conjugate(orientations[i - 1] * rest.half_rotations[i]),
        glm::conjugate(rest.half_rotations[i]));
}

glm::dmat4 rOfFirst(const RodRest& rest, std::span<const glm::dquat> orientations, std::size_t i) {
    const glm::dmat4 conjugate(
        {-1.0, 0.0, 0.0, 0.0}, {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, -1.0, 0.0}, {0.0, 0.0, 0.0, 1.0});
    return sandwich(
               glm::conjugate(rest.half_rotations[i]),
               orientations[i] * glm::conjugate(rest.half_rotations[i])) *
           conjugate;
}

// ---- A step -------------------------------------------------------------------------------------

struct CosseratStep {
    RodState& state;
    const RodRest& rest;
    const StableCosseratParameters& parameters;
    std::vector<glm::dvec3> before;  // positions of the vertices, m
    std::vector<glm::dvec3> predicted;  // y, m
    std::vector<glm::dvec3> positions;  // m
    std::vector<glm::dmat3> drag;  // 1/s
    std::vector<glm::dvec3> drifts{};  // displacements by the velocities alone, m

    std::size_t size() const { return rest.lengths.size(); }
    double mean() const {
        const double total = std::accumulate(rest.lengths.begin(), rest.lengths.end(), 0.0);
        return std::max(total / static_cast<double>(size() - 1), 1e-6);
    }
    // h k, where k is the double eigenvalue of K.
    double dragAt(std::size_t i) const {
        return parameters.substep * (drag[i][0][0] + drag[i][1][1] + drag[i][2][2]) / 2.0;
    }

    void predict(std::span<const glm::dvec3> accelerations, const RodRoot& root, const RodAir* air);
    glm::dvec4 neighboursPull(std::size_t i) const;
    void orient();
    void place();
    void guess();
    void descend();
    void turn();
    void finish();
};

void CosseratStep::predict(
    std::span<const glm::dvec3> accelerations, const RodRoot& root, const RodAir* air) {
    const double h = parameters.substep;
    before = state.positions();
    if (air) {
        std::vector<glm::dvec3> axes;
        for (const glm::dquat& orientation : state.orientations)
            axes.push_back(thirdAxis(orientation));
        drag = air->rates(tangentsBetween(axes), state.velocities);
    }
    state.root = root.rotation * rest.points[0] + root.translation;
    state.orientations[0] = root.rotation * rest.orientations[0];
    predicted = {state.root};
    drifts = {glm::dvec3(0.0)};
    for (std::size_t i = 1; i < size(); ++i) {
        drifts.push_back(h * parameters.velocity_kept * state.velocities[i]);
        glm::dvec3 velocity = parameters.velocity_kept * state.velocities[i] + h * accelerations[i];
        if (air) velocity = withDrag(velocity, drag[i], air->velocities[i], h);
        const auto pin = state.pins.find(i);
        if (pin != state.pins.end()) drag[i] = glm::dmat3(0.0);
        predicted.push_back(pin == state.pins.end() ? before[i] + h * velocity : pin->second);
    }
    positions = predicted;
}

// b, the pull of the neighbours' orientations on that of segment i.
glm::dvec4 CosseratStep::neighboursPull(std::size_t i) const {
    const std::vector<glm::dquat>& orientations = state.orientations;
    const glm::dvec4 here = toVector(orientations[i]);
    const glm::dmat4 above = rOfSecond(rest, orientations, i);
    glm::dvec4 b = glm::transpose(above) * pullAt(rest, i, above * here);
    if (i + 1 < size()) {
        const glm::dmat4 below = rOfFirst(rest, orientations, i + 1);
        b += glm::transpose(below) * pullAt(rest, i + 1, below * here);
    }
    return b;
}

void CosseratStep::orient() {
    std::vector<glm::dquat>& orientations = state.orientations;
    for (std::size_t i = 1; i < size(); ++i) {
        const glm::dvec4 b = neighboursPull(i);
        if (glm::length(b) == 0.0) continue;
        orientations[i] = balancedOrientation(
            toQuaternion(b), parameters.stretch_stiffness * (positions[i] - positions[i - 1]));
    }
}

// Solves the tridiagonal system by Gaussian elimination. Takes air's excess at the last positions.
void CosseratStep::place() {
    const double per_square = 1.0 / (parameters.substep * parameters.substep);
    std::vector<double> diagonal(size(), 0.0);
    std::vector<double> beside(size(), 0.0);  // between i - 1 and i
    std::vector<glm::dvec3> right(size(), glm::dvec3(0.0));
    const double shortest = kLeastSpringLength * mean();
    for (std::size_t i = 1; i < size(); ++i) {
        const double heavier = 1.0 + dragAt(i);
        const glm::dvec3 ahead = positions[i] - predicted[i];
        const glm::dvec3 excess = dragAt(i) * ahead - parameters.substep * (drag[i] * ahead);
        diagonal[i] += rest.masses[i] * per_square * heavier;
        right[i] += rest.masses[i] * per_square * (heavier * predicted[i] + excess);
        const double spring = parameters.stretch_stiffness / std::max(rest.lengths[i], shortest);
        const glm::dvec3 edge = rest.lengths[i] * thirdAxis(state.orientations[i]);
        diagonal[i] += spring;
        diagonal[i - 1] += spring;
        beside[i] = -spring;
        right[i] += spring * edge;
        right[i - 1] -= spring * edge;
    }
    const auto hold = [&](std::size_t i, const glm::dvec3& where) {
        diagonal[i] = 1.0;
        right[i] = where;
        if (i > 0) {
            right[i - 1] -= beside[i] * where;
            beside[i] = 0.0;
        }
        if (i + 1 < size()) {
            right[i + 1] -= beside[i + 1] * where;
            beside[i + 1] = 0.0;
        }
    };
    hold(0, state.root);
    for (const auto& [i, where] : state.pins) hold(i, where);
    for (std::size_t i = 1; i < size(); ++i) {
        const double factor = beside[i] / diagonal[i - 1];
        diagonal[i] -= factor * beside[i];
        right[i] -= factor * right[i - 1];
    }
    for (std::size_t i = size(); i-- > 0;) {
        glm::dvec3 rest_of_row = right[i];
        if (i + 1 < size()) rest_of_row -= beside[i + 1] * positions[i + 1];
        positions[i] = rest_of_row / diagonal[i];
    }
}

// The angular velocities, which these rods do not have, keep the last step's drift over its time.
void CosseratStep::guess() {
    for (std::size_t i = 1; i < size(); ++i) {
        const glm::dvec3 external = predicted[i] - before[i] - drifts[i];
        const double size2 = glm::dot(external, external);
        if (size2 > 0.0 && !state.pins.contains(i)) {
            const glm::dvec3 gained = drifts[i] - parameters.substep * state.angular_velocities[i];
            const double share = std::clamp(glm::dot(gained, external) / size2, 0.0, 1.0);
            positions[i] = before[i] + drifts[i] + share * external;
        }
        state.angular_velocities[i] = drifts[i] / parameters.substep;
    }
    state.orientations[1] = state.orientations[0];
}

// Moves each vertex by Newton's step of the energy in it alone, which is quadratic.
void CosseratStep::descend() {
    const double per_square = 1.0 / (parameters.substep * parameters.substep);
    const double shortest = kLeastSpringLength * mean();
    for (std::size_t i = 1; i < size(); ++i) {
        if (state.pins.contains(i)) continue;
        const glm::dvec3 ahead = positions[i] - predicted[i];
        // The gradient has the true drag across; the Hessian has it in all directions.
        glm::dvec3 gradient =
            rest.masses[i] * per_square * (ahead + parameters.substep * (drag[i] * ahead));
        double hessian = rest.masses[i] * per_square * (1.0 + dragAt(i));
        for (const std::size_t end : {i, i + 1}) {
            if (end >= size()) continue;
            const double spring =
                parameters.stretch_stiffness / std::max(rest.lengths[end], shortest);
            const glm::dvec3 stretched = positions[end] - positions[end - 1] -
                                         rest.lengths[end] * thirdAxis(state.orientations[end]);
            gradient += (end == i ? spring : -spring) * stretched;
            hessian += spring;
        }
        positions[i] -= gradient / hessian;
    }
}

// The paper's closed form, as printed.
void CosseratStep::turn() {
    std::vector<glm::dquat>& orientations = state.orientations;
    for (std::size_t i = 2; i < size(); ++i) {
        const glm::dvec4 b = neighboursPull(i);
        const glm::dquat v(
            0.0, -2.0 * parameters.stretch_stiffness * (positions[i] - positions[i - 1]));
        const double lambda = glm::length(v) + glm::length(b);
        const glm::dquat q =
            v * toQuaternion(b) * glm::dquat(0.0, 0.0, 0.0, 1.0) + lambda * toQuaternion(b);
        if (glm::length(q) > 0.0) orientations[i] = glm::normalize(q);
    }
}

void CosseratStep::finish() {
    for (std::size_t i = 1; i < size(); ++i) {
        state.velocities[i] = state.pins.contains(i)
                                  ? glm::dvec3(0.0)
                                  : (positions[i] - before[i]) / parameters.substep;
        state.edges[i] = positions[i] - positions[i - 1];
    }
}

}  // namespace

void stepStableCosserat(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, const StableCosseratParameters& parameters, const RodAir* air) {
    assert(accelerations.size() == rest.lengths.size());
    CosseratStep step{
        .state = state,
        .rest = rest,
        .parameters = parameters,
        .before = {},
        .predicted = {},
        .positions = {},
        .drag = std::vector(rest.lengths.size(), glm::dmat3(0.0))};
    step.predict(accelerations, root, air);
    const bool descends = parameters.method == CosseratMethod::descent;
    if (descends)
        step.guess();
    else
        step.orient();
    for (std::uint32_t i = 0; i < parameters.iterations; ++i) {
        if (descends) {
            step.descend();
            step.turn();
        } else {
            step.place();
            step.orient();
        }
    }
    step.finish();
}

void pushVertices(RodState& state, std::span<const glm::dvec3> positions, double substep) {
    const std::vector<glm::dvec3> before = state.positions();
    for (std::size_t i = 1; i < before.size(); ++i) {
        state.velocities[i] += (positions[i] - before[i]) / substep;
        state.edges[i] = positions[i] - positions[i - 1];
    }
}

double
bendTwistEnergy(const RodRest& rest, std::span<const glm::dquat> orientations, std::size_t i) {
    const glm::dvec4 r = rOfSecond(rest, orientations, i) * toVector(orientations[i]);
    const double greatest = std::max(rest.bend_stiffness[i], rest.twist_stiffness[i]);
    return 4.0 * greatest * (1.0 - std::abs(r.w)) - 2.0 * glm::dot(excessOf(rest, i) * r, r);
}

// The paper's closed form. For lambda > |v|, |q| falls from infinity, and the maximum is at
// |q| = 1. Newton's method for 1 / |q| = 1 in t = lambda - |v|, kept between bounds. The form
// lambda b + v b e3 = t b + (|v| b + v b e3) loses no precision for small t.
glm::dquat balancedOrientation(const glm::dquat& b, const glm::dvec3& edge) {
    const glm::dquat v(0.0, -2.0 * edge);
    const glm::dquat e3(0.0, 0.0, 0.0, 1.0);
    const double least = glm::length(v);
    const glm::dquat aligned = least * b + v * b * e3;
    const auto at = [&](double t, const glm::dquat& of, const glm::dquat& of_aligned) {
        return (t * of + of_aligned) / (t * (t + 2.0 * least));
    };
    double low = 0.0;
    double high = glm::length(b);
    double t = high;
    glm::dquat q = b;
    for (int i = 0; i < 100; ++i) {
        q = at(t, b, aligned);
        const double size = glm::length(q);
        (size > 1.0 ? low : high) = t;
        const glm::dquat slower = at(t, q, least * q + v * q * e3);
        const double newton = t + size * size * (size - 1.0) / glm::dot(q, slower);
        const double next = newton > low && newton < high ? newton : (low + high) / 2.0;
        if (std::abs(size - 1.0) < 1e-14 || next == t) break;
        t = next;
    }
    return glm::normalize(q);
}

// ---- Position-based rods ------------------------------------------------------------------------

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

// ---- Augmented mass-spring model ----------------------------------------------------------------

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
