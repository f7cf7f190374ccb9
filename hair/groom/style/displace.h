#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom_settings.h"

// Tools to displace the points of strands: places along a strand, rotation-minimising frames, and
// smooth noise.
namespace hair::groom {

// The places of a strand's points along it.
class AlongStrand {
public:
    explicit AlongStrand(std::span<const glm::vec3> points);

    double arc(std::size_t point) const { return arcs_[point]; }  // from the root
    double length() const { return arcs_.back(); }
    // The fraction of the length up to a point, 0 to 1; 0 everywhere on a strand without length.
    double fraction(std::size_t point) const {
        return length() > 0.0 ? arcs_[point] / length() : 0.0;
    }

private:
    std::vector<double> arcs_;  // [point]
};

// Smoothstep: 0 up to `from`, 1 from `to` on, with slope 0 at both. If `from` is not below `to`,
// it is a step at `from`.
constexpr double ease(double from, double to, double x) {
    if (x <= from) return 0.0;
    if (x >= to) return 1.0;
    const double t = (x - from) / (to - from);
    return t * t * (3.0 - 2.0 * t);
}

// Value noise of vectors: a random point of the unit ball at every whole number, eased between, so
// the noise stays within the ball. `purpose` and the two numbers after it are its purposes of
// random numbers.
glm::dvec3 smoothNoise(std::uint32_t seed, std::uint32_t purpose, double x);

// Returns the centre strand of each strand's clump; a centre is its own. Centres are chosen
// greedily, in the order of a hash: a strand becomes one if no centre's root is nearer than the
// spacing.
std::vector<std::uint32_t> clumpCentres(const Groom& groom, double spacing, std::uint32_t seed);

// Unit vectors at a point of a strand: along it, across it, and the cross product of the two.
struct StrandFrame {
    glm::dvec3 tangent;
    glm::dvec3 normal;
    glm::dvec3 binormal;
};

// Returns the direction of the first segment with a length; (0, 0, 1) on a strand without length.
glm::dvec3 rootDirection(std::span<const glm::vec3> points);

// Returns a unit vector across a unit vector, always the same one.
glm::dvec3 across(const glm::dvec3& direction);

// Returns rotation-minimising frames of the strand, one at each point. The first normal is in the
// plane of the strand's direction at the root and `root_normal`. If the two are parallel (less than
// 0.001 rad) or `root_normal` is null, it is towards the point that is farthest from the line of
// that direction; on a straight strand, it is across(). Wang, Jüttler, Zheng and Liu 2008,
// Computation of rotation minimizing frames, table I (double reflection).
std::vector<StrandFrame>
strandFrames(std::span<const glm::vec3> points, const glm::vec3* root_normal);

// Adds a sine across the strand, in the plane of its tangent at the root and the root's normal. If
// those are parallel or there is no normal, it is in the strand's own plane. Its phase is that of
// the strand's clump of `spacing`, and drifts along the strand by up to `drift` waves. The helix of
// curl() has the same kind of phase.
Groom wave(Groom groom, const WaveSettings& settings, std::uint32_t seed);

// Winds the strand to a right-handed helix in its rotation-minimising frame (Wang et al. 2008,
// Computation of rotation minimizing frames). At phase 0 it starts in the direction in which
// wave() swings first. The frequency counts turns along the strand before the change.
Groom curl(Groom groom, const CurlSettings& settings, std::uint32_t seed);

// Adds a smooth random displacement, at most `amplitude` in length.
Groom frizz(Groom groom, const FrizzSettings& settings, std::uint32_t seed);

// Gives a share of the strands, each chosen at random, a smooth random displacement that grows by
// smoothstep(start, 1, position along the strand) to at most `reach`.
Groom flyaways(Groom groom, const FlyawaySettings& settings, std::uint32_t seed);

}  // namespace hair::groom
