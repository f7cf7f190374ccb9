#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"

// What displaces the points of strands: places along a strand, frames that do not turn about it,
// and smooth noise.
namespace hair::groom {

// Where the points of a strand are along it.
class AlongStrand {
public:
    explicit AlongStrand(std::span<const glm::vec3> points);

    double arc(std::size_t point) const { return arcs_[point]; }  // from the root
    double length() const { return arcs_.back(); }
    // The part of the length up to a point, 0 to 1; 0 everywhere on a strand without length.
    double fraction(std::size_t point) const {
        return length() > 0.0 ? arcs_[point] / length() : 0.0;
    }

private:
    std::vector<double> arcs_;  // [point]
};

// Smoothstep from 0 at `from`, and before it, to 1 at `to`, and after it, level at both, whatever
// the order of the two.
constexpr double ease(double from, double to, double x) {
    if (x <= from) return 0.0;
    if (x >= to) return 1.0;
    const double t = (x - from) / (to - from);
    return t * t * (3.0 - 2.0 * t);
}

// Value noise of vectors: a random point of the unit ball at every whole number, eased between, so
// always within the ball. `purpose` and the two after it are its purposes of random numbers.
glm::dvec3 smoothNoise(std::uint32_t seed, std::uint32_t purpose, double x);

// The centre of each strand's clump; a centre's own is itself. Centres are taken greedily, in the
// order of a hash, wherever none is nearer than the spacing yet, by their roots.
std::vector<std::uint32_t> clumpCentres(const Groom& groom, double spacing, std::uint32_t seed);

// Unit vectors at a point of a strand: along it, across it, and the cross product of the two.
struct StrandFrame {
    glm::dvec3 tangent;
    glm::dvec3 normal;
    glm::dvec3 binormal;
};

// The direction of the first segment that has a length; (0, 0, 1) on a strand without length.
glm::dvec3 rootDirection(std::span<const glm::vec3> points);

// A unit vector across a unit vector, always the same one.
glm::dvec3 across(const glm::dvec3& direction);

// Frames that don't turn about the strand, one at each point. The first one's normal is in the
// plane of the strand's direction at the root and `root_normal`; where the two are parallel (less
// than 0.001 rad) or `root_normal` is null, towards the point that is furthest from the line of
// that direction; on a straight strand, across().
// Wang, Jüttler, Zheng and Liu 2008, Computation of rotation minimizing frames, table I (double
// reflection).
std::vector<StrandFrame>
strandFrames(std::span<const glm::vec3> points, const glm::vec3* root_normal);

}  // namespace hair::groom
