#include "hair/reference/rod.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "hair/reference/constraints.h"
#include "hair/reference/wind.h"

namespace hair::reference {
namespace {

// rad, of a whole joint: beyond this angle the torque is linear.
constexpr double kSteepest = 2.0 * std::numbers::pi / 3.0;

// Bending energy over stiffness, and its first two derivatives by the angle.
struct Bend {
    double energy, torque, stiffness;
};

Bend bendBy(double angle, double copies) {
    const auto elastica = [&](double b) {
        const double cosine = std::cos(copies * b / 2.0);
        return Bend{
            -4.0 / (copies * copies) * std::log(cosine), 2.0 / copies * std::tan(copies * b / 2.0),
            1.0 / (cosine * cosine)};
    };
    const double end = kSteepest / copies;
    if (angle <= end) return elastica(angle);
    const Bend last = elastica(end);
    const double more = angle - end;
    return {
        last.energy + last.torque * more + last.stiffness * more * more / 2.0,
        last.torque + last.stiffness * more, last.stiffness};
}

// ---- A step -------------------------------------------------------------------------------------

// Lower bounds, over the strand's mean segment, on the length used for a segment's inertia and on a
// vertex's mass. Only coincident points fall below. The bounds avoid division by 0.
constexpr double kLeastLength = 0.1;
constexpr double kLeastMass = 0.01;
// Largest rotation of a segment in an iteration, rad: a Newton step from far away can overshoot.
constexpr double kMostTurn = 1.0;

// A pin is a spring on its vertex, as if the mass of a hundred rods had to return in one step.
constexpr double kPinMass = 100.0;

// Generalised alpha: the share of the earlier forces in an acceleration used by velocities,
// Newmark's two weights, and the fraction of h^2 over which the forces at the end of the step act.
constexpr double kAlphaForces = 1.0 / 3.0;
constexpr double kGamma = 5.0 / 6.0;
constexpr double kBeta = 4.0 / 9.0;
constexpr double kForceShare = kBeta * (1.0 - kAlphaForces);
// Relative to the strand's mean segment. A segment that collisions stretch by more returns at once,
// and says nothing about the acceleration.
constexpr double kLeastResidual = 1e-4;

const glm::dmat3 kIdentity(1.0);

// crossMatrix(a) b = a x b.
glm::dmat3 crossMatrix(const glm::dvec3& a) {
    return {{0.0, a.z, -a.y}, {-a.z, 0.0, a.x}, {a.y, -a.x, 0.0}};
}

glm::dvec3 axisOf(const glm::dquat& orientation) { return orientation * glm::dvec3(0.0, 0.0, 1.0); }

// Returns the orientation turned by a rotation vector, to second order, and by less than half a
// turn at any length.
glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& rotation) {
    return glm::normalize(glm::dquat(1.0, 0.5 * rotation) * orientation);
}

// Share of a strain that Maxwell's element keeps on average during a step.
double meanKept(const RodScheme& scheme, double substep) {
    return -std::expm1(-substep / scheme.set_time) * scheme.set_time / substep;
}

Joint jointAt(
    const RodState& state, const RodRest& rest, std::size_t i, const RodScheme& scheme,
    double substep) {
    const glm::dquat first = state.orientations[i - 1] * rest.half_rotations[i];
    const glm::dquat second = state.orientations[i] * glm::conjugate(rest.half_rotations[i]);
    const auto about = [&](const glm::dquat& half, double share) {
        return bendAndTwist(
            first * half, second * glm::conjugate(half), share * rest.bend_stiffness[i],
            share * rest.twist_stiffness[i], i == 1 ? Clamp::yes : Clamp::no, rest.ellipticity);
    };
    Joint joint = about(glm::dquat(1.0, 0.0, 0.0, 0.0), 1.0 - scheme.set_share);
    if (scheme.set_share > 0.0) {
        const double mean = meanKept(scheme, substep);
        const Joint yielding = about(halfOf(state.set[i]), scheme.set_share * mean);
        joint.energy += mean * yielding.energy;
        joint.torque += yielding.torque;
        joint.stiffness += yielding.stiffness;
    }
    return joint;
}

// A step's unknowns are the segments' rotations. The vertices follow, so lengths never change. The
// step minimises
//   sum over i of  m_i / (2 h^2) |displacement_i|^2 + j_i / (2 h^2) |rotation_i|^2 + U_i,
// both measured from the prediction, with the energy U_i of joint i. All terms are in N m. With air
// drag, the prediction has the velocities of free vertices in the air, and |d|^2 becomes
// d (1 + h K) d.
//
// Generalised alpha predicts from the earlier accelerations instead, and lets forces act over
// kForceShare of h^2. A joint's viscosity is its stiffness against its turn in the substep.
struct RodSubstep {
    RodState& state;
    const RodRest& rest;
    const RodScheme& scheme;
    bool second_order;
    double substep;
    std::vector<glm::dvec3> displacements;  // of vertices, m
    std::vector<glm::dvec3> rotations;  // of segments, rad
    std::vector<glm::dmat3> drag;  // of vertices, 1/s
    std::vector<glm::dvec3> predicted_turns;  // of segments, rad; the first is the follicle's
    std::vector<glm::dvec3> loads;  // accelerations of the vertices, m/s^2
    bool stretched = false;  // by collisions

