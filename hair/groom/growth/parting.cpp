#include "hair/groom/growth/parting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/error.h"
#include "hair/groom/growth/scalp_triangulation.h"

namespace hair::groom {
namespace {

// ---- The hairline -------------------------------------------------------------------------------

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

// Counts the pieces of triangles that are joined by edges.
std::size_t countPieces(const Scalp& scalp, const Edges& edges) {
    std::vector<std::size_t> parent(scalp.triangles.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    std::size_t pieces = parent.size();
    for (const auto& [edge, triangle] : edges) {
        const auto opposite = edges.find({edge.second, edge.first});
        if (opposite == edges.end() || root(triangle) == root(opposite->second)) continue;
        parent[root(triangle)] = root(opposite->second);
        --pieces;
    }
    return pieces;
}

// A disc is one piece of surface with one boundary loop and Euler characteristic 1.
void checkDisc(const Scalp& scalp, const Edges& edges, std::size_t loops, std::size_t open_edges) {
    if (loops != 1) {
        throw engine::Error(
            "the scalp has " + std::to_string(loops) + " boundary loops, but 1 is needed");
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

// ---- The line of a parting ----------------------------------------------------------------------

constexpr int kSamples = 128;  // pieces of the line; none is longer than this part of it
constexpr int kHalvings = 14;  // of a piece, at most
constexpr int kRounds = 4;  // to the plane and back: the error falls with the square of the angle

// Distance of roots from the line, as a part of their spacing, and the least distance, m.
constexpr double kGapPart = 0.04;
constexpr double kLeastGap = 0.0005;

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

// The straight line between two points, projected to the scalp at fractions from 0 to 1, in the
// plane through the line at right angles to the scalp. Nearest points alone would keep to the
// mesh's edges.
class Projection {
public:
    Projection(const Scalp& scalp, const NearestSurface& surface, const PartingSettings& settings)
        : surface_(surface), net_(scalp.triangles), from_(settings.from), to_(settings.to) {
        glm::dvec3 up(0.0);
        for (int i = 0; i <= kSamples; ++i) {
            const MeshPoint point = at(static_cast<double>(i) / kSamples);
            up += glm::dvec3(surfacePoint(scalp, point.triangle, point.weights).normal);
        }
        across_ = unit(glm::cross(to_ - from_, up));
    }

    MeshPoint at(double fraction) const {
        MeshPoint point = surface_(from_ + fraction * (to_ - from_));
        for (int i = 0; i < kRounds; ++i) {
            const glm::dvec3& p = point.position;
            point = surface_(p - glm::dot(p - from_, across_) * across_);
        }
        return point;
    }

    // Whether the line is over the scalp there, and not beyond its boundary.
    bool isOver(double fraction) const {
        const MeshPoint point = at(fraction);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const bool on_edge = point.weights[static_cast<glm::length_t>(i)] < 1e-9;
            if (on_edge && net_.opposite(3 * point.triangle + i) == CornerTable::kNone)
                return false;
        }
        return true;
    }

    // The fraction at which the line leaves the scalp. One of the two given fractions is on the
    // scalp, the other off it.
    double boundary(double over, double off) const {
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (over + off);
            (isOver(middle) ? over : off) = middle;
        }
        return over;
    }

private:
    const NearestSurface& surface_;
    CornerTable net_;
    glm::dvec3 from_;
    glm::dvec3 to_;
    glm::dvec3 across_{0.0};
};

struct Span {
    int first = 0;
    int last = -1;
    int size() const { return last - first + 1; }
};

Span longestOver(const Projection& projection) {
    Span longest;
    Span run;
    for (int i = 0; i <= kSamples; ++i) {
        if (!projection.isOver(static_cast<double>(i) / kSamples)) {
            run = {};
            continue;
        }
        run = run.size() > 0 ? Span{run.first, i} : Span{i, i};
        if (run.size() > longest.size()) longest = run;
    }
    return longest;
}

// Returns fractions of the line from `first` to `last`, closer together where it runs far below the
// surface.
std::vector<double> evenFractions(const Projection& projection, double first, double last) {
    std::vector<double> fractions{first, last};
    std::vector<glm::dvec3> points{projection.at(first).position, projection.at(last).position};
    for (int round = 0; round < kHalvings; ++round) {
        double length = 0.0;
        for (std::size_t i = 1; i < points.size(); ++i)
            length += glm::distance(points[i - 1], points[i]);
        for (std::size_t i = points.size() - 1; i > 0; --i) {
            if (round > 2 && glm::distance(points[i - 1], points[i]) < length / kSamples) continue;
            const double middle = 0.5 * (fractions[i - 1] + fractions[i]);
            const auto at = static_cast<std::ptrdiff_t>(i);
            fractions.insert(fractions.begin() + at, middle);
            points.insert(points.begin() + at, projection.at(middle).position);
        }
    }
    return fractions;
}

}  // namespace

// ---- The hairline -------------------------------------------------------------------------------

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

// ---- The parting --------------------------------------------------------------------------------

PartingLine::PartingLine(
    const Scalp& scalp, const NearestSurface& surface, const PartingSettings& settings) {
    const Projection projection(scalp, surface, settings);
    const Span over = longestOver(projection);
    if (over.size() == 0) throw engine::Error("the parting's line is not over the scalp");
    double first = static_cast<double>(over.first) / kSamples;
    double last = static_cast<double>(over.last) / kSamples;
    ends_at_boundary_ = {over.first > 0, over.last < kSamples};
    if (ends_at_boundary_[0]) first = projection.boundary(first, first - 1.0 / kSamples);
    if (ends_at_boundary_[1]) last = projection.boundary(last, last + 1.0 / kSamples);

    std::vector<glm::dvec3> normals;
    for (const double fraction : evenFractions(projection, first, last)) {
        const MeshPoint point = projection.at(fraction);
        if (!points_.empty() && point.position == points_.back()) continue;
        arc_.push_back(
            points_.empty() ? 0.0 : arc_.back() + glm::distance(point.position, points_.back()));
        points_.push_back(point.position);
        normals.emplace_back(surfacePoint(scalp, point.triangle, point.weights).normal);
    }
    if (points_.size() < 2) throw engine::Error("the parting's line has no length on the scalp");
    low_ = high_ = points_[0];
    for (std::size_t i = 0; i < points_.size(); ++i) {
        low_ = glm::min(low_, points_[i]);
        high_ = glm::max(high_, points_[i]);
        const glm::dvec3& before = points_[i > 0 ? i - 1 : 0];
        const glm::dvec3& after = points_[std::min(i + 1, points_.size() - 1)];
        left_.push_back(unit(glm::cross(normals[i], after - before)));
    }
}

PartingLine::Place PartingLine::place(const glm::dvec3& point) const {
    Place place;
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t segment = 0;
    double fraction = 0.0;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const glm::dvec3 along = points_[i + 1] - points_[i];
        const glm::dvec3 from = point - points_[i];
        const double t = std::clamp(glm::dot(from, along) / glm::dot(along, along), 0.0, 1.0);
        const glm::dvec3 gap = from - t * along;
        const double square = glm::dot(gap, gap);
        if (square >= nearest) continue;
        nearest = square;
        segment = i;
        fraction = t;
    }
    place.along = arc_[segment] + fraction * (arc_[segment + 1] - arc_[segment]);
    place.distance = std::sqrt(nearest);
    const glm::dvec3 forward = unit(points_[segment + 1] - points_[segment]);
    const glm::dvec3 way = point - position(place.along);
    const double beyond = glm::dot(way, forward);
    place.beyond = std::abs(beyond);
    place.away = way - beyond * forward;
    place.across = glm::dot(way, left(place.along));
    return place;
}

bool PartingLine::isNear(const glm::dvec3& point, double distance) const {
    const glm::dvec3 outside = point - glm::clamp(point, low_, high_);
    return glm::dot(outside, outside) < distance * distance && place(point).distance < distance;
}

glm::dvec3 PartingLine::position(double along) const {
    const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, along);
    const auto i = static_cast<std::size_t>(above - arc_.begin());
    const double t = std::clamp((along - arc_[i - 1]) / (arc_[i] - arc_[i - 1]), 0.0, 1.0);
    return points_[i - 1] + t * (points_[i] - points_[i - 1]);
}

