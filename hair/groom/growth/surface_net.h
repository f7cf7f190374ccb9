#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/growth/scalp.h"
#include "hair/groom/growth/triangle_net.h"

namespace hair {

// A scalp cut at roots, from which the scalp's own vertices are then taken out.
// Lengths and angles are those of the straight triangles in space.
class SurfaceNet {
public:
    SurfaceNet(const Scalp& scalp, std::span<const SurfacePoint> roots);

    // Flips edges whose opposite angles have a sum of more than 180 degrees, where the surface
    // isn't folded by that and no two vertices get a second edge.
    void makeDelaunay();
    // Edges at a vertex are flipped away until its triangles are three, which become one; on the
    // boundary until no flip stays inside, and the rest is dropped.
    void removeScalpVertices();
    // Drops long, low triangles from the boundary.
    void peel();
    // Of roots only, after removeScalpVertices().
    std::vector<std::array<std::uint32_t, 3>> triangles() const;

private:
    enum class Stuck { keep, erase };  // what becomes of a vertex that no flip frees

    void separateFans(std::span<const std::uint32_t> corners);
    void anchor(std::uint32_t cell);
    bool areJoined(std::uint32_t corner, std::uint32_t vertex) const;
    bool shouldFlip(std::uint32_t corner) const;
    bool staysUnfolded(std::uint32_t corner) const;
    void flipSuspects();
    void remove(std::uint32_t vertex, Stuck stuck);
    void erase(const TriangleNet::Fan& fan);
    bool flipAway(const TriangleNet::Fan& fan);
    glm::dvec3 position(std::uint32_t corner) const { return positions_[net_.vertex(corner)]; }

    std::uint32_t root_count_;
    std::vector<glm::dvec3> positions_;  // [vertex], m, the roots first
    std::vector<std::uint32_t> sources_;  // [vertex], the first one that stands for the same point
    TriangleNet net_;
    std::vector<std::uint32_t> corners_;  // [vertex], one of its corners
    std::vector<std::uint32_t> suspects_;
};

}  // namespace hair
