#include "hair/groom/growth/cut_at_roots.h"

#include <glm/common.hpp>

#include "hair/groom/growth/triangulate.h"

namespace hair {
namespace {

// Roots keep this weight of each corner, so that rounding puts none on an edge.
constexpr double kLeastWeight = 1e-6;

// The triangle's corners and its roots, in weights: affine, so the triangles are Delaunay only
// after makeDelaunay().
void cut(
    std::vector<std::array<std::uint32_t, 3>>& triangles,
    const std::array<std::uint32_t, 3>& corners, std::span<const std::uint32_t> members,
    std::span<const SurfacePoint> roots) {
    if (members.empty()) {
        triangles.push_back(corners);
        return;
    }
    std::vector<glm::dvec2> flat{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
    for (const std::uint32_t root : members) {
        const glm::dvec3 weights = glm::max(glm::dvec3(roots[root].weights), kLeastWeight);
        flat.push_back(glm::dvec2(weights.y, weights.z) / (weights.x + weights.y + weights.z));
    }
    for (const auto& triangle : triangulate(flat, 3)) {
        auto& vertices = triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
            vertices[i] = triangle[i] < 3 ? corners[triangle[i]] : members[triangle[i] - 3];
    }
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>>
cutAtRoots(const Scalp& scalp, std::span<const SurfacePoint> roots) {
    std::vector<std::vector<std::uint32_t>> members(scalp.triangles.size());
    for (std::uint32_t i = 0; i < roots.size(); ++i) members[roots[i].triangle].push_back(i);
    const auto first = static_cast<std::uint32_t>(roots.size());
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < scalp.triangles.size(); ++i) {
        const auto [a, b, c] = scalp.triangles[i];
        cut(triangles, {first + a, first + b, first + c}, members[i], roots);
    }
    return triangles;
}

}  // namespace hair
