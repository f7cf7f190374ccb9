#include "hair/groom/growth/scalp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>

#include <glm/geometric.hpp>

#include "engine/error.h"

namespace hair::groom {

// ---- Triangles by name --------------------------------------------------------------------------

namespace {

constexpr float kMember = 0.5f;  // weight from which a vertex belongs to its group
constexpr std::size_t kMostNames = 30;  // most names that an error lists

std::vector<std::string> materialNames(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) names.push_back(material.name);
    return names;
}

std::vector<std::string> groupNames(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const VertexGroup& group : mesh.vertex_groups) names.push_back(group.name);
    return names;
}

std::string list(const char* kind, const std::vector<std::string>& names) {
    std::string text = std::string("; ") + kind + ": ";
    if (names.empty()) return text + "none";
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
        text += (i == 0 ? "'" : ", '") + names[i] + "'";
    if (names.size() > kMostNames)
        text += " and " + std::to_string(names.size() - kMostNames) + " more";
    return text;
}

// Returns the triangles with the index of this name.
std::vector<std::uint32_t> withIndex(
    std::span<const std::uint32_t> indices, const std::vector<std::string>& names,
    const std::string& name) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < indices.size(); ++i) {
        if (names[indices[i]] == name) triangles.push_back(i);
    }
    return triangles;
}

std::vector<std::uint32_t> inGroup(const Mesh& mesh, const std::string& name) {
    std::vector<float> weights(mesh.positions.size(), 0.0f);
    for (const VertexGroup& group : mesh.vertex_groups) {
        if (group.name != name) continue;
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] = std::max(weights[i], group.weights[i]);
    }
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (std::ranges::all_of(
                mesh.triangles[i], [&](std::uint32_t v) { return weights[v] >= kMember; }))
            triangles.push_back(i);
    }
    return triangles;
}

}  // namespace

std::vector<std::uint32_t> scalpTriangles(const Mesh& mesh, const std::string& name) {
    std::vector<std::uint32_t> triangles;
    if (name == "*") {
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) triangles.push_back(i);
        if (triangles.empty()) throw engine::Error("the mesh has no triangles");
        return triangles;
    }
    const std::vector<std::string> materials = materialNames(mesh);
    const std::vector<std::string> groups = groupNames(mesh);
    const auto has = [&](const std::vector<std::string>& names) {
        return std::ranges::find(names, name) != names.end();
    };
    if (has(materials)) triangles = withIndex(mesh.triangle_materials, materials, name);
    if (triangles.empty() && has(mesh.parts))
        triangles = withIndex(mesh.triangle_parts, mesh.parts, name);
    if (triangles.empty() && has(groups)) triangles = inGroup(mesh, name);
    if (!triangles.empty()) return triangles;
    const bool known = has(materials) || has(mesh.parts) || has(groups);
    throw engine::Error(
        (known ? "no triangle belongs to '" : "nothing in the mesh is named '") + name + "'" +
        list("materials", materials) + list("parts", mesh.parts) + list("vertex groups", groups));
}

// ---- The scalp ----------------------------------------------------------------------------------

