#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/growth/scalp.h"

// Triangles that are changed by flips of edges.
namespace hair::groom {

// Triangles that know their neighbours, to be changed by flips. Corner c of cell t has the number 3
// t + c. It also stands for the opposite edge, which runs from the next corner's vertex to the one
// after it.
class CornerTable {
public:
    static constexpr std::uint32_t kNone = ~0u;

    static constexpr std::uint32_t after(std::uint32_t corner) {
        return corner % 3 == 2 ? corner - 2 : corner + 1;
    }
    static constexpr std::uint32_t before(std::uint32_t corner) {
        return corner % 3 == 0 ? corner + 2 : corner - 1;
    }

    // Two triangles are neighbours if they, and no third one, run along an edge in opposite
    // directions.
    explicit CornerTable(std::span<const std::array<std::uint32_t, 3>> triangles);

    std::uint32_t cornerCount() const { return static_cast<std::uint32_t>(vertices_.size()); }
    std::uint32_t vertex(std::uint32_t corner) const { return vertices_[corner]; }
    // The corner opposite the same edge on its other side, or kNone.
    std::uint32_t opposite(std::uint32_t corner) const { return opposites_[corner]; }
    // False for a cell that was erased.
    bool exists(std::uint32_t cell) const { return vertices_[3 * cell] != kNone; }
    std::vector<std::array<std::uint32_t, 3>> triangles() const;

    // Corners of the triangles round a corner's vertex, counter-clockwise; from one boundary edge
    // to the other if it is on the boundary.
    struct Fan {
        std::vector<std::uint32_t> corners;
        bool closed = false;
    };
    Fan fan(std::uint32_t corner) const;

    // Replaces the opposite edge, which must have an opposite corner, by the quadrilateral's other
    // diagonal, from the corner's vertex to the opposite one's. Returns the quadrilateral's sides.
    std::array<std::uint32_t, 4> flip(std::uint32_t corner);
    // Cuts a cell into three; edge 2 of each is one of the old sides. Returns the cells.
    std::array<std::uint32_t, 3> split(std::uint32_t cell, std::uint32_t vertex);
    // Joins the three cells round a corner's vertex to one. Returns it.
    std::uint32_t join(const std::array<std::uint32_t, 3>& corners);
    void erase(std::uint32_t cell);
    void renameVertex(std::uint32_t corner, std::uint32_t vertex) { vertices_[corner] = vertex; }

private:
    void setCell(
        std::uint32_t cell, const std::array<std::uint32_t, 3>& vertices,
        const std::array<std::uint32_t, 3>& opposites);

    std::vector<std::uint32_t> vertices_;  // [corner]
    std::vector<std::uint32_t> opposites_;  // [corner]
};

// Flips edges until shouldFlip(corner) holds for no suspect, including those that flips add, or
// until `most` flips are made. Calls flipped(corner) after each. Lawson 1977, Software for C1
// surface interpolation.
template <class Test, class Flipped>
void flipEdges(
    CornerTable& net, std::vector<std::uint32_t>& suspects, std::size_t most, Test&& shouldFlip,
    Flipped&& flipped) {
    while (!suspects.empty()) {
        const std::uint32_t corner = suspects.back();
        suspects.pop_back();
        if (most == 0 || net.opposite(corner) == CornerTable::kNone || !shouldFlip(corner))
            continue;
        --most;
        for (const std::uint32_t side : net.flip(corner)) suspects.push_back(side);
        flipped(corner);
    }
}

// A scalp cut at roots; afterwards, the scalp's own vertices can be removed. Lengths and angles are
// those of the straight triangles in space.
class ScalpTriangulation {
public:
    // `cut`: cutAtRoots() of the scalp and the roots (triangulate.h).
    ScalpTriangulation(
        const Scalp& scalp, std::span<const SurfacePoint> roots,
        std::span<const std::array<std::uint32_t, 3>> cut);

    // Flips edges with opposite angles of more than 180 degrees in sum, unless that folds the
    // surface or gives two vertices a second edge.
    void makeDelaunay();
    // Flips the edges at each vertex away until three triangles are left, which become one. On the
    // boundary, it flips until no flip stays inside, and drops the rest.
    void removeScalpVertices();
    // Drops long, low triangles from the boundary.
    void peel();
    // The triangles between the roots, after removeScalpVertices().
    std::vector<std::array<std::uint32_t, 3>> triangles() const;

private:
    enum class Stuck { keep, erase };  // for a vertex that no flip frees

    void separateFans(std::span<const std::uint32_t> corners);
    void anchor(std::uint32_t cell);
    bool areJoined(std::uint32_t corner, std::uint32_t vertex) const;
    bool shouldFlip(std::uint32_t corner) const;
    bool staysUnfolded(std::uint32_t corner) const;
    void flipSuspects();
    void remove(std::uint32_t vertex, Stuck stuck);
    void erase(const CornerTable::Fan& fan);
    bool flipAway(const CornerTable::Fan& fan);
    glm::dvec3 position(std::uint32_t corner) const { return positions_[net_.vertex(corner)]; }

    std::uint32_t root_count_;
    std::vector<glm::dvec3> positions_;  // [vertex], m, the roots first
    std::vector<std::uint32_t> sources_;  // [vertex], the first one that stands for the same point
    CornerTable net_;
    std::vector<std::uint32_t> corners_;  // [vertex], one of its corners
    std::vector<std::uint32_t> suspects_;
};

}  // namespace hair::groom
