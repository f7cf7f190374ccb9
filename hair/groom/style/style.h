#pragma once

#include <cstdint>

#include "hair/groom/groom.h"
#include "hair/groom_settings.h"

// Styling: pure functions from a groom to a groom. Roots, counts, normals, triangles and the order
// of strands stay; every random number is a hash of (seed, strand, purpose). Settings that do
// nothing, which the defaults are, leave the groom as it is to the bit.
namespace hair {

// Strands are drawn to the centre strand of their clump: vertex k to its vertex k, by
// strength * smoothstep(start, 1, position along the strand). Centre strands stay; their roots are
// at least `spacing` apart, and every strand joins the nearest.
Groom clump(Groom groom, const ClumpSettings& settings, std::uint32_t seed);

// A sine across the strand, in the plane of its tangent at the root and the root's normal, or,
// where those are parallel or there is no normal, in the strand's own plane.
Groom wave(Groom groom, const WaveSettings& settings, std::uint32_t seed);

// A right-handed helix round the strand, in its rotation-minimising frame (Wang et al. 2008,
// Computation of rotation minimizing frames). At phase 0 it starts in the direction in which wave()
// swings first; frequency counts turns along the strand as it was.
Groom curl(Groom groom, const CurlSettings& settings, std::uint32_t seed);

// Smooth random displacement, at most `amplitude` in length.
Groom frizz(Groom groom, const FrizzSettings& settings, std::uint32_t seed);

// Strands end at settings.length of arc, and where they first pass the plane; what is left of them
// is resampled evenly to as many vertices. A strand whose root is beyond the plane, or that would
// be shorter than a thousandth of its length, keeps that thousandth.
Groom cut(Groom groom, const CutSettings& settings);

// Widths: root_width up to `start`, from there linear in arc length to tip_width.
Groom taper(Groom groom, const TaperSettings& settings);

// All of the above whose settings do something, in the order of the members of StyleSettings.
Groom style(Groom groom, const StyleSettings& settings, std::uint32_t seed);

}  // namespace hair