namespace {

constexpr std::uint32_t kNoVertex = ~0u;

// Fills positions, normals, triangles and texture_coordinates.
void weld(Scalp& scalp, const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
    std::map<std::tuple<float, float, float>, std::uint32_t> welded;
    std::vector<glm::dvec3> sums;
    std::vector<std::uint32_t> scalp_vertex(mesh.positions.size(), kNoVertex);
    for (const std::uint32_t i : triangles) {
        std::array<std::uint32_t, 3> triangle{};
        std::array<glm::vec2, 3> coordinates{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh.triangles[i][corner];
            if (scalp_vertex[vertex] == kNoVertex) {
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

// ---- The map to the plane -----------------------------------------------------------------------

namespace {

constexpr int kCandidates = 256;  // centres tried

struct Facet {
    glm::dvec3 centroid;
    glm::dvec3 area_vector;
    std::array<glm::dvec3, 3> corners;
};

std::vector<Facet> facets(const Scalp& scalp) {
    std::vector<Facet> facets;
    for (const auto& [i, j, k] : scalp.triangles) {
        const glm::dvec3 a(scalp.positions[i]);
        const glm::dvec3 b(scalp.positions[j]);
        const glm::dvec3 c(scalp.positions[k]);
        const glm::dvec3 area_vector = 0.5 * glm::cross(b - a, c - a);
        if (glm::length(area_vector) > 0.0)
            facets.push_back({(a + b + c) / 3.0, area_vector, {a, b, c}});
    }
    return facets;
}

// The smallest cosine between a facet's normal and the direction to one of its corners.
double worstView(const std::vector<Facet>& facets, const glm::dvec3& centre) {
    double worst = 1.0;
    for (const Facet& facet : facets) {
        const double area = glm::length(facet.area_vector);
        for (const glm::dvec3& corner : facet.corners) {
            const glm::dvec3 view = corner - centre;
            const double cosine = glm::dot(facet.area_vector, view) / (area * glm::length(view));
            worst = std::min(worst, std::isfinite(cosine) ? cosine : -1.0);
        }
    }
    return worst;
}

// Whether the direction -axis, which has no image, meets a facet that is seen from its inner side.
bool coversAntipode(const std::vector<Facet>& facets, const Flattening& flattening) {
    return std::ranges::any_of(facets, [&](const Facet& facet) {
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 from = facet.corners[i] - flattening.centre;
            const glm::dvec3 to = facet.corners[(i + 1) % 3] - flattening.centre;
            if (glm::dot(glm::cross(from, to), -flattening.axis) < 0.0) return false;
        }
        return true;
    });
}

glm::dvec3 anyPerpendicular(const glm::dvec3& axis) {
    const glm::dvec3 other =
        std::abs(axis.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::normalize(other - glm::dot(other, axis) * axis);
}

}  // namespace

glm::dvec2 Flattening::operator()(const glm::vec3& position) const {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(position) - centre);
    const glm::dvec2 across(glm::dot(direction, right), glm::dot(direction, up));
    return across / (1.0 + glm::dot(direction, axis));
}

Flattening flatten(const Scalp& scalp) {
    const std::vector<Facet> scalp_facets = facets(scalp);
    glm::dvec3 centroid(0.0);
    glm::dvec3 area_vector(0.0);
    for (const Facet& facet : scalp_facets) {
        centroid += facet.centroid * (glm::length(facet.area_vector) / scalp.area());
        area_vector += facet.area_vector;
    }
    // The vectors of a closed surface cancel, but a scalp must face one side.
    if (glm::length(area_vector) < 1e-3 * scalp.area()) {
        throw engine::Error("the scalp wraps all the way round and can't be flattened");
    }
    Flattening flattening;
    flattening.axis = glm::normalize(area_vector);
    flattening.right = anyPerpendicular(flattening.axis);
    flattening.up = glm::cross(flattening.axis, flattening.right);

    const double size = std::sqrt(scalp.area());  // a hemisphere's radius is 0.4 of it
    double best = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kCandidates; ++i) {
        const double depth = size * i / (kCandidates - 1);
        const glm::dvec3 centre = centroid - depth * flattening.axis;
        const double view = worstView(scalp_facets, centre);
        if (view <= best) continue;
        best = view;
        flattening.centre = centre;
    }
    if (best <= 0.0) {
        throw engine::Error(
            "the scalp folds over itself when flattened: there is no point inside from "
            "which every triangle is seen from behind");
    }
    if (coversAntipode(scalp_facets, flattening)) {
        throw engine::Error("the scalp wraps all the way round and can't be flattened");
    }
    return flattening;
}

// ---- Outlines -----------------------------------------------------------------------------------

namespace {

constexpr double kMargin = 0.001;

bool isNearEdge(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 edge = b - a;
    const glm::dvec2 from_a = point - a;
    const double length2 = glm::dot(edge, edge);
    const double limit2 = kMargin * kMargin * length2;
    const double across = edge.x * from_a.y - edge.y * from_a.x;
    if (across * across > limit2 * length2) return false;  // far from the whole line
    const double t = std::clamp(glm::dot(from_a, edge) / length2, 0.0, 1.0);
    const glm::dvec2 gap = from_a - t * edge;
    return glm::dot(gap, gap) < limit2;
}

}  // namespace

// There are as many rows as edges; an edge is in all rows that it and its margin reach.
Outline::Outline(std::vector<glm::dvec2> polygon) : polygon_(std::move(polygon)) {
    const std::size_t count = polygon_.size();
    struct Range {
        double low, high;
    };
    std::vector<Range> ranges;
    low_ = std::numeric_limits<double>::infinity();
    double high = -low_;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2& a = polygon_[i];
        const glm::dvec2& b = polygon_[(i + 1) % count];
        const double margin = 2.0 * kMargin * glm::distance(a, b);
        ranges.push_back({std::min(a.y, b.y) - margin, std::max(a.y, b.y) + margin});
        low_ = std::min(low_, ranges.back().low);
        high = std::max(high, ranges.back().high);
    }
    per_row_ = high > low_ ? static_cast<double>(count) / (high - low_) : 0.0;
    const auto row = [&](double y) {
        return std::min(static_cast<std::size_t>((y - low_) * per_row_), count - 1);
    };
    std::vector<std::vector<std::uint32_t>> rows(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        for (std::size_t at = row(ranges[i].low); at <= row(ranges[i].high); ++at)
            rows[at].push_back(i);
    }
    for (const auto& edges : rows) {
        starts_.push_back(static_cast<std::uint32_t>(edges_.size()));
        edges_.insert(edges_.end(), edges.begin(), edges.end());
    }
    starts_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

bool Outline::contains(const glm::dvec2& point) const {
    const double at = (point.y - low_) * per_row_;
    const std::size_t rows = polygon_.size();
    if (!(at >= 0.0) || at > static_cast<double>(rows)) return false;
    const std::size_t row = std::min(static_cast<std::size_t>(at), rows - 1);
    bool inside = false;
    for (std::uint32_t i = starts_[row]; i < starts_[row + 1]; ++i) {
        const glm::dvec2& a = polygon_[edges_[i]];
        const glm::dvec2& b = polygon_[edges_[i] + 1 < rows ? edges_[i] + 1 : 0];
        if (isNearEdge(point, a, b)) return false;
        if ((a.y > point.y) == (b.y > point.y)) continue;
        if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

}  // namespace hair::groom
