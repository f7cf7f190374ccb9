#include "hair/groom/mesh/triangle_sides.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/error.h"

namespace hair {
namespace {

struct EdgeSide {
    std::uint32_t low, high;  // the vertices of the edge
    Side side;
    bool upward;  // runs from low to high
};

std::vector<EdgeSide> sortedSides(std::span<const Triangle> triangles) {
    std::vector<EdgeSide> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t from = triangles[triangle][corner];
            const std::uint32_t to = triangles[triangle][(corner + 1) % 3];
            sides.push_back(
                {std::min(from, to), std::max(from, to), {triangle, corner}, from < to});
        }
    }
    std::ranges::sort(sides, {}, [](const EdgeSide& s) {
        return std::tuple(s.low, s.high, s.side.triangle, s.side.corner);
    });
    return sides;
}

// Edges that are shared wrongly in one way.
struct Fault {
    const char* what;
    std::size_t edges = 0;
    std::pair<std::uint32_t, std::uint32_t> first{};

    void add(const EdgeSide& side) {
        if (edges++ == 0) first = {side.low, side.high};
    }
};

void throwFaults(std::span<const Fault> faults, std::span<const glm::vec3> positions) {
    std::ostringstream text;
    text << std::setprecision(9);
    const auto write = [&](const glm::vec3& p) {
        text << "(" << p.x << ", " << p.y << ", " << p.z << ")";
    };
    for (const Fault& fault : faults) {
        if (fault.edges == 0) continue;
        text << (text.tellp() > 0 ? "; " : "") << fault.what << ": " << fault.edges
             << ", the first from ";
        write(positions[fault.first.first]);
        text << " to ";
        write(positions[fault.first.second]);
    }
    if (text.tellp() > 0) throw engine::Error("the surface is not closed", text.str());
}

double
sideLength(const Triangle& triangle, std::uint32_t corner, std::span<const glm::vec3> positions) {
    return glm::distance(
        glm::dvec3(positions[triangle[corner]]), glm::dvec3(positions[triangle[(corner + 1) % 3]]));
}

bool isFlat(const Triangle& triangle, std::span<const glm::vec3> positions) {
    const glm::dvec3 a(positions[triangle[0]]);
    return glm::cross(
               glm::dvec3(positions[triangle[1]]) - a, glm::dvec3(positions[triangle[2]]) - a) ==
           glm::dvec3(0.0);
}

bool isLongest(
    const Triangle& triangle, std::uint32_t corner, std::span<const glm::vec3> positions) {
    const double length = sideLength(triangle, corner, positions);
    return length > sideLength(triangle, (corner + 1) % 3, positions) &&
           length > sideLength(triangle, (corner + 2) % 3, positions);
}

// The edge a-b between triangles (a, b, c) and (b, a, d) becomes c-d.
void turnEdge(
    Triangle& one, std::uint32_t corner_one, Triangle& other, std::uint32_t corner_other) {
    const std::uint32_t a = one[corner_one];
    const std::uint32_t b = other[corner_other];
    const std::uint32_t c = one[(corner_one + 2) % 3];
    const std::uint32_t d = other[(corner_other + 2) % 3];
    one = {b, c, d};
    other = {c, a, d};
}

}  // namespace

std::vector<std::array<Side, 2>>
pairSides(std::span<const Triangle> triangles, std::span<const glm::vec3> positions) {
    std::array faults{
        Fault{"edges with one triangle"}, Fault{"edges whose two triangles face opposite ways"},
        Fault{"edges with more than two triangles"}};
    const std::vector<EdgeSide> sides = sortedSides(triangles);
    std::vector<std::array<Side, 2>> pairs;
    pairs.reserve(sides.size() / 2);
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        if (end - i == 1) {
            faults[0].add(sides[i]);
        } else if (end - i > 2) {
            faults[2].add(sides[i]);
        } else if (sides[i].upward == sides[i + 1].upward) {
            faults[1].add(sides[i]);
        } else {
            pairs.push_back({sides[i].side, sides[i + 1].side});
        }
        i = end;
    }
    throwFaults(faults, positions);
    return pairs;
}

// Every round turns at least one edge. If the triangle behind the longest side of a flat one is
// flat too, its own longest side is as long or longer, so following them ends at one that can be
// turned; that leaves fewer flat triangles, or flat ones with a shorter edge. So it ends, but for
// coordinates too different for the differences of their products to be exact.
void removeFlatTriangles(std::vector<Triangle>& triangles, std::span<const glm::vec3> positions) {
    for (std::size_t rounds = triangles.size() + 1; rounds > 0; --rounds) {
        std::erase_if(triangles, [](const Triangle& t) {
            return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        });
        std::vector<bool> flat;
        for (const Triangle& triangle : triangles) flat.push_back(isFlat(triangle, positions));
        if (std::ranges::find(flat, true) == flat.end()) return;

        std::vector<bool> turned(triangles.size());
        bool any = false;
        for (const auto& [one, other] : pairSides(triangles, positions)) {
            Triangle& first = triangles[one.triangle];
            Triangle& second = triangles[other.triangle];
            const bool first_flat = flat[one.triangle];
            const bool second_flat = flat[other.triangle];
            if (turned[one.triangle] || turned[other.triangle] || !(first_flat || second_flat) ||
                (first_flat && !isLongest(first, one.corner, positions)) ||
                (second_flat && !isLongest(second, other.corner, positions)))
                continue;
            turnEdge(first, one.corner, second, other.corner);
            turned[one.triangle] = turned[other.triangle] = any = true;
        }
        if (!any) break;
    }
    throw engine::Error("the surface has triangles without area that can't be removed");
}

}  // namespace hair
