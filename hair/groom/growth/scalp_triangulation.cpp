#include "hair/groom/growth/scalp_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_set>
#include <utility>

#include <glm/geometric.hpp>

namespace hair::groom {
namespace {

constexpr auto kNone = CornerTable::kNone;

// These are functions, so that no variable of a file that is compiled together with this one
// shadows them.
std::uint32_t after(std::uint32_t corner) { return CornerTable::after(corner); }
std::uint32_t before(std::uint32_t corner) { return CornerTable::before(corner); }

// Angle over 180 degrees up to which two edges at a vertex may be replaced by one that passes it,
// rad.
constexpr double kStraight = 0.02;

// The largest angle of a triangle that is left on the boundary, cos 120 degrees.
constexpr double kFlattest = -0.5;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

// ---- Triangles that know their neighbours -------------------------------------------------------

CornerTable::CornerTable(std::span<const std::array<std::uint32_t, 3>> triangles) {
    struct Side {
        std::uint32_t low, high;  // the edge's vertices
        std::uint32_t corner;  // opposite
        bool upward;  // runs from low to high
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (const auto& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) vertices_.push_back(vertex);
    }
    for (std::uint32_t corner = 0; corner < vertices_.size(); ++corner) {
        const std::uint32_t from = vertices_[after(corner)];
        const std::uint32_t to = vertices_[before(corner)];
        sides.push_back({std::min(from, to), std::max(from, to), corner, from < to});
    }
    std::ranges::sort(
        sides, {}, [](const Side& side) { return std::tuple(side.low, side.high, side.corner); });

    opposites_.resize(vertices_.size(), kNone);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        if (end - i == 2 && sides[i].upward != sides[i + 1].upward) {
            opposites_[sides[i].corner] = sides[i + 1].corner;
            opposites_[sides[i + 1].corner] = sides[i].corner;
        }
        i = end;
    }
}

std::vector<std::array<std::uint32_t, 3>> CornerTable::triangles() const {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t corner = 0; corner < cornerCount(); corner += 3) {
        if (exists(corner / 3))
            triangles.push_back({vertices_[corner], vertices_[corner + 1], vertices_[corner + 2]});
    }
    return triangles;
}

CornerTable::Fan CornerTable::fan(std::uint32_t corner) const {
    Fan fan;
    std::uint32_t first = corner;
    for (std::uint32_t across = opposites_[before(first)]; across != kNone;
         across = opposites_[before(first)]) {  // clockwise
        first = before(across);
        if (first == corner) break;
    }
    fan.closed = first == corner && opposites_[before(first)] != kNone;
    fan.corners.push_back(first);
    for (std::uint32_t across = opposites_[after(first)]; across != kNone && after(across) != first;
         across = opposites_[after(fan.corners.back())])
        fan.corners.push_back(after(across));
    return fan;
}

void CornerTable::setCell(
    std::uint32_t cell, const std::array<std::uint32_t, 3>& vertices,
    const std::array<std::uint32_t, 3>& opposites) {
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t corner = 3 * cell + i;
        vertices_[corner] = vertices[i];
        opposites_[corner] = opposites[i];
        if (opposites[i] != kNone) opposites_[opposites[i]] = corner;
    }
}

std::array<std::uint32_t, 4> CornerTable::flip(std::uint32_t corner) {
    const std::uint32_t other = opposites_[corner];
    const std::uint32_t first = corner / 3;
    const std::uint32_t second = other / 3;
    const std::uint32_t a = vertices_[corner];
    const std::uint32_t b = vertices_[after(corner)];
    const std::uint32_t c = vertices_[before(corner)];
    const std::uint32_t d = vertices_[other];
    const std::uint32_t beyond_ca = opposites_[after(corner)];
    const std::uint32_t beyond_ab = opposites_[before(corner)];
    const std::uint32_t beyond_bd = opposites_[after(other)];
    const std::uint32_t beyond_dc = opposites_[before(other)];
    setCell(first, {a, b, d}, {beyond_bd, 3 * second + 2, beyond_ab});
    setCell(second, {a, d, c}, {beyond_dc, beyond_ca, 3 * first + 1});
    return {3 * first, 3 * first + 2, 3 * second, 3 * second + 1};
}

