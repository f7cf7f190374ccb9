#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "hair/groom/mesh/mesh.h"

// Meshes with known surfaces, and the topology of triangulations.
namespace hair::groom {

// A quadrilateral mesh of `columns` by `rows`, closed both ways, all of it scalp: `at(u, v)` is the
// position for u and v in [0, 1), `normal(u, v)` the normal.
template <class At, class Normal>
Mesh makeWrapped(std::uint32_t columns, std::uint32_t rows, At&& at, Normal&& normal) {
    Mesh mesh;
    mesh.materials = {{.name = "scalp"}};
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double u = static_cast<double>(column) / columns;
            const double v = static_cast<double>(row) / rows;
            mesh.positions.emplace_back(at(u, v));
            mesh.normals.emplace_back(normal(u, v));
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const auto vertex = [&](std::uint32_t c, std::uint32_t r) {
                return (row + r) % rows * columns + (column + c) % columns;
            };
            mesh.triangles.push_back({vertex(0, 0), vertex(1, 0), vertex(1, 1)});
            mesh.triangles.push_back({vertex(0, 0), vertex(1, 1), vertex(0, 1)});
        }
    }
    mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    return mesh;
}

// Round the y axis, counter-clockwise seen from outside.
inline Mesh makeTorus(double ring, double tube, std::uint32_t columns, std::uint32_t rows) {
    const auto normal = [](double u, double v) {
        const double a = 2.0 * std::numbers::pi * u;
        const double b = 2.0 * std::numbers::pi * v;
        return glm::dvec3(std::cos(b) * std::sin(a), std::sin(b), std::cos(b) * std::cos(a));
    };
    const auto at = [&](double u, double v) {
        const double a = 2.0 * std::numbers::pi * u;
        return ring * glm::dvec3(std::sin(a), 0.0, std::cos(a)) + tube * normal(u, v);
    };
    return makeWrapped(columns, rows, at, normal);
}

// A sphere round the origin with its poles on the y axis.
inline Mesh makeSphere(double radius, std::uint32_t columns, std::uint32_t rows) {
    Mesh mesh;
    mesh.materials = {{.name = "scalp"}};
    const auto add = [&](double polar, double azimuth) {
        const glm::dvec3 normal(
            std::sin(polar) * std::sin(azimuth), std::cos(polar),
            std::sin(polar) * std::cos(azimuth));
        mesh.positions.emplace_back(radius * normal);
        mesh.normals.emplace_back(normal);
    };
    add(0.0, 0.0);
    for (std::uint32_t row = 1; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column)
            add(std::numbers::pi * row / rows, 2.0 * std::numbers::pi * column / columns);
    }
    add(std::numbers::pi, 0.0);
    const auto vertex = [&](std::uint32_t row, std::uint32_t column) {
        if (row == 0) return 0u;
        if (row == rows) return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
        return 1 + (row - 1) * columns + column % columns;
    };
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t c = 0; c < columns; ++c) {
            if (row + 1 < rows)
                mesh.triangles.push_back(
                    {vertex(row, c), vertex(row + 1, c), vertex(row + 1, c + 1)});
            if (row > 0)
                mesh.triangles.push_back(
                    {vertex(row, c), vertex(row + 1, c + 1), vertex(row, c + 1)});
        }
    }
    mesh.triangle_materials.assign(mesh.triangles.size(), 0);
    return mesh;
}

// The topology of the surface that a set of triangles makes.
struct Topology {
    std::size_t vertices = 0;  // that a triangle has
    std::size_t pieces = 0;
    std::size_t loops = 0;  // vertices that a triangle uses
    std::ptrdiff_t euler = 0;
    bool is_manifold = true;  // each edge has one or two triangles, which run along it in opposite
                              // directions, and the triangles at a vertex follow each other
};

inline Topology topologyOf(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    Topology topology;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::map<std::uint32_t, std::set<std::pair<std::uint32_t, std::uint32_t>>> links;  // [vertex]
    for (const auto& [a, b, c] : triangles) {
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            topology.is_manifold &= edges.insert({from, to}).second && from != to;
        links[a].insert({b, c});
        links[b].insert({c, a});
        links[c].insert({a, b});
    }
    topology.vertices = links.size();
    std::map<std::uint32_t, std::uint32_t> parent;
    for (const auto& [vertex, link] : links) parent[vertex] = vertex;
    const auto root = [&](std::uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::map<std::uint32_t, std::uint32_t> open;  // boundary edges
    for (const auto& [from, to] : edges) {
        parent[root(from)] = root(to);
        if (!edges.contains({to, from}) && !open.insert({from, to}).second)
            topology.is_manifold = false;
    }
    for (const auto& [vertex, link] : links) {
        topology.pieces += root(vertex) == vertex ? 1 : 0;
        // A single cycle has as many starts as ends and returns only after all of them. A single
        // path does not return, but its vertex is on the boundary only once.
        std::map<std::uint32_t, std::uint32_t> next(link.begin(), link.end());
        std::set<std::uint32_t> ends;
        for (const auto& [from, to] : next) ends.insert(to);
        std::uint32_t first = next.begin()->first;
        for (const auto& [from, to] : next) {
            if (!ends.contains(from)) first = from;
        }
        std::size_t steps = 0;
        std::uint32_t at = first;
        do {
            at = next.at(at);
            ++steps;
        } while (next.contains(at) && at != first && steps <= next.size());
        topology.is_manifold &= steps == link.size();
    }
    topology.euler = static_cast<std::ptrdiff_t>(links.size() + triangles.size()) -
                     static_cast<std::ptrdiff_t>((edges.size() + open.size()) / 2);
    while (!open.empty()) {
        ++topology.loops;
        std::uint32_t at = open.begin()->first;
        while (open.contains(at)) {
            const std::uint32_t to = open.at(at);
            open.erase(at);
            at = to;
        }
    }
    return topology;
}

}  // namespace hair::groom