    std::size_t size() const { return rest.lengths.size(); }
    double forceShare() const { return second_order ? kForceShare : 1.0; }
    // Viscosity of joints, over their stiffness.
    double viscosity() const {
        return second_order ? scheme.damping / substep
                            : std::max(scheme.damping / substep - 1.0, 0.0);
    }
    // Returns the contribution of earlier accelerations to a prediction, m or rad.
    glm::dvec3 carried(const glm::dvec3& taken, const glm::dvec3& real) const {
        return substep * substep * ((0.5 - kBeta) * taken + kBeta * kAlphaForces * real);
    }
    glm::dmat3 massOf(std::size_t i) const {
        if (!state.pins.contains(i)) return rest.masses[i] * (glm::dmat3(1.0) + substep * drag[i]);
        return glm::dmat3(kPinMass * std::accumulate(rest.masses.begin(), rest.masses.end(), 0.0));
    }

    void predict(
        std::span<const glm::dvec3> accelerations, const RodRoot& root, double kept,
        const RodAir* air);
    void iterate();
    // Turns segments by `turns` and moves the vertices along.
    void turn(std::span<const glm::dvec3> turns);
    void finish();
};

void RodSubstep::predict(
    std::span<const glm::dvec3> accelerations, const RodRoot& root, double velocity_kept,
    const RodAir* air) {
    if (air) {
        std::vector<glm::dvec3> axes;
        for (const glm::dquat& orientation : state.orientations)
            axes.push_back(axisOf(orientation));
        drag = air->rates(tangentsBetween(axes), state.velocities);
    }
    const glm::dvec3 root_now = root.rotation * rest.points[0] + root.translation;
    state.velocities[0] = (root_now - state.root) / substep;
    state.root = root_now;
    const glm::dquat follicle = root.rotation * rest.orientations[0];
    const glm::dquat follicle_before = state.orientations[0];
    const glm::dquat turned_by = follicle * glm::conjugate(follicle_before);
    predicted_turns = {
        (turned_by.w < 0.0 ? -2.0 : 2.0) * glm::dvec3(turned_by.x, turned_by.y, turned_by.z)};
    state.orientations[0] = follicle;
    // The prediction itself stretches segments; displacements are relative to it.
    glm::dvec3 residuals{0.0};  // by collisions, from the root down
    const double mean = std::accumulate(rest.lengths.begin(), rest.lengths.end(), 0.0) /
                        static_cast<double>(size() - 1);
    glm::dvec3 position = state.root;
    std::vector<glm::dvec3> turns{glm::dvec3(0.0)};
    for (std::size_t i = 1; i < size(); ++i) {
        if (scheme.set_share > 0.0) {
            const glm::dquat above = i == 1 ? follicle_before : state.orientations[i - 1];
            const glm::dquat& half = rest.half_rotations[i];
            const glm::dquat now =
                glm::conjugate(above * half) * state.orientations[i] * glm::conjugate(half);
            const glm::dquat apart = glm::conjugate(now) * state.set[i];
            state.set[i] = now * quarterTangentOf(apart, std::exp(-substep / scheme.set_time));
        }
        state.velocities[i] *= velocity_kept;
        if (!second_order) state.velocities[i] += substep * accelerations[i];
        if (air)
            state.velocities[i] =
                withDrag(state.velocities[i], drag[i], air->velocities[i], substep);
        state.angular_velocities[i] *= velocity_kept;
        const glm::dvec3 edge = rest.lengths[i] * axisOf(state.orientations[i]);
        residuals += state.edges[i] - edge;
        stretched = stretched || glm::length(state.edges[i] - edge) > kLeastResidual * mean;
        displacements[i] = substep * (state.velocities[0] - state.velocities[i]) - residuals;
        if (second_order)
            displacements[i] -= carried(state.accelerations[i], state.true_accelerations[i]) +
                                kForceShare * substep * substep * accelerations[i];
        state.edges[i] = edge;
        position += edge;
        if (const auto pin = state.pins.find(i); pin != state.pins.end()) {
            state.velocities[i] = glm::dvec3(0.0);
            displacements[i] = position - pin->second;
        }
        turns.push_back(substep * state.angular_velocities[i]);
        if (second_order)
            turns.back() +=
                carried(state.angular_accelerations[i], state.true_angular_accelerations[i]);
        predicted_turns.push_back(turns.back());
    }
    loads.assign(accelerations.begin(), accelerations.end());
    turn(turns);
}

void RodSubstep::turn(std::span<const glm::dvec3> turns) {
    glm::dvec3 moved{0.0};
    for (std::size_t i = 1; i < size(); ++i) {
        state.orientations[i] = turned(state.orientations[i], turns[i]);
        const glm::dvec3 edge = rest.lengths[i] * axisOf(state.orientations[i]);
        moved += edge - state.edges[i];
        state.edges[i] = edge;
        displacements[i] += moved;
    }
}

// One Newton step. `Below` is the least energy of everything below a vertex, as a quadratic
// function of the vertex's movement (x) and the turn of the segment that ends there (t):
// x A x / 2 + x B t + t C t / 2 + a x + b t. Going up, each segment's turn is eliminated.
void RodSubstep::iterate() {
    struct Below {
        glm::dmat3 A{0.0}, B{0.0}, C{0.0};
        glm::dvec3 a{0.0}, b{0.0};
    };
    struct Turn {  // of a segment, from the vertex and the segment above
        glm::dmat3 move_response, turn_response;
        glm::dvec3 constant_term;
    };
    std::vector<Turn> answers(size());
    const double per_square = 1.0 / (forceShare() * substep * substep);
    glm::dvec3 force{0.0};  // through the segment on the vertex where it ends
    Below below;
    for (std::size_t i = size() - 1; i > 0; --i) {
        const glm::dmat3 mass = massOf(i) * per_square;
        const double inertia = rest.inertias[i] * per_square;
        const glm::dvec3 axis = axisOf(state.orientations[i]);
        Joint joint = jointAt(state, rest, i, scheme, substep);
        const glm::dvec3 turn_above =
            i == 1 ? predicted_turns[0] : predicted_turns[i - 1] + rotations[i - 1];
        const glm::dvec3 bent = predicted_turns[i] + rotations[i] - turn_above;
        joint.torque -= viscosity() * (joint.stiffness * bent);
        joint.stiffness *= 1.0 + viscosity();

        // Geometric stiffness: tension straightens. Compression would bend; it is left out, because
        // the minimum could become a saddle.
        force += mass * displacements[i];
        const double tension = -glm::dot(force, axis);
        below.A += mass;
        below.a += mass * displacements[i];
        below.C += inertia * kIdentity + std::max(tension, 0.0) * rest.lengths[i] *
                                             (kIdentity - glm::outerProduct(axis, axis));
        below.b += inertia * rotations[i];

        // From the vertex at the segment's end to the vertex at its start: x + lever t.
        const glm::dmat3 lever = -rest.lengths[i] * crossMatrix(axis);
        const glm::dmat3 from_lever = glm::transpose(lever) * below.B;
        below.C +=
            glm::transpose(lever) * below.A * lever + from_lever + glm::transpose(from_lever);
        below.B += below.A * lever;
        below.b += glm::transpose(lever) * below.a;

        const glm::dmat3 compliance = glm::inverse(below.C + joint.stiffness);
        Turn& answer = answers[i];
        answer.move_response = -compliance * glm::transpose(below.B);
        answer.turn_response = compliance * joint.stiffness;
        answer.constant_term = compliance * (joint.torque - below.b);

        Below above;
        above.A = below.A + below.B * answer.move_response;
        above.B = below.B * answer.turn_response;
        above.C = below.C * answer.turn_response;
        above.a = below.a + below.B * answer.constant_term;
        above.b = joint.stiffness * (compliance * below.b) + below.C * (compliance * joint.torque);
        below = above;
    }

    std::vector<glm::dvec3> turns{glm::dvec3(0.0)};
    glm::dvec3 moved{0.0};
    state.smooth = true;
    for (std::size_t i = 1; i < size(); ++i) {
        const Turn& answer = answers[i];
        glm::dvec3 turn = answer.move_response * moved + answer.turn_response * turns.back() +
                          answer.constant_term;
        state.smooth = state.smooth && glm::length(turn) <= kSmoothTurn;
        turn *= kMostTurn / std::max(glm::length(turn), kMostTurn);
        moved += glm::cross(turn, state.edges[i]);
        turns.push_back(turn);
        rotations[i] += turn;
    }
    turn(turns);
}

void RodSubstep::finish() {
    const double per_square = 1.0 / (forceShare() * substep * substep);
    const auto accelerate = [&](glm::dvec3& velocity, glm::dvec3& taken, glm::dvec3& real,
                                const glm::dvec3& now) {
        if (second_order) {
            const glm::dvec3 then = (1.0 - kAlphaForces) * now + kAlphaForces * real;
            velocity += substep * ((1.0 - kGamma) * taken + kGamma * then);
            taken = then;
        } else {
            taken = now;
        }
        real = now;
    };
    state.smooth = state.smooth && !stretched;
    for (std::size_t i = 1; i < size(); ++i) {
        const bool pinned = state.pins.contains(i);
        if (!second_order) {
            if (!pinned) state.velocities[i] += displacements[i] / substep;
            state.angular_velocities[i] += rotations[i] / substep;
        }
        accelerate(
            state.velocities[i], state.accelerations[i], state.true_accelerations[i],
            pinned ? glm::dvec3(0.0) : per_square * displacements[i] + loads[i]);
        if (pinned) state.velocities[i] = state.accelerations[i] = glm::dvec3(0.0);
        accelerate(
            state.angular_velocities[i], state.angular_accelerations[i],
            state.true_angular_accelerations[i], per_square * rotations[i]);
    }
}

}  // namespace