std::array<std::uint32_t, 3> CornerTable::split(std::uint32_t cell, std::uint32_t vertex) {
    const std::uint32_t corner = 3 * cell;
    const std::uint32_t second = cornerCount() / 3;
    const std::uint32_t third = second + 1;
    const std::uint32_t a = vertices_[corner];
    const std::uint32_t b = vertices_[corner + 1];
    const std::uint32_t c = vertices_[corner + 2];
    const std::array<std::uint32_t, 3> beyond{
        opposites_[corner], opposites_[corner + 1], opposites_[corner + 2]};
    vertices_.resize(vertices_.size() + 6);
    opposites_.resize(opposites_.size() + 6);
    setCell(cell, {a, b, vertex}, {3 * second + 1, 3 * third, beyond[2]});
    setCell(second, {b, c, vertex}, {3 * third + 1, 3 * cell, beyond[0]});
    setCell(third, {c, a, vertex}, {3 * cell + 1, 3 * second, beyond[1]});
    return {cell, second, third};
}

std::uint32_t CornerTable::join(const std::array<std::uint32_t, 3>& corners) {
    std::array<std::uint32_t, 3> vertices{};
    std::array<std::uint32_t, 3> opposites{};
    for (std::size_t i = 0; i < 3; ++i) {  // the edge from vertex i to the next is opposite i + 2
        vertices[i] = vertices_[after(corners[i])];
        opposites[(i + 2) % 3] = opposites_[corners[i]];
    }
    for (const std::uint32_t corner : corners) vertices_[corner / 3 * 3] = kNone;
    setCell(corners[0] / 3, vertices, opposites);
    return corners[0] / 3;
}

void CornerTable::erase(std::uint32_t cell) {
    for (std::uint32_t corner = 3 * cell; corner < 3 * cell + 3; ++corner) {
        if (opposites_[corner] != kNone) opposites_[opposites_[corner]] = kNone;
        opposites_[corner] = kNone;
        vertices_[corner] = kNone;
    }
}

// ---- A scalp cut at roots -----------------------------------------------------------------------

ScalpTriangulation::ScalpTriangulation(
    const Scalp& scalp, std::span<const SurfacePoint> roots,
    std::span<const std::array<std::uint32_t, 3>> cut)
    : root_count_(static_cast<std::uint32_t>(roots.size())), net_(cut) {
    for (const SurfacePoint& root : roots) positions_.emplace_back(root.position);
    for (const glm::vec3& position : scalp.positions) positions_.emplace_back(position);
    corners_.resize(positions_.size(), kNone);
    sources_.resize(positions_.size());
    std::iota(sources_.begin(), sources_.end(), 0u);
    std::vector<std::uint32_t> corners(net_.cornerCount());
    std::iota(corners.begin(), corners.end(), 0u);
    separateFans(corners);
}

// Splits each vertex where several sheets meet, so that each sheet has a vertex of its own.
// `corners` are all corners of their vertices.
void ScalpTriangulation::separateFans(std::span<const std::uint32_t> corners) {
    std::unordered_set<std::uint32_t> seen;
    for (const std::uint32_t corner : corners) {
        if (!net_.exists(corner / 3) || seen.contains(corner)) continue;
        std::uint32_t vertex = net_.vertex(corner);
        if (corners_[vertex] != kNone) {
            positions_.push_back(glm::dvec3(positions_[vertex]));
            sources_.push_back(std::uint32_t{sources_[vertex]});
            vertex = static_cast<std::uint32_t>(corners_.size());
            corners_.push_back(kNone);
        }
        corners_[vertex] = corner;
        for (const std::uint32_t member : net_.fan(corner).corners) {
            seen.insert(member);
            net_.renameVertex(member, vertex);
        }
    }
}

void ScalpTriangulation::anchor(std::uint32_t cell) {
    for (std::uint32_t corner = 3 * cell; corner < 3 * cell + 3; ++corner)
        corners_[net_.vertex(corner)] = corner;
}

// Whether an edge leads from the corner's vertex to the other one.
bool ScalpTriangulation::areJoined(std::uint32_t corner, std::uint32_t vertex) const {
    return std::ranges::any_of(net_.fan(corner).corners, [&](std::uint32_t member) {
        return net_.vertex(after(member)) == vertex || net_.vertex(before(member)) == vertex;
    });
}

