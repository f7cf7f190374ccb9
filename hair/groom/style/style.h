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
// of strands stay; every random number is a hash of (seed, strand, purpose). Settings that do
// nothing, which the defaults are, leave the groom as it is to the bit. Below them are edits of
// strands as files hold them.
namespace hair::groom {

// All strands are led over the mesh to settings.tie and from there on in a braid of three parts,
// in its direction, with their lengths. u along the braid, the middle of part k is at
// a sin(2 pi (u / pitch + k / 3)) across it and 0.6 a sin(4 pi (u / pitch + k / 3)) into it; a
// strand keeps its place in the section of its part, a disc of 0.42 a, and 2.84 a is the width.
// As strands end, a falls with the root of the share that is left. Past settings.length parts come
// together and hang loose. `mesh` may be null: then strands go straight to the tie.
Groom braid(Groom groom, const BraidSettings& settings, std::uint32_t seed, const Mesh* mesh);

// Strands are drawn to the centre strand of their clump: vertex k to its vertex k, by
// strength (1 - variation * random) smoothstep(start, 1, position along the strand). Centre strands
// stay; their roots are at least `spacing` apart, and every strand joins the nearest. With more
// levels than one that is done for spacing / 2^(levels - 1) first and for `spacing` last.
Groom clump(Groom groom, const ClumpSettings& settings, std::uint32_t seed);

// A sine across the strand, in the plane of its tangent at the root and the root's normal, or,
// where those are parallel or there is no normal, in the strand's own plane. Its phase is that of
// the strand's clump of `spacing`, and along the strand wanders by up to `drift` waves; so is a
// helix's.
Groom wave(Groom groom, const WaveSettings& settings, std::uint32_t seed);

// A right-handed helix round the strand, in its rotation-minimising frame (Wang et al. 2008,
// Computation of rotation minimizing frames). At phase 0 it starts in the direction in which wave()
// swings first; frequency counts turns along the strand as it was.
Groom curl(Groom groom, const CurlSettings& settings, std::uint32_t seed);

// Smooth random displacement, at most `amplitude` in length.
Groom frizz(Groom groom, const FrizzSettings& settings, std::uint32_t seed);

// A share of the strands, chosen one by one, go their own way: smooth random displacement that
// grows by smoothstep(start, 1, position along the strand) to at most `reach`.
Groom flyaways(Groom groom, const FlyawaySettings& settings, std::uint32_t seed);

// Strands are led round the mesh: from the root on, a segment that would end nearer to its surface
// than `clearance`, or inside, is turned along it, the way that it and the segment above go, and
// what follows is moved with it. Near the root, at the arc length s, 0.3 s is enough. Segments keep
// their lengths, and strands that are clear of it every bit. For a mesh that is open, inside is
// behind the nearest triangle.
Groom keepClear(Groom groom, const Mesh& mesh, double clearance);

// The same for the points of one strand, root first; returns whether they moved. `surface` is the
// mesh's.
bool keepClear(
    std::vector<glm::dvec3>& points, const Mesh& mesh, const NearestSurface& surface,
    double clearance);

// The unit vector away from the part of a mesh's surface that is next to a point, on either side.
glm::dvec3 outwardOf(const Mesh& mesh, const NearestSurface& surface, const glm::dvec3& point);

// Strands end at settings.length of arc, and where they first pass the plane; what is left of them
// is resampled evenly to as many vertices. A strand whose root is beyond the plane, or that would
// be shorter than a thousandth of its length, keeps that thousandth.
Groom cut(Groom groom, const CutSettings& settings);

// Widths: root_width up to `start`, from there linear in arc length to tip_width.
Groom taper(Groom groom, const TaperSettings& settings);

// Every kind of styling whose settings do something, in the order of the members of StyleSettings.
// `mesh` is what the hair grows on, or null. Throws engine::Error if there is none to keep clear
// of.
Groom style(Groom groom, const StyleSettings& settings, std::uint32_t seed, const Mesh* mesh);

// TressFX's follow hairs, which its files leave to the loader: after each strand `count` copies of
// it, moved within a disc of `radius` (file's unit) across its direction at the root. At the tip
// the displacement is `tip_separation` times as large, in between linearly. Root triangles go on
// joining the same strands. Throws engine::Error if that makes 2^32 points or more.
// After TressFX 4.1, TressFXAsset::GenerateFollowHairs, which takes the square round that disc and
// at vertex k of V a factor of 1 + separation * k / V.
StrandSet addFollowers(
    const StrandSet& strands, std::uint32_t count, float radius, float tip_separation,
    std::uint32_t seed);

// The strands of these indices, in this order and with what they have; one may come more than once.
// Without the root triangles, whose corners may be gone.
// Throws engine::Error if there are 2^32 points or more.
StrandSet pickStrands(const StrandSet& strands, std::span<const std::uint32_t> indices);

// Points and widths times `factor`. What a file says of its unit stays.
StrandSet scaleLengths(StrandSet strands, double factor);

}  // namespace hair::groom
