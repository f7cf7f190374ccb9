#pragma once

#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "hair/settings.h"

// The simulation's equations, one function each, in double and straight from the papers: what the
// GPU is tested against. Nothing here is shared with the shaders or with what feeds them.
//
// Every span is the vertices of one strand, root first, in m. The root is pinned: it has infinite
// mass, every other vertex mass 1. Segment i ends in vertex i, so segment 1 holds the root.
// Iterations are red-black: segments that end in odd vertices move first, then those that end in
// even ones. A segment shorter than 1e-9 m has no direction of its own.
namespace hair::reference {

using Points = std::span<glm::dvec3>;
using ConstPoints = std::span<const glm::dvec3>;

// Thesis eq. 9 with friction; leaves the root alone. `previous` becomes the positions before the
// call.
void integrate(
    Points positions, Points previous, ConstPoints accelerations, double velocity_kept,
    double substep);

// Thesis eq. 10.
void pullToRest(Points positions, ConstPoints rest, double stiffness);

// Frames of the segments, [vertex]: entry 0 is the root's, entry i >= 1 that of segment i. A frame
// turns the rest strand's directions into the current one's: R_0 = root_frame, R_1 is R_0 followed
// by the smallest rotation that takes R_0 s_1 to t_1, and R_i = P_i R_(i-1) Q_i^-1 with P_i, Q_i
// the smallest rotations t_(i-1) -> t_i and s_(i-1) -> s_i of unit tangents now (t) and at rest
// (s). Opposite tangents turn round an axis that is perpendicular to the first and to the
// coordinate axis it has least of. A segment that has no direction at rest or now takes the tangent
// of the segment before it, the first one R_0 s_1; the rest tangent likewise, the first one +y.
std::vector<glm::dmat3> segmentFrames(
    ConstPoints positions, ConstPoints rest, const glm::dmat3& root_frame = glm::dmat3(1.0));

// Thesis eq. 11, one red-black iteration with the frames of its start; Han and Harada 2012.
void pullToShape(
    Points positions, ConstPoints rest, double stiffness,
    const glm::dmat3& root_frame = glm::dmat3(1.0));

// Thesis eq. 12, one red-black iteration. Vertices that coincide are parted along +y.
void projectLengths(Points positions, ConstPoints rest);

// Moves every vertex but the root to the surface of each capsule it is inside of, in the list's
// order and the margin away from it, the shortest way; from a point on the axis along the
// perpendicular described above. Friction then takes back what the vertex moved along the surface
// since `before`, at most the coefficient times the depth: Macklin et al. 2014, Unified particle
// physics for real-time applications, eq. 24.
void pushOut(
    Points positions, ConstPoints before, std::span<const Collider> colliders,
    const CollisionSettings& settings);

}  // namespace hair::reference
