#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/groom/mesh/surface.h"
#include "hair/groom/style/clearance.h"
#include "hair/groom/style/displace.h"
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

// Cuts strands at settings.length of arc, and where they first pass the plane; each that is cut is
// shorter by a random length, uniform from 0 to settings.variation. The rest is resampled evenly to
// as many vertices. A strand with its root beyond the plane, or one that would be shorter than a
// thousandth of its length, keeps that thousandth.
Groom cut(Groom groom, const CutSettings& settings, std::uint32_t seed);

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