// ---- Joints -------------------------------------------------------------------------------------

Joint bendAndTwist(
    const glm::dquat& first, const glm::dquat& second, double bend_stiffness,
    double twist_stiffness, Clamp clamp, double ellipticity) {
    // The relative rotation: first a twist round the third axis, then a bend by `angle`. Opposite
    // third axes leave w = z = 0; their twist does not matter.
    glm::dquat r = glm::conjugate(first) * second;
    if (r.w < 0.0) r = -r;
    if (r.w * r.w + r.z * r.z < 1e-12) r.w = 1e-6;
    const double cosine = std::sqrt(r.w * r.w + r.z * r.z);  // of half the angle
    const double sine = std::sqrt(r.x * r.x + r.y * r.y);
    const double angle = 2.0 * std::atan2(sine, cosine);
    const double twist = 2.0 * std::atan2(r.z, r.w);

    // Both have the length sine * cosine. `across` is the bend's axis; `beside` is perpendicular to
    // it and to the first frame's third axis.
    const glm::dvec3 across(r.w * r.x - r.z * r.y, r.w * r.y + r.z * r.x, 0.0);
    const glm::dvec3 beside(across.y, -across.x, 0.0);
    const glm::dvec3 axis(0.0, 0.0, 1.0);

    const Bend bend = bendBy(angle, clamp == Clamp::yes ? 2.0 : 1.0);
    const glm::dvec3 bend_axis = sine > 0.0 ? across / (sine * cosine) : glm::dvec3(1.0, 0.0, 0.0);

    // fade = min(1, (cosine / cosine_at_120_degrees)^4), with cosine^2 as the variable.
    const double square = cosine * cosine;
    const double square_there = std::pow(std::cos(kSteepest / 2.0), 2.0);
    const bool fades = square < square_there;
    const double fade = fades ? std::pow(square / square_there, 2.0) : 1.0;
    const double fade_slope = fades ? 2.0 * square / (square_there * square_there) : 0.0;

    const glm::dvec3 twist_gradient = axis + beside / square;
    // K(p) in the halfway frame, which has the first frame's axes after half of the twist, and the
    // energy's change with p. p changes by half of a twist and with the bend's axis.
    const double direction = std::atan2(r.y, r.x);
    const double squeezed = (ellipticity - 1.0 / ellipticity) / 2.0;
    const double directed = bend_stiffness * ((ellipticity + 1.0 / ellipticity) / 2.0 +
                                              squeezed * std::cos(2.0 * direction));
    glm::dvec3 turning(0.0);
    if (sine > 0.0)
        turning = -bend_stiffness * squeezed * std::sin(2.0 * direction) * bend.energy *
                  (axis - beside / (sine * sine));
    // Growth of the bend's component along the longer axis, perpendicular to the first axis of the
    // halfway frame. Its square costs the additional energy relative to the shorter axis.
    const double along_longer = sine > 0.0 ? std::sqrt(2.0 * bend.energy) / sine : 2.0;
    const glm::dvec3 stiff =
        glm::dvec3(std::cos(twist / 2.0), std::sin(twist / 2.0), -0.5 * along_longer * r.y);

    const glm::dvec3 gradient = directed * bend.torque * bend_axis + turning +
                                twist_stiffness * (twist * fade * twist_gradient -
                                                   0.5 * twist * twist * fade_slope * across);
    // The stiffness for small rotations. The torque is exact, and so is the limit of Newton's
    // method.
    const glm::dmat3 stiffness =
        bend_stiffness * ((glm::dmat3(1.0) - glm::outerProduct(axis, axis)) / ellipticity +
                          (ellipticity - 1.0 / ellipticity) * glm::outerProduct(stiff, stiff)) +
        directed * (bend.stiffness - 1.0) * glm::outerProduct(bend_axis, bend_axis) +
        twist_stiffness * glm::outerProduct(axis, axis);

    const glm::dmat3 to_space = glm::mat3_cast(first);
    return {
        .energy = directed * bend.energy + twist_stiffness * fade * twist * twist / 2.0,
        .torque = -(to_space * gradient),
        .stiffness = to_space * stiffness * glm::transpose(to_space)};
}