// Whether both new triangles face the same way as the old ones.
bool ScalpTriangulation::staysUnfolded(std::uint32_t corner) const {
    const glm::dvec3 a = position(corner);
    const glm::dvec3 b = position(after(corner));
    const glm::dvec3 c = position(before(corner));
    const glm::dvec3 d = position(net_.opposite(corner));
    const glm::dvec3 normal = glm::cross(b - a, c - a) + glm::cross(c - d, b - d);
    return glm::dot(glm::cross(b - a, d - a), normal) > 0.0 &&
           glm::dot(glm::cross(d - a, c - a), normal) > 0.0;
}

bool ScalpTriangulation::shouldFlip(std::uint32_t corner) const {
    const std::uint32_t other = net_.opposite(corner);
    const glm::dvec3 a = position(corner);
    const glm::dvec3 b = position(after(corner));
    const glm::dvec3 c = position(before(corner));
    const glm::dvec3 d = position(other);
    const double sine_a = glm::length(glm::cross(b - a, c - a));
    const double sine_d = glm::length(glm::cross(b - d, c - d));
    const double cosine_a = glm::dot(b - a, c - a);
    const double cosine_d = glm::dot(b - d, c - d);
    // sin(a + d) times the four lengths; rounding must not make an edge flip for ever.
    const double rounding = 1e-9 * std::sqrt(
                                       glm::dot(b - a, b - a) * glm::dot(c - a, c - a) *
                                       glm::dot(b - d, b - d) * glm::dot(c - d, c - d));
    return sine_a * cosine_d + cosine_a * sine_d < -rounding && staysUnfolded(corner) &&
           net_.vertex(corner) != net_.vertex(other) && !areJoined(corner, net_.vertex(other));
}

void ScalpTriangulation::flipSuspects() {
    flipEdges(
        net_, suspects_, std::size_t{20} * net_.cornerCount(),
        [&](std::uint32_t corner) { return net_.exists(corner / 3) && shouldFlip(corner); },
        [&](std::uint32_t corner) {
            anchor(corner / 3);
            anchor(net_.opposite(3 * (corner / 3) + 1) / 3);
        });
}

void ScalpTriangulation::makeDelaunay() {
    for (std::uint32_t corner = 0; corner < net_.cornerCount(); ++corner) {
        if (net_.exists(corner / 3) && corner < net_.opposite(corner)) suspects_.push_back(corner);
    }
    flipSuspects();
}

// Flips one edge of the fan's vertex, so that an edge past the vertex joins its two neighbours
// there. It takes the flip with the shortest new edge, measured in the plane that the fan unrolls
// to, with the vertex at the origin. Returns false if there is none.
bool ScalpTriangulation::flipAway(const CornerTable::Fan& fan) {
    const auto count = fan.corners.size();
    const glm::dvec3 centre = position(fan.corners[0]);
    // [neighbour], one more than there are corners. The last is the first again or, on the
    // boundary, the other neighbour.
    std::vector<double> angles{0.0};
    std::vector<glm::dvec3> neighbours;
    for (const std::uint32_t corner : fan.corners) {
        const glm::dvec3 from = position(after(corner)) - centre;
        const glm::dvec3 to = position(before(corner)) - centre;
        neighbours.push_back(from);
        angles.push_back(angles.back() + angleBetween(from, to));
    }
    neighbours.push_back(position(before(fan.corners[count - 1])) - centre);
    const double scale = fan.closed ? 2.0 * std::numbers::pi / angles.back() : 1.0;

    std::uint32_t best = kNone;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = fan.closed ? 0 : 1; i < count; ++i) {
        const std::size_t last = i == 0 ? count - 1 : i - 1;
        const double turn_in =
            scale * (i == 0 ? angles[count] - angles[count - 1] : angles[i] - angles[last]);
        const double turn_out = scale * (angles[i + 1] - angles[i]);
        const double length = glm::distance(neighbours[last], neighbours[i + 1]);
        if (turn_in + turn_out >= std::numbers::pi + kStraight || length >= shortest) continue;
        // Neighbour i lies beyond the new edge.
        const double r0 = glm::length(neighbours[last]);
        const double r1 = glm::length(neighbours[i]);
        const double r2 = glm::length(neighbours[i + 1]);
        const double ear = r0 * r1 * std::sin(turn_in) + r1 * r2 * std::sin(turn_out) -
                           r0 * r2 * std::sin(turn_in + turn_out);
        const std::uint32_t edge = before(fan.corners[i]);
        const std::uint32_t other = net_.opposite(edge);
        if (!(ear > 0.0) || net_.vertex(edge) == net_.vertex(other) ||
            areJoined(edge, net_.vertex(other)))
            continue;
        best = edge;
        shortest = length;
    }
    if (best == kNone) return false;
    for (const std::uint32_t side : net_.flip(best)) suspects_.push_back(side);
    anchor(best / 3);
    anchor(net_.opposite(3 * (best / 3) + 1) / 3);
    return true;
}

