#include "hair/groom/growth/scalp.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/growth/scalp_triangles.h"

namespace hair {
namespace {

constexpr std::uint32_t kNone = ~0u;

// Fills positions, normals, triangles and texture_coordinates.
void weld(Scalp& scalp, const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
    std::map<std::tuple<float, float, float>, std::uint32_t> welded;
    std::vector<glm::dvec3> sums;
    std::vector<std::uint32_t> scalp_vertex(mesh.positions.size(), kNone);
    for (const std::uint32_t i : triangles) {
        std::array<std::uint32_t, 3> triangle{};
        std::array<glm::vec2, 3> coordinates{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh.triangles[i][corner];
            if (scalp_vertex[vertex] == kNone) {
                const glm::vec3& p = mesh.positions[vertex];
                const auto next = static_cast<std::uint32_t>(scalp.positions.size());
                const auto [entry, is_new] = welded.try_emplace({p.x, p.y, p.z}, next);
                if (is_new) scalp.positions.push_back(p);
                if (is_new) sums.emplace_back(0.0);
                sums[entry->second] += glm::dvec3(mesh.normals[vertex]);
                scalp_vertex[vertex] = entry->second;
            }
            triangle[corner] = scalp_vertex[vertex];
            if (!mesh.texture_coordinates.empty())
                coordinates[corner] = mesh.texture_coordinates[vertex];
        }
        const auto [a, b, c] = triangle;
        if (a == b || b == c || c == a) continue;
        scalp.triangles.push_back(triangle);
        if (!mesh.texture_coordinates.empty()) scalp.texture_coordinates.push_back(coordinates);
    }
    for (const glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        scalp.normals.emplace_back(length > 0.0 ? sum / length : glm::dvec3(0.0, 1.0, 0.0));
    }
}

void measureAreas(Scalp& scalp) {
    double sum = 0.0;
    for (const auto& [i, j, k] : scalp.triangles) {
        const glm::dvec3 a(scalp.positions[i]);
        const glm::dvec3 b(scalp.positions[j]);
        const glm::dvec3 c(scalp.positions[k]);
        sum += glm::length(0.5 * glm::cross(b - a, c - a));
        scalp.cumulative_areas.push_back(sum);
    }
    if (!(sum > 0.0)) throw engine::Error("the scalp has no area");
}

}  // namespace

Scalp extractScalp(const Mesh& mesh, const std::string& name) {
    Scalp scalp;
    weld(scalp, mesh, scalpTriangles(mesh, name));
    measureAreas(scalp);
    return scalp;
}

SurfacePoint surfacePoint(const Scalp& scalp, std::uint32_t triangle, const glm::dvec3& weights) {
    glm::dvec3 position(0.0);
    glm::dvec3 normal(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t vertex = scalp.triangles[triangle][static_cast<std::size_t>(i)];
        position += weights[i] * glm::dvec3(scalp.positions[vertex]);
        normal += weights[i] * glm::dvec3(scalp.normals[vertex]);
    }
    const double length = glm::length(normal);
    const glm::vec3& first = scalp.normals[scalp.triangles[triangle][0]];
    return {
        glm::vec3(position), length > 1e-6 ? glm::vec3(normal / length) : first, triangle,
        glm::vec3(weights)};
}

SurfacePoint sampleSurface(const Scalp& scalp, const std::array<float, 3>& random) {
    const auto& sums = scalp.cumulative_areas;
    const auto found = std::ranges::upper_bound(sums, double{random[0]} * scalp.area());
    const auto index = std::min<std::ptrdiff_t>(found - sums.begin(), std::ssize(sums) - 1);
    double u = random[1];
    double v = random[2];
    if (u + v > 1.0) {  // the other half of the parallelogram
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return surfacePoint(scalp, static_cast<std::uint32_t>(index), {1.0 - u - v, u, v});
}

glm::dvec2 textureCoordinate(const Scalp& scalp, const SurfacePoint& point) {
    glm::dvec2 coordinate(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto corner = static_cast<std::size_t>(i);
        coordinate += double{point.weights[i]} *
                      glm::dvec2(scalp.texture_coordinates[point.triangle][corner]);
    }
    return coordinate;
}

}  // namespace hair