glm::dquat rotationBetween(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 middle = from + to;
    if (glm::length(middle) < 1e-6) {
        const glm::dvec3 size = glm::abs(from);
        glm::dvec3 least(0.0);
        least[size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2)] = 1.0;
        return {0.0, glm::normalize(glm::cross(from, least))};
    }
    const glm::dvec3 half = glm::normalize(middle);
    return {glm::dot(from, half), glm::cross(from, half)};
}

glm::dquat halfOf(const glm::dquat& rotation) {
    const glm::dquat near = rotation.w < 0.0 ? -rotation : rotation;
    return glm::normalize(near + glm::dquat(1.0, 0.0, 0.0, 0.0));
}

glm::dquat quarterTangentOf(const glm::dquat& rotation, double kept) {
    const glm::dquat near = rotation.w < 0.0 ? -rotation : rotation;
    const glm::dvec3 vector(near.x, near.y, near.z);
    const double sine = glm::length(vector);  // of half the angle
    if (sine == 0.0) return {1.0, 0.0, 0.0, 0.0};
    const double half = 2.0 * std::atan(kept * std::tan(std::atan2(sine, near.w) / 2.0));
    return {std::cos(half), std::sin(half) / sine * vector};
}

// ---- Rods ---------------------------------------------------------------------------------------

