#include "hair/groom/scalp.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include <glm/geometric.hpp>

#include "engine/error.h"

namespace hair {
namespace {

constexpr const char* kMaterialName = "scalp";
constexpr std::uint32_t kNone = ~0u;

std::string materialNames(const Mesh& mesh) {
    std::string names;
    for (const Material& material : mesh.materials) {
        names += (names.empty() ? "'" : ", '") + material.name + "'";
    }
    return names.empty() ? "none" : names;
}

std::vector<std::size_t> scalpTriangles(const Mesh& mesh) {
    std::vector<std::size_t> triangles;
    bool named = false;
    for (const Material& material : mesh.materials) named = named || material.name == kMaterialName;
    if (!named) {
        throw engine::Error(
            std::string("the mesh has no material named '") + kMaterialName +
            "'; it has: " + materialNames(mesh));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (mesh.materials[mesh.triangle_materials[i]].name == kMaterialName)
            triangles.push_back(i);
    }
    if (triangles.empty()) throw engine::Error("no triangle has the material 'scalp'");
    return triangles;
}

glm::dvec3 areaVector(const Scalp& scalp, const std::array<std::uint32_t, 3>& triangle) {
    const glm::dvec3 a(scalp.positions[triangle[0]]);
    const glm::dvec3 b(scalp.positions[triangle[1]]);
    const glm::dvec3 c(scalp.positions[triangle[2]]);
    return 0.5 * glm::cross(b - a, c - a);
}

// Fills positions, normals and triangles.
void weld(Scalp& scalp, const Mesh& mesh) {
    std::map<std::tuple<float, float, float>, std::uint32_t> welded;
    std::vector<glm::dvec3> sums;
    std::vector<std::uint32_t> scalp_vertex(mesh.positions.size(), kNone);
    for (const std::size_t i : scalpTriangles(mesh)) {
        std::array<std::uint32_t, 3> triangle{};
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
        }
        const auto [a, b, c] = triangle;
        if (a != b && b != c && c != a) scalp.triangles.push_back(triangle);
    }
    for (const glm::dvec3& sum : sums) {
        const double length = glm::length(sum);
        scalp.normals.emplace_back(length > 0.0 ? sum / length : glm::dvec3(0.0, 1.0, 0.0));
    }
}

void measureAreas(Scalp& scalp) {
    double sum = 0.0;
    for (const auto& triangle : scalp.triangles) {
        sum += glm::length(areaVector(scalp, triangle));
        scalp.cumulative_areas.push_back(sum);
    }
    if (!(sum > 0.0)) throw engine::Error("the scalp has no area");
}

std::string describe(const glm::vec3& p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
           ")";
}

using Edges =
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;  // to the triangle on the left

Edges directedEdges(const Scalp& scalp) {
    Edges edges;
    for (std::size_t i = 0; i < scalp.triangles.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = scalp.triangles[i][corner];
            const std::uint32_t to = scalp.triangles[i][(corner + 1) % 3];
            if (edges.try_emplace({from, to}, i).second) continue;
            throw engine::Error(
                "the scalp is not a surface: more than two triangles, or two with "
                "opposite windings, meet at the edge from " +
                describe(scalp.positions[from]) + " to " + describe(scalp.positions[to]));
        }
    }
    return edges;
}

// Pieces of triangles joined by edges.
std::size_t countPieces(const Scalp& scalp, const Edges& edges) {
    std::vector<std::size_t> parent(scalp.triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::size_t pieces = parent.size();
    for (const auto& [edge, triangle] : edges) {
        const auto twin = edges.find({edge.second, edge.first});
        if (twin == edges.end() || root(triangle) == root(twin->second)) continue;
        parent[root(triangle)] = root(twin->second);
        --pieces;
    }
    return pieces;
}

// Fills boundary. A disc is one piece of surface with one boundary loop and Euler characteristic 1.
void traceBoundary(Scalp& scalp) {
    const Edges edges = directedEdges(scalp);
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [edge, triangle] : edges) {
        if (edges.contains({edge.second, edge.first})) continue;
        if (next.try_emplace(edge.first, edge.second).second) continue;
        throw engine::Error(
            "the scalp's boundary touches itself at " + describe(scalp.positions[edge.first]));
    }
    const std::size_t boundary_edges = next.size();
    std::size_t loops = 0;
    while (!next.empty()) {
        ++loops;
        scalp.boundary.clear();
        std::uint32_t vertex = next.begin()->first;
        for (auto edge = next.find(vertex); edge != next.end(); edge = next.find(vertex)) {
            scalp.boundary.push_back(vertex);
            vertex = edge->second;
            next.erase(edge);
        }
    }
    if (loops != 1) {
        throw engine::Error(
            "the scalp has " + std::to_string(loops) + " boundary loops, 1 is needed");
    }
    const std::size_t edge_count = (edges.size() + boundary_edges) / 2;
    const auto euler =
        static_cast<std::ptrdiff_t>(scalp.positions.size() + scalp.triangles.size()) -
        static_cast<std::ptrdiff_t>(edge_count);
    const std::size_t pieces = countPieces(scalp, edges);
    if (euler == 1 && pieces == 1) return;
    throw engine::Error(
        "the scalp is not a disc: it has " + std::to_string(pieces) +
        " pieces and the Euler characteristic " + std::to_string(euler));
}

SurfacePoint
blend(const Scalp& scalp, const std::array<std::uint32_t, 3>& vertices, const glm::dvec3& weights) {
    glm::dvec3 position(0.0);
    glm::dvec3 normal(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t vertex = vertices[static_cast<std::size_t>(i)];
        position += weights[i] * glm::dvec3(scalp.positions[vertex]);
        normal += weights[i] * glm::dvec3(scalp.normals[vertex]);
    }
    const double length = glm::length(normal);
    return {
        glm::vec3(position),
        length > 1e-6 ? glm::vec3(normal / length) : scalp.normals[vertices[0]]};
}

}  // namespace

Scalp extractScalp(const Mesh& mesh) {
    Scalp scalp;
    weld(scalp, mesh);
    measureAreas(scalp);
    traceBoundary(scalp);
    return scalp;
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
    return blend(scalp, scalp.triangles[static_cast<std::size_t>(index)], {1.0 - u - v, u, v});
}

std::vector<SurfacePoint> sampleBoundary(const Scalp& scalp, std::uint32_t count) {
    assert(count > 0);
    const std::size_t edges = scalp.boundary.size();
    std::vector<double> arc{0.0};  // [edge], length up to its start
    for (std::size_t i = 0; i < edges; ++i) {
        const glm::dvec3 from(scalp.positions[scalp.boundary[i]]);
        const glm::dvec3 to(scalp.positions[scalp.boundary[(i + 1) % edges]]);
        arc.push_back(arc.back() + glm::distance(from, to));
    }
    std::vector<SurfacePoint> points;
    std::size_t edge = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double length = arc.back() * i / count;
        while (edge + 1 < edges && arc[edge + 1] <= length) ++edge;
        const double t = (length - arc[edge]) / (arc[edge + 1] - arc[edge]);
        const std::uint32_t from = scalp.boundary[edge];
        const std::uint32_t to = scalp.boundary[(edge + 1) % edges];
        points.push_back(blend(scalp, {from, to, to}, {1.0 - t, t, 0.0}));
    }
    return points;
}

}  // namespace hair
