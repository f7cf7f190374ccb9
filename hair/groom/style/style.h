#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom_settings.h"

// Styling: pure functions from a groom to a groom. Roots, counts, normals, triangles and the order
// of strands stay, and every random number is a hash of (seed, strand, purpose). Settings without
// an effect, such as the defaults, leave the groom as it is to the bit. Edits of strands as files
// hold them follow at the end.
namespace hair::groom {

// Leads all strands over the mesh to settings.tie and from there on in a braid of three parts, in
// its direction; strands keep their lengths. At u along the braid, the middle of part k is at
// a sin(2 pi (u / pitch + k / 3)) across it and 0.6 a sin(4 pi (u / pitch + k / 3)) into it. A
// strand keeps its place in the section of its part, a disc of radius 0.42 a; the width is 2.84 a.
// As strands end, a falls with the square root of the share that is left. Beyond settings.length,
// the parts come together and hang loose. `mesh` may be null; then strands go straight to the tie.
Groom braid(Groom groom, const BraidSettings& settings, std::uint32_t seed, const Mesh* mesh);

// Draws strands to the centre strand of their clump: vertex k to its vertex k, by strength (1 -
// variation * random) smoothstep(start, 1, position along the strand). Centre strands stay; their
// roots are at least `spacing` apart, and every strand joins the nearest. With several levels,
// this is done for spacing / 2^(levels - 1) first and for `spacing` last.
Groom clump(Groom groom, const ClumpSettings& settings, std::uint32_t seed);

// Adds a sine across the strand, in the plane of its tangent at the root and the root's normal.
// Where those are parallel or there is no normal, it is in the strand's own plane. Its phase is
// that of the strand's clump of `spacing`, and drifts along the strand by up to `drift` waves. The
// helix of curl() has the same kind of phase.
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

// Leads strands round the mesh. From the root on, a segment that would end nearer to its surface
// than `clearance`, or inside, is turned along the surface, in its own direction and that of the
// segment above, and the rest of the strand moves with it. Near the root, at the arc length s, 0.3
// s is enough. Segments keep their lengths, and strands that are clear of the mesh keep every bit.
// For an open mesh, inside means behind the nearest triangle.
Groom keepClear(Groom groom, const Mesh& mesh, double clearance);

// The same for the points of one strand, root first; returns whether they moved. `surface` is the
// mesh's.
bool keepClear(
    std::vector<glm::dvec3>& points, const Mesh& mesh, const NearestSurface& surface,
    double clearance);

// Returns the unit vector away from the part of a mesh's surface next to a point. It points
// outward on either side of the surface.
glm::dvec3 outwardOf(const Mesh& mesh, const NearestSurface& surface, const glm::dvec3& point);

// Cuts strands at settings.length of arc, and where they first pass the plane. The rest is
// resampled evenly to as many vertices. A strand with its root beyond the plane, or one that would
// be shorter than a thousandth of its length, keeps that thousandth.
Groom cut(Groom groom, const CutSettings& settings);

// Sets widths: root_width up to `start`, from there linear in arc length to tip_width.
Groom taper(Groom groom, const TaperSettings& settings);

// Applies every kind of styling in the order of the members of StyleSettings. The hair grows on
// `mesh`, which may be null. Throws engine::Error if there is none to keep clear of.
Groom style(Groom groom, const StyleSettings& settings, std::uint32_t seed, const Mesh* mesh);

// Adds TressFX's follow hairs, which its files leave to the loader: after each strand come `count`
// copies of it, moved within a disc of `radius` (file's unit) across its direction at the root. At
// the tip, the displacement is `tip_separation` times as large, in between linearly. Root
// triangles go on joining the same strands. Throws engine::Error if the result has 2^32 points or
// more.
// It follows TressFX 4.1, TressFXAsset::GenerateFollowHairs, which takes the square round that
// disc and, at vertex k of V, a factor of 1 + separation * k / V.
StrandSet addFollowers(
    const StrandSet& strands, std::uint32_t count, float radius, float tip_separation,
    std::uint32_t seed);

// Returns the strands of these indices, in this order and with all their data; a strand may come
// more than once. Root triangles are left out, because their corners may be gone. Throws
// engine::Error if there are 2^32 points or more.
StrandSet pickStrands(const StrandSet& strands, std::span<const std::uint32_t> indices);

// Multiplies points and widths by `factor`. The stated unit of the file stays.
StrandSet scaleLengths(StrandSet strands, double factor);

}  // namespace hair::groom
