#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "hair/groom/mesh/mesh.h"

namespace hair::simulation {

// Adds a triangle with its own vertices, so that closing the mesh has vertices to weld.
inline void
addTriangle(groom::Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : {a, b, c}) mesh.positions.emplace_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
}

inline void append(groom::Mesh& mesh, const groom::Mesh& part) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    for (const auto& [a, b, c] : part.triangles)
        mesh.triangles.push_back({first + a, first + b, first + c});
}

inline groom::Mesh insideOut(groom::Mesh mesh) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return mesh;
}

inline groom::Mesh makeBox(const glm::dvec3& lower, const glm::dvec3& upper) {
    groom::Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool positive : {false, true}) {
            // u, v and the outward direction are right-handed.
            const int u = (axis + (positive ? 1 : 2)) % 3;
            const int v = (axis + (positive ? 2 : 1)) % 3;
            const auto corner = [&](bool far_u, bool far_v) {
                glm::dvec3 p = lower;
                if (positive) p[axis] = upper[axis];
                if (far_u) p[u] = upper[u];
                if (far_v) p[v] = upper[v];
                return p;
            };
            addTriangle(mesh, corner(false, false), corner(true, false), corner(true, true));
            addTriangle(mesh, corner(false, false), corner(true, true), corner(false, true));
        }
    }
    return mesh;
}

// Returns an icosahedron with each triangle split in four `levels` times and vertices on the
// sphere.
inline groom::Mesh makeSphere(const glm::dvec3& centre, double radius, int levels) {
    const double golden = std::numbers::phi;
    const std::array<glm::dvec3, 12> corners{
        {{-1, golden, 0},
         {1, golden, 0},
         {-1, -golden, 0},
         {1, -golden, 0},
         {0, -1, golden},
         {0, 1, golden},
         {0, -1, -golden},
         {0, 1, -golden},
         {golden, 0, -1},
         {golden, 0, 1},
         {-golden, 0, -1},
         {-golden, 0, 1}}};
    constexpr std::array<std::array<std::size_t, 3>, 20> kFaces{
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (const auto& [a, b, c] : kFaces) triangles.push_back({corners[a], corners[b], corners[c]});
    for (int level = 0; level < levels; ++level) {
        std::vector<std::array<glm::dvec3, 3>> finer;
        for (const auto& [a, b, c] : triangles) {
            // The sum is commutative, so neighbours get the same point.
            const glm::dvec3 ab = glm::normalize(glm::normalize(a) + glm::normalize(b));
            const glm::dvec3 bc = glm::normalize(glm::normalize(b) + glm::normalize(c));
            const glm::dvec3 ca = glm::normalize(glm::normalize(c) + glm::normalize(a));
            finer.push_back({a, ab, ca});
            finer.push_back({ab, b, bc});
            finer.push_back({ca, bc, c});
            finer.push_back({ab, bc, ca});
        }
        triangles = std::move(finer);
    }
    groom::Mesh mesh;
    const auto on_sphere = [&](const glm::dvec3& p) { return centre + radius * glm::normalize(p); };
    for (const auto& [a, b, c] : triangles)
        addTriangle(mesh, on_sphere(a), on_sphere(b), on_sphere(c));
    return mesh;
}

// Returns a sphere cut off `opening` (rad) from its top, which points up. It has `across` rings of
// `around` vertices. Its rim is a regular polygon.
inline groom::Mesh
makeOpenSphere(const glm::dvec3& centre, double radius, double opening, int around, int across) {
    const auto at = [&](int i, int j) {
        const double turn = 2 * std::numbers::pi * (i % around) / around;
        const double tilt = opening * j / across;
        return centre + radius * glm::dvec3(
                                     std::sin(tilt) * std::sin(turn), std::cos(tilt),
                                     std::sin(tilt) * std::cos(turn));
    };
    groom::Mesh mesh;
    for (int i = 0; i < around; ++i) {
        addTriangle(mesh, at(0, 0), at(i, 1), at(i + 1, 1));
        for (int j = 1; j < across; ++j) {
            addTriangle(mesh, at(i, j), at(i, j + 1), at(i + 1, j + 1));
            addTriangle(mesh, at(i, j), at(i + 1, j + 1), at(i + 1, j));
        }
    }
    return mesh;
}

// Returns a torus round the y axis.
inline groom::Mesh makeTorus(double radius, double tube_radius, int around, int across) {
    const auto at = [&](int i, int j) {
        const double turn = 2 * std::numbers::pi * (i % around) / around;
        const double tilt = 2 * std::numbers::pi * (j % across) / across;
        const double from_axis = radius + tube_radius * std::cos(tilt);
        return glm::dvec3(
            from_axis * std::sin(turn), tube_radius * std::sin(tilt), from_axis * std::cos(turn));
    };
    groom::Mesh mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            addTriangle(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1));
            addTriangle(mesh, at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return mesh;
}

// Returns a prism from z = -half_depth to half_depth. The outline is counter-clockwise and wholly
// visible from the origin.
inline groom::Mesh makePrism(std::span<const glm::dvec2> outline, double half_depth) {
    groom::Mesh mesh;
    const auto at = [&](glm::dvec2 p, double side) { return glm::dvec3(p, side * half_depth); };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i];
        const glm::dvec2 b = outline[(i + 1) % outline.size()];
        addTriangle(mesh, at({}, 1), at(a, 1), at(b, 1));
        addTriangle(mesh, at({}, -1), at(b, -1), at(a, -1));
        addTriangle(mesh, at(a, -1), at(b, -1), at(b, 1));
        addTriangle(mesh, at(a, -1), at(b, 1), at(a, 1));
    }
    return mesh;
}

inline groom::Mesh makeLShape() {
    constexpr std::array<glm::dvec2, 6> kOutline{
        {{-0.5, -0.5}, {1.5, -0.5}, {1.5, 0.5}, {0.5, 0.5}, {0.5, 1.5}, {-0.5, 1.5}}};
    return makePrism(kOutline, 0.4);
}

// Returns a star of seven spikes of about 15 degrees. Its pseudonormals are far from all normals of
// their faces.
inline groom::Mesh makeStar() {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < 14; ++i) {
        const double turn = std::numbers::pi * i / 7;
        outline.push_back((i % 2 == 0 ? 1.0 : 0.2) * glm::dvec2(std::cos(turn), std::sin(turn)));
    }
    return makePrism(outline, 0.1);
}

}  // namespace hair::simulation
