#include "hair/groom/growth/hairline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include <glm/geometric.hpp>

#include "engine/error.h"

namespace hair {
namespace {

std::string describe(const glm::vec3& p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
           ")";
}

using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;  // to the triangle
                                                                                 // on the left

Edges directedEdges(const Scalp& scalp) {
    Edges edges;
    for (std::uint32_t i = 0; i < scalp.triangles.size(); ++i) {
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

// A disc is one piece of surface with one boundary loop and Euler characteristic 1.
void checkDisc(const Scalp& scalp, const Edges& edges, std::size_t loops, std::size_t open_edges) {
    if (loops != 1) {
        throw engine::Error(
            "the scalp has " + std::to_string(loops) + " boundary loops, 1 is needed");
    }
    const std::size_t edge_count = (edges.size() + open_edges) / 2;
    const auto euler =
        static_cast<std::ptrdiff_t>(scalp.positions.size() + scalp.triangles.size()) -
        static_cast<std::ptrdiff_t>(edge_count);
    const std::size_t pieces = countPieces(scalp, edges);
    if (euler == 1 && pieces == 1) return;
    throw engine::Error(
        "the scalp is not a disc: it has " + std::to_string(pieces) +
        " pieces and the Euler characteristic " + std::to_string(euler));
}

struct EdgePoint {
    double t;  // along the edge, 0 to 1
    double distance;
};

EdgePoint nearestOnEdge(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& point) {
    const glm::dvec3 edge = to - from;
    const double t = std::clamp(glm::dot(point - from, edge) / glm::dot(edge, edge), 0.0, 1.0);
    return {t, glm::distance(point, from + t * edge)};
}

}  // namespace

Hairline traceHairline(const Scalp& scalp) {
    const Edges edges = directedEdges(scalp);
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [edge, triangle] : edges) {
        if (edges.contains({edge.second, edge.first})) continue;
        if (next.try_emplace(edge.first, edge.second).second) continue;
        throw engine::Error(
            "the scalp's boundary touches itself at " + describe(scalp.positions[edge.first]));
    }
    const std::size_t open_edges = next.size();
    std::size_t loops = 0;
    Hairline hairline;
    while (!next.empty()) {
        ++loops;
        hairline = {.arc = {0.0}};
        std::uint32_t vertex = next.begin()->first;
        for (auto edge = next.find(vertex); edge != next.end(); edge = next.find(vertex)) {
            const glm::dvec3 from(scalp.positions[vertex]);
            const glm::dvec3 to(scalp.positions[edge->second]);
            hairline.vertices.push_back(vertex);
            hairline.triangles.push_back(edges.at({vertex, edge->second}));
            hairline.arc.push_back(hairline.arc.back() + glm::distance(from, to));
            vertex = edge->second;
            next.erase(edge);
        }
    }
    checkDisc(scalp, edges, loops, open_edges);
    return hairline;
}

SurfacePoint hairlinePoint(const Scalp& scalp, const Hairline& hairline, double length) {
    if (length >= hairline.length()) length = std::fmod(length, hairline.length());
    const auto last = std::prev(hairline.arc.end());
    const auto above = std::upper_bound(hairline.arc.begin(), last, length);
    const auto edge = static_cast<std::size_t>(above - hairline.arc.begin()) - 1;
    const double t = (length - hairline.arc[edge]) / (hairline.arc[edge + 1] - hairline.arc[edge]);
    const auto& triangle = scalp.triangles[hairline.triangles[edge]];
    const auto from = static_cast<glm::length_t>(
        std::ranges::find(triangle, hairline.vertices[edge]) - triangle.begin());
    glm::dvec3 weights(0.0);
    weights[from] = 1.0 - t;
    weights[(from + 1) % 3] = t;
    return surfacePoint(scalp, hairline.triangles[edge], weights);
}

double nearestLength(const Scalp& scalp, const Hairline& hairline, const glm::dvec3& point) {
    double nearest = std::numeric_limits<double>::infinity();
    double length = 0.0;
    for (std::size_t i = 0; i < hairline.vertices.size(); ++i) {
        const std::uint32_t next = hairline.vertices[(i + 1) % hairline.vertices.size()];
        const EdgePoint found = nearestOnEdge(
            glm::dvec3(scalp.positions[hairline.vertices[i]]), glm::dvec3(scalp.positions[next]),
            point);
        if (found.distance >= nearest) continue;
        nearest = found.distance;
        length = hairline.arc[i] + found.t * (hairline.arc[i + 1] - hairline.arc[i]);
    }
    return length;
}

}  // namespace hair