glm::dvec3 PartingLine::left(double along) const {
    const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, along);
    const auto i = static_cast<std::size_t>(above - arc_.begin());
    const double t = std::clamp((along - arc_[i - 1]) / (arc_[i] - arc_[i - 1]), 0.0, 1.0);
    return unit(left_[i - 1] + t * (left_[i] - left_[i - 1]));
}

PartingRows partingRows(
    const PartingLine& line, const Scalp& scalp, const NearestSurface& surface, double spacing) {
    const double steps = std::max(1.0, std::ceil(line.length() / spacing));
    PartingRows rows{
        .spacing = line.length() / steps, .gap = std::max(kLeastGap, kGapPart * spacing)};
    for (double i = 0.0; i <= steps; ++i) {
        const double along = rows.spacing * i;
        auto& pair = rows.pairs.emplace_back();
        for (std::size_t side = 0; side < 2; ++side) {
            const double across = side == 0 ? rows.gap : -rows.gap;
            const MeshPoint point = surface(line.position(along) + across * line.left(along));
            pair[side] = surfacePoint(scalp, point.triangle, point.weights);
        }
    }
    return rows;
}

void eraseCrossing(
    std::vector<std::array<std::uint32_t, 3>>& triangles, const std::vector<glm::dvec3>& positions,
    const PartingLine& line, double margin) {
    std::vector<double> across;
    for (const glm::dvec3& position : positions) across.push_back(line.place(position).across);
    const auto isCrossing = [&](std::uint32_t a, std::uint32_t b) {
        if ((across[a] < 0.0) == (across[b] < 0.0)) return false;
        const glm::dvec3 edge = positions[b] - positions[a];
        const double t = across[a] / (across[a] - across[b]);
        const PartingLine::Place crossing = line.place(positions[a] + t * edge);
        // The surface bulges over the edge; a crossing farther away is on the scalp's other side.
        return crossing.distance < 0.5 * glm::length(edge) && crossing.beyond < margin;
    };
    std::erase_if(triangles, [&](const std::array<std::uint32_t, 3>& triangle) {
        return isCrossing(triangle[0], triangle[1]) || isCrossing(triangle[1], triangle[2]) ||
               isCrossing(triangle[2], triangle[0]);
    });
}

}  // namespace hair::groom
