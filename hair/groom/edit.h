#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/body_mesh.h"

// Edits of strands as files hold them: left out, smoothed, resampled, mended. Lengths in the file's
// unit unless they are said to be in metres.
namespace hair::groom {

// What an edit did, with the number of things that it did it to: {"strands shorter than 5 mm", 12}.
struct EditNote {
    std::string what;
    std::uint64_t count = 0;
};

struct EditedStrands {
    StrandSet strands;
    std::vector<EditNote> notes;  // of what was asked for or looked for, also where the count is 0
};

// Which strands are left out; what is absent is not looked at. Lengths in metres.
struct FilterSettings {
    std::optional<double> shortest;  // strands shorter than that
    std::optional<double> longest;  // and longer
    std::optional<std::uint32_t> fewest_points;
    std::optional<std::uint32_t> most_points;
    std::optional<double> farthest_root;  // from the mesh
    std::optional<double> deepest;  // with a point deeper inside the mesh
};

// Strands that fail none of the tests, in their order, with root triangles whose corners all stay.
// A note for each test counts the strands that fail it and none before it. `mesh`, in metres, is
// needed for the last two. Throws engine::Error without it, and where no strand is left.
EditedStrands filterStrands(
    const StrandSet& strands, const FilterSettings& settings, const BodyMesh* mesh,
    double metres_per_unit);

// Directions along each strand diffuse: t - length^2 t'' = t0 by arc length, with free ends (one
// implicit step on finite volumes, by a tridiagonal solve), then unit length again, and the strand
// is put together from the root with the lengths its segments had. Waves of the wave number k
// become smaller by 1 / (1 + k^2 length^2) whatever the spacing of points; straight strands,
// circles away from their ends, roots and lengths stay. Where positions are averaged instead
// (Taubin 1995, A signal processing approach to fair surface design), hair gets shorter and curls
// narrower.
StrandSet smoothStrands(StrandSet strands, double length);

// Every strand with points at equal distances of arc, as near to `spacing` as they go: both ends
// stay. What points have is interpolated. Strands without length stay as they are.
StrandSet resampleBySpacing(StrandSet strands, double spacing);

// What inspect() finds and can be mended without a choice: strands without length and those equal
// to one before them are left out, points at the place of the one before them too; strands of more
// than 256 points get as many. With a mesh, in metres: a strand whose root is off its surface, but
// no farther than `farthest_root` (m), is moved as it is until its root is there, and points that
// are deeper inside than kSurfaceTolerance are put onto the surface, which changes lengths there.
// Throws engine::Error where no strand is left.
EditedStrands fixStrands(
    const StrandSet& strands, const BodyMesh* mesh, double metres_per_unit, double farthest_root);

}  // namespace hair::groom