std::vector<glm::dvec3> RodState::positions() const {
    std::vector<glm::dvec3> points{root};
    for (std::size_t i = 1; i < edges.size(); ++i) points.push_back(points.back() + edges[i]);
    return points;
}

RodRest makeRodRest(std::span<const glm::dvec3> points, const RodMaterial& material) {
    const std::size_t size = points.size();
    const double area = std::numbers::pi * material.radius * material.radius;
    const double line_density = material.density * area;
    const double second_moment = area * material.radius * material.radius / 4.0;

    // The torsion constant of an ellipse, pi a^3 b^3 / (a^2 + b^2).
    const double longer = material.radius * std::sqrt(material.ellipticity);
    const double shorter = material.radius / std::sqrt(material.ellipticity);
    const double torsion =
        std::numbers::pi * std::pow(longer * shorter, 3.0) / (longer * longer + shorter * shorter);

    RodRest rest{.points = {points.begin(), points.end()}, .ellipticity = material.ellipticity};
    rest.lengths.assign(size, 0.0);
    double total = 0.0;
    for (std::size_t i = 1; i < size; ++i)
        total += rest.lengths[i] = glm::distance(points[i], points[i - 1]);
    const double mean = std::max(total / static_cast<double>(size - 1), 1e-6);

    glm::dvec3 tangent{0.0, 1.0, 0.0};
    if (rest.lengths[1] >= kShortest) tangent = (points[1] - points[0]) / rest.lengths[1];
    rest.orientations.push_back(
        glm::angleAxis(material.section_angle, tangent) *
        rotationBetween({0.0, 0.0, 1.0}, tangent));
    for (std::size_t i = 1; i < size; ++i) {
        glm::dvec3 next = tangent;
        if (rest.lengths[i] >= kShortest) next = (points[i] - points[i - 1]) / rest.lengths[i];
        rest.orientations.push_back(
            glm::normalize(rotationBetween(tangent, next) * rest.orientations.back()));
        tangent = next;
    }
    rest.half_rotations.assign(size, glm::dquat(1.0, 0.0, 0.0, 0.0));
    for (std::size_t i = 1; i < size; ++i) {
        const double joint = 0.5 * (rest.lengths[i] + (i > 1 ? rest.lengths[i - 1] : 0.0));
        rest.half_rotations[i] = halfOf(
            glm::conjugate(rest.orientations[i - 1]) * rest.orientations[i] *
            glm::angleAxis(material.twist * joint, glm::dvec3(0.0, 0.0, 1.0)));
    }

    for (std::size_t i = 0; i < size; ++i) {
        const double below = i + 1 < size ? rest.lengths[i + 1] : 0.0;
        const double turning = std::max(rest.lengths[i], kLeastLength * mean);
        // The first joint is half of one between the segment and its mirror image in the follicle.
        const double joint =
            i == 1 ? rest.lengths[1] / 2.0 : (rest.lengths[i] + rest.lengths[i - (i > 0)]) / 2.0;
        const double short_joint = std::max(joint, kShortest);
        rest.masses.push_back(
            line_density * std::max((rest.lengths[i] + below) / 2.0, kLeastMass * mean));
        rest.inertias.push_back(line_density * turning * turning * turning / 12.0);
        rest.bend_stiffness.push_back(material.youngs_modulus * second_moment / short_joint);
        rest.twist_stiffness.push_back(material.shear_modulus * torsion / short_joint);
    }
    return rest;
}

