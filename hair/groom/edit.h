#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

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

// Turns strands round, so that the last point becomes the root; their data of points turn with
// them. Texture coordinates of roots stay: in files that begin at the tip they are of the other
// end.
StrandSet reverseStrands(StrandSet strands);

// A change of the coordinates that strands are in: first the unit, then the upward axis, a mirror
// image, a factor, a translation.
struct TransformSettings {
    std::optional<double> from_metres_per_unit;  // absent: as the strands state
    std::optional<double> metres_per_unit;  // absent: the unit stays
    std::optional<std::uint8_t> from_up;  // 0 x, 1 y, 2 z; absent: as the strands state
    std::optional<std::uint8_t> up;  // absent: axes stay
    std::optional<std::uint8_t> mirror;  // axis along which coordinates change their sign
    double scale = 1.0;
    glm::dvec3 translation{0.0};  // in the unit of the result
};

// Each coordinate is rounded once. The upward axis changes by a quarter turn that keeps
// the third axis, so text and asymmetries stay readable. Widths scale too. Root triangles of a
// mirror image go round the other way, so that they keep their outer side. Throws engine::Error if
// a unit or axis is asked for and the present one is not known, or a coordinate gets too large for
// a float.
EditedStrands transformStrands(StrandSet strands, const TransformSettings& settings);

// The matrix that takes directions with `from` up to directions with `to` up, as rows and columns
// of -1, 0 and 1: a quarter turn, or nothing.
glm::dmat3 upAxisTurn(std::uint8_t from, std::uint8_t to);

// A group of strands.
struct StrandGroup {
    std::optional<std::int32_t> number;  // absent: of strands that have no groups
    std::uint32_t strands = 0;
    std::uint32_t guides = 0;
    std::uint64_t points = 0;
    double mean_length = 0.0;  // file's unit
};

// In ascending order of their numbers.
std::vector<StrandGroup> groupsOf(const StrandSet& strands);

// A new number for a group; several may get the same.
struct GroupChange {
    std::int32_t from = 0;
    std::int32_t to = 0;
};

// Gives groups other numbers, all at once: {1 -> 2, 2 -> 1} exchanges them. Throws engine::Error
// for a group that is not there or is changed twice.
EditedStrands renumberGroups(StrandSet strands, const std::vector<GroupChange>& changes);

}  // namespace hair::groom
