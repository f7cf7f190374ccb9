#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "hair/groom/mesh/mesh.h"
#include "tests/largest_difference.h"

// Distances and winding numbers of a triangle mesh, in double precision and by brute force over all
// triangles.
namespace hair::reference {

inline std::array<glm::dvec3, 3> corners(const groom::Mesh& mesh, const auto& triangle) {
    return {
        glm::dvec3(mesh.positions[triangle[0]]), glm::dvec3(mesh.positions[triangle[1]]),
        glm::dvec3(mesh.positions[triangle[2]])};
}

// Returns the closest point of the triangle (Ericson 2005, Real-time collision detection, 5.1.5).
inline glm::dvec3 closestPoint(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = b - a, ac = c - a;
    const double d1 = dot(ab, p - a), d2 = dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = dot(ab, p - b), d4 = dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
    const double d5 = dot(ab, p - c), d6 = dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    return a + (ab * vb + ac * vc) / (va + vb + vc);
}

inline double distance(const groom::Mesh& mesh, const glm::dvec3& p) {
    Extremes distances;
    for (const auto& triangle : mesh.triangles)
        distances.add(glm::distance(p, closestPoint(p, corners(mesh, triangle))));
    return distances.least();
}

// Returns the winding number at p: 1 inside a closed surface, 0 outside. Source: Jacobson et al.
// 2013, Robust inside-outside segmentation using generalized winding numbers. Solid angles: van
// Oosterom and Strackee 1983, The solid angle of a plane triangle, eq. 8.
inline double windingNumber(const groom::Mesh& mesh, const glm::dvec3& p) {
    double angles = 0.0;
    for (const auto& triangle : mesh.triangles) {
        auto [a, b, c] = corners(mesh, triangle);
        a -= p, b -= p, c -= p;
        const double la = length(a), lb = length(b), lc = length(c);
        angles += 2 * std::atan2(
                          dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return angles / (4 * std::numbers::pi);
}

}  // namespace hair::reference