RodState rodAtRest(const RodRest& rest, const RodRoot& root) {
    RodState state{.root = root.rotation * rest.points[0] + root.translation};
    for (std::size_t i = 0; i < rest.lengths.size(); ++i) {
        state.orientations.push_back(root.rotation * rest.orientations[i]);
        state.edges.push_back(rest.lengths[i] * axisOf(state.orientations[i]));
    }
    state.set.assign(rest.lengths.size(), glm::dquat(1.0, 0.0, 0.0, 0.0));
    state.velocities.assign(rest.lengths.size(), glm::dvec3(0.0));
    state.angular_velocities = state.velocities;
    state.accelerations = state.true_accelerations = state.velocities;
    state.angular_accelerations = state.true_angular_accelerations = state.velocities;
    return state;
}

RodState rodFrom(
    const RodRest& rest, std::span<const glm::dvec3> positions,
    std::span<const glm::dvec3> previous, double substep, const RodRoot& root) {
    RodState state = rodAtRest(rest, root);
    state.root = positions[0];
    const std::vector<glm::dmat3> frames =
        segmentFrames(positions, rest.points, glm::mat3_cast(root.rotation));
    for (std::size_t i = 1; i < positions.size(); ++i) {
        state.edges[i] = positions[i] - positions[i - 1];
        state.velocities[i] = (positions[i] - previous[i]) / substep;
        state.orientations[i] = glm::normalize(glm::quat_cast(frames[i]) * rest.orientations[i]);
        const glm::dvec3 edge_before = previous[i] - previous[i - 1];
        if (glm::length(edge_before) < kShortest || glm::length(state.edges[i]) < kShortest)
            continue;
        const glm::dquat turn =
            rotationBetween(glm::normalize(edge_before), glm::normalize(state.edges[i]));
        state.angular_velocities[i] =
            2.0 / substep * glm::dvec3(turn.x, turn.y, turn.z);  // bounded by the sine
    }
    return state;
}

void stepRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, double substep, double velocity_kept, const RodScheme& scheme,
    const RodAir* air) {
    assert(accelerations.size() == rest.lengths.size());
    RodSubstep step{
        .state = state,
        .rest = rest,
        .scheme = scheme,
        .second_order = scheme.integrator == Integrator::generalized_alpha && state.smooth && !air,
        .substep = substep,
        .displacements = std::vector(rest.lengths.size(), glm::dvec3(0.0)),
        .rotations = std::vector(rest.lengths.size(), glm::dvec3(0.0)),
        .drag = std::vector(rest.lengths.size(), glm::dmat3(0.0)),
        .predicted_turns = {},
        .loads = {}};
    step.predict(accelerations, root, velocity_kept, air);
    for (std::uint32_t i = 0; i < scheme.iterations; ++i) step.iterate();
    step.finish();
}

void stepRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> accelerations,
    const RodRoot& root, double substep, double velocity_kept, std::uint32_t iterations,
    const RodAir* air) {
    stepRod(
        state, rest, accelerations, root, substep, velocity_kept,
        RodScheme{.iterations = iterations}, air);
}

void pushRod(
    RodState& state, const RodRest& rest, std::span<const glm::dvec3> positions, double substep) {
    const std::vector<glm::dvec3> before = state.positions();
    for (std::size_t i = 1; i < before.size(); ++i) {
        state.smooth = state.smooth && positions[i] == before[i];
        state.velocities[i] += (positions[i] - before[i]) / substep;
        const glm::dvec3 edge = positions[i] - positions[i - 1];
        state.edges[i] = edge;
        if (rest.lengths[i] < kShortest || glm::length(edge) < kShortest) continue;
        const glm::dquat turn =
            rotationBetween(axisOf(state.orientations[i]), glm::normalize(edge));
        state.orientations[i] = glm::normalize(turn * state.orientations[i]);
        state.angular_velocities[i] += 2.0 / substep * glm::dvec3(turn.x, turn.y, turn.z);
    }
}

double
rodEnergy(const RodState& state, const RodRest& rest, const RodScheme& scheme, double substep) {
    double energy = 0.0;
    for (std::size_t i = 1; i < rest.lengths.size(); ++i) {
        energy += rest.masses[i] * glm::dot(state.velocities[i], state.velocities[i]) / 2.0 +
                  rest.inertias[i] *
                      glm::dot(state.angular_velocities[i], state.angular_velocities[i]) / 2.0 +
                  jointAt(state, rest, i, scheme, substep).energy;
    }
    return energy;
}

}  // namespace hair::reference
