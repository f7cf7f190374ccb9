#include "hair/simulation/reference_constraints.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace hair::reference {

namespace {

constexpr double kShortest = 1e-9;  // m

// An axis to turn half round from the unit vector `v`, or to leave a capsule's axis by.
glm::dvec3 sideways(const glm::dvec3& v) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(v[i]) < std::abs(v[least])) least = i;
    glm::dvec3 axis{0.0};
    axis[least] = 1.0;
    const glm::dvec3 normal = glm::cross(v, axis);
    if (glm::length(normal) == 0.0) return {0.0, 1.0, 0.0};
    return glm::normalize(normal);
}

// Rodrigues' formula.
glm::dmat3 turn(const glm::dvec3& axis, double sine, double cosine) {
    const glm::dmat3 k{{0.0, axis.z, -axis.y}, {-axis.z, 0.0, axis.x}, {axis.y, -axis.x, 0.0}};
    return glm::dmat3(1.0) + sine * k + (1.0 - cosine) * (k * k);
}

glm::dmat3 smallestRotation(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 normal = glm::cross(from, to);
    const double sine = glm::length(normal);
    const double cosine = glm::dot(from, to);
    if (cosine < 0.0 && sine < 1e-6) return turn(sideways(from), 0.0, -1.0);
    if (sine == 0.0) return glm::dmat3(1.0);
    return turn(normal / sine, sine, cosine);
}

double weight(std::size_t vertex) { return vertex == 0 ? 0.0 : 1.0; }

// Calls `correct(i)` for every segment of a strand in red-black order.
template <class Correct>
void redBlack(std::size_t vertices, Correct correct) {
    for (std::size_t first : {std::size_t{1}, std::size_t{2}})
        for (std::size_t i = first; i < vertices; i += 2) correct(i);
}

}  // namespace

void integrate(
    Points positions, Points previous, ConstPoints accelerations, double velocity_kept,
    double substep) {
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const glm::dvec3 now = positions[i];
        positions[i] =
            now + velocity_kept * (now - previous[i]) + accelerations[i] * (substep * substep);
        previous[i] = now;
    }
}

void pullToRest(Points positions, ConstPoints rest, double stiffness) {
    for (std::size_t i = 1; i < positions.size(); ++i)
        positions[i] += stiffness * (rest[i] - positions[i]);
}

std::vector<glm::dmat3>
segmentFrames(ConstPoints positions, ConstPoints rest, const glm::dmat3& root_frame) {
    std::vector<glm::dmat3> frames{root_frame};
    glm::dvec3 rest_tangent{0.0, 1.0, 0.0};  // of the segment before
    glm::dvec3 tangent{0.0};
    for (std::size_t i = 1; i < positions.size(); ++i) {
        const glm::dvec3 rest_edge = rest[i] - rest[i - 1];
        const glm::dvec3 edge = positions[i] - positions[i - 1];
        const bool has_rest_direction = glm::length(rest_edge) >= kShortest;
        const glm::dvec3 next_rest = has_rest_direction ? glm::normalize(rest_edge) : rest_tangent;
        if (i == 1) {
            rest_tangent = next_rest;
            tangent = root_frame * next_rest;
        }
        const bool has_direction = has_rest_direction && glm::length(edge) >= kShortest;
        const glm::dvec3 next = has_direction ? glm::normalize(edge) : tangent;

        const glm::dmat3 bend = smallestRotation(tangent, next);
        const glm::dmat3 rest_bend = smallestRotation(rest_tangent, next_rest);
        frames.push_back(bend * frames.back() * glm::transpose(rest_bend));
        tangent = next;
        rest_tangent = next_rest;
    }
    return frames;
}

void pullToShape(
    Points positions, ConstPoints rest, double stiffness, const glm::dmat3& root_frame) {
    const auto frames = segmentFrames(positions, rest, root_frame);
    redBlack(positions.size(), [&](std::size_t i) {
        const glm::dvec3 goal = positions[i - 1] + frames[i - 1] * (rest[i] - rest[i - 1]);
        const glm::dvec3 d = goal - positions[i];
        const double sum = weight(i - 1) + weight(i);
        positions[i - 1] -= weight(i - 1) / sum * stiffness * d;
        positions[i] += weight(i) / sum * stiffness * d;
    });
}

void projectLengths(Points positions, ConstPoints rest) {
    redBlack(positions.size(), [&](std::size_t i) {
        const double rest_length = glm::length(rest[i] - rest[i - 1]);
        const glm::dvec3 edge = positions[i] - positions[i - 1];
        const double length = glm::length(edge);
        const glm::dvec3 n = length < kShortest ? glm::dvec3{0.0, 1.0, 0.0} : edge / length;
        const double stretch = length - rest_length;
        const double sum = weight(i - 1) + weight(i);
        positions[i - 1] += weight(i - 1) / sum * stretch * n;
        positions[i] -= weight(i) / sum * stretch * n;
    });
}

void pushOut(
    Points positions, ConstPoints before, std::span<const Collider> colliders,
    const CollisionSettings& settings) {
    for (std::size_t i = 1; i < positions.size(); ++i) {
        for (const Collider& capsule : colliders) {
            const glm::dvec3 a = capsule.a;
            const glm::dvec3 axis = glm::dvec3(capsule.b) - a;
            double along = 0.0;
            if (glm::dot(axis, axis) > 0.0)
                along =
                    std::clamp(glm::dot(positions[i] - a, axis) / glm::dot(axis, axis), 0.0, 1.0);
            const glm::dvec3 nearest = a + along * axis;
            const double distance = glm::distance(positions[i], nearest);
            const double radius = double{capsule.radius} + double{settings.margin};
            if (distance >= radius) continue;
            const glm::dvec3 normal =
                distance < kShortest ? sideways(axis) : (positions[i] - nearest) / distance;
            positions[i] = nearest + radius * normal;
            const glm::dvec3 moved = positions[i] - before[i];
            const glm::dvec3 slid = moved - glm::dot(moved, normal) * normal;
            const double held = double{settings.friction} * (radius - distance);
            if (const double length = glm::length(slid); length > 0.0)
                positions[i] -= std::min(1.0, held / length) * slid;
        }
    }
}

}  // namespace hair::reference
