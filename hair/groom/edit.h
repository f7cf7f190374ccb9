#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/body_mesh.h"

// Edits of strands as files hold them: filtering, smoothing, resampling and repair. Lengths are in
// the file's unit unless stated in metres.
namespace hair::groom {

// A kind of change that an edit made, with its number: {"strands shorter than 5 mm", 12}.
struct EditNote {
    std::string what;
    std::uint64_t count = 0;
};

struct EditedStrands {
    StrandSet strands;
    std::vector<EditNote> notes;  // for each request or check, even if it made no change
};

// Limits of the strands that are kept; absent limits are not tested. Lengths in metres.
struct FilterSettings {
    std::optional<double> shortest;  // length below which strands are left out
    std::optional<double> longest;  // length above which they are left out
    std::optional<std::uint32_t> fewest_points;
    std::optional<std::uint32_t> most_points;
    std::optional<double> farthest_root;  // distance of a root from the mesh
    std::optional<double> deepest;  // depth of a point inside the mesh
    std::vector<std::int32_t> groups;  // that are kept; empty: all
};

// Keeps the strands that pass all tests, in their order, with the root triangles that keep all of
// their corners. A note for each test counts the strands that fail it but no test before it. The
// last two tests need `mesh`, in metres. Throws engine::Error without it, for a group that the
// strands don't have, and if no strand is left.
EditedStrands filterStrands(
    const StrandSet& strands, const FilterSettings& settings, const BodyMesh* mesh,
    double metres_per_unit);

// Diffuses the directions along each strand: t - length^2 t'' = t0 by arc length, with free ends
// (one implicit step on finite volumes, by a tridiagonal solve). The directions are then
// normalised, and the strand is put together from the root with the old lengths of its segments.
// Waves of the wave number k become smaller by 1 / (1 + k^2 length^2) whatever the spacing of
// points. Straight strands, circles away from their ends, roots and lengths stay. Averaging
// positions instead (Taubin 1995, A signal processing approach to fair surface design) makes hair
// shorter and curls narrower.
StrandSet smoothStrands(StrandSet strands, double length);

// Resamples every strand at equal arc lengths, as close to `spacing` as possible. Both ends stay.
// Attributes of points are interpolated. Strands without length stay as they are.
StrandSet resampleBySpacing(StrandSet strands, double spacing);

// Mends strands as readers return them (BadStrands::kept): leaves out points with a number that is
// not finite, and then the strands that usableStrands() leaves out. A strand without its first
// point begins at the next one.
EditedStrands mendStrands(StrandSet strands);

// Repairs those findings of inspect() that have a single remedy. Strands of a single point or
// without length, strands equal to an earlier one, and points at the place of the point before them
// are left out. Strands of more than 256 points get 256. With a mesh, in metres: a strand with its
// root off the surface, but no farther than `farthest_root` (m), is translated until its root is
// there. Points that are deeper inside than kSurfaceTolerance are put onto the surface, which
// changes lengths there. Throws engine::Error if no strand is left.
EditedStrands fixStrands(
    const StrandSet& strands, const BodyMesh* mesh, double metres_per_unit, double farthest_root);

}  // namespace hair::groom