// Drops the triangles round a vertex.
void ScalpTriangulation::erase(const CornerTable::Fan& fan) {
    std::vector<std::uint32_t> left;  // corners that their vertices keep
    for (const std::uint32_t corner : fan.corners) {
        for (const std::uint32_t neighbour : {after(corner), before(corner)}) {
            if (corners_[net_.vertex(neighbour)] == kNone) continue;
            for (const std::uint32_t member : net_.fan(neighbour).corners) left.push_back(member);
            corners_[net_.vertex(neighbour)] = kNone;
        }
    }
    corners_[net_.vertex(fan.corners[0])] = kNone;
    for (const std::uint32_t corner : fan.corners) net_.erase(corner / 3);
    separateFans(left);
}

void ScalpTriangulation::remove(std::uint32_t vertex, Stuck stuck) {
    CornerTable::Fan fan = net_.fan(corners_[vertex]);
    const auto isThree = [&] { return fan.closed && fan.corners.size() == 3; };
    while (!isThree() && flipAway(fan)) fan = net_.fan(corners_[vertex]);
    if (isThree()) {
        corners_[vertex] = kNone;
        const std::uint32_t cell = net_.join({fan.corners[0], fan.corners[1], fan.corners[2]});
        anchor(cell);
        for (const std::uint32_t corner : {3 * cell, 3 * cell + 1, 3 * cell + 2})
            suspects_.push_back(corner);
    } else if (!fan.closed || stuck == Stuck::erase) {
        erase(fan);
    }
    flipSuspects();
}

// Works from the inside to the boundary, where it drops triangles, so that few are dropped.
void ScalpTriangulation::removeScalpVertices() {
    const auto isLeft = [&](std::uint32_t vertex) {
        return sources_[vertex] >= root_count_ && corners_[vertex] != kNone;
    };
    for (std::uint32_t vertex = root_count_; vertex < corners_.size(); ++vertex) {
        if (isLeft(vertex) && net_.fan(corners_[vertex]).closed) remove(vertex, Stuck::keep);
    }
    for (const Stuck stuck : {Stuck::keep, Stuck::erase}) {
        for (std::uint32_t vertex = root_count_; vertex < corners_.size(); ++vertex) {
            if (isLeft(vertex)) remove(vertex, stuck);
        }
    }
}

void ScalpTriangulation::peel() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t corner = 0; corner < net_.cornerCount(); ++corner) open.push_back(corner);
    while (!open.empty()) {
        const std::uint32_t corner = open.back();
        open.pop_back();
        if (!net_.exists(corner / 3) || net_.opposite(corner) != kNone) continue;
        const glm::dvec3 from = glm::normalize(position(after(corner)) - position(corner));
        const glm::dvec3 to = glm::normalize(position(before(corner)) - position(corner));
        if (glm::dot(from, to) > kFlattest || !net_.fan(corner).closed) continue;
        const std::uint32_t behind_to = net_.opposite(after(corner));
        const std::uint32_t behind_from = net_.opposite(before(corner));
        net_.erase(corner / 3);
        open.push_back(behind_to);
        open.push_back(behind_from);
    }
}

// Gives a root in several fans a single number, and lets no edge have a third triangle.
std::vector<std::array<std::uint32_t, 3>> ScalpTriangulation::triangles() const {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& [i, j, k] : net_.triangles()) {
        const std::uint32_t a = sources_[i];
        const std::uint32_t b = sources_[j];
        const std::uint32_t c = sources_[k];
        if (edges.contains({a, b}) || edges.contains({b, c}) || edges.contains({c, a})) continue;
        edges.insert({{a, b}, {b, c}, {c, a}});
        triangles.push_back({a, b, c});
    }
    return triangles;
}

}  // namespace hair::groom
