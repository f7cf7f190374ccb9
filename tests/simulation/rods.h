#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/reference/rod.h"

// Rods for tests. The default material is hair.
namespace hair::simulation {

constexpr double kEarth = 9.81;  // m/s^2
constexpr double kPi = 3.14159265358979323846;

inline double lineDensity(const reference::RodMaterial& material) {
    return material.density * kPi * material.radius * material.radius;
}

// Returns E I, N m^2.
inline double bendingStiffness(const reference::RodMaterial& material) {
    return material.youngs_modulus * kPi / 4.0 * std::pow(material.radius, 4.0);
}

// Returns G J, N m^2.
inline double twistingStiffness(const reference::RodMaterial& material) {
    return material.shear_modulus * kPi / 2.0 * std::pow(material.radius, 4.0);
}

// Returns the length L at which lambda g L^3 / (E I) = gamma.
inline double lengthFor(double gamma, const reference::RodMaterial& material) {
    return std::cbrt(gamma * bendingStiffness(material) / (lineDensity(material) * kEarth));
}

inline std::vector<glm::dvec3>
straightRod(int segments, double length, const glm::dvec3& direction = {1.0, 0.0, 0.0}) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= segments; ++i) points.push_back(length * i / segments * direction);
    return points;
}

// Returns an arc of constant curvature. It starts along x and bends down. From the root to the tip
// the segments turn by `turn` rad.
inline std::vector<glm::dvec3> arc(int segments, double length, double turn) {
    std::vector<glm::dvec3> points{glm::dvec3(0.0)};
    for (int i = 0; i < segments; ++i) {
        const double angle = turn * (i + 0.5) / segments;
        points.push_back(
            points.back() + length / segments * glm::dvec3(std::cos(angle), -std::sin(angle), 0.0));
    }
    return points;
}

inline std::vector<glm::dvec3> helix(int segments, double radius, double pitch, double turns) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= segments; ++i) {
        const double angle = 2.0 * kPi * turns * i / segments;
        points.emplace_back(
            radius * std::cos(angle), -pitch * turns * i / segments, radius * std::sin(angle));
    }
    return points;
}

// Returns a V of this length between two points `span` apart on x.
inline std::vector<glm::dvec3> vee(int segments, double length, double span) {
    const double drop = std::sqrt(length * length - span * span) / 2.0;
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= segments; ++i) {
        const double t = 2.0 * i / segments;
        points.emplace_back(t * span / 2.0, -drop * std::min(t, 2.0 - t), 0.0);
    }
    return points;
}

// Returns the sag of the catenary of this length between the same points: 2 a sinh(span / 2 a) =
// length.
inline double catenarySag(double length, double span) {
    double low = 1e-3, high = 10.0;
    for (int i = 0; i < 100; ++i) {
        const double a = (low + high) / 2.0;
        (2.0 * a * std::sinh(span / 2.0 / a) > length ? low : high) = a;
    }
    return low * (std::cosh(span / 2.0 / low) - 1.0);
}

inline double dropOverReach(std::span<const glm::dvec3> points) {
    const glm::dvec3 tip = points.back() - points.front();
    return -tip.y / std::hypot(tip.x, tip.z);
}

}  // namespace hair::simulation
