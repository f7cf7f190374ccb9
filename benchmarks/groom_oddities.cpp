#include "benchmarks/groom_oddities.h"

#include "benchmarks/quantity_text.h"

namespace benchmarks {
namespace {

// Human hair is 17 to 181 µm thick; wider and narrower than by a factor of ten is another unit, or
// a width to draw with.
constexpr double kThinnest = 1.7e-6;   // m
constexpr double kThickest = 1.81e-3;  // m

// Of a groom's median strand: stubble and the longest hair that is worn.
constexpr double kShortest = 0.5e-3;  // m
constexpr double kLongest = 3.0;      // m

constexpr std::uint32_t kMostGuideVertices = 256;

class Oddities {
public:
    void add(std::string_view name, std::uint64_t count, std::string what, std::string advice) {
        if (count > 0) all_.push_back({name, count, std::move(what), std::move(advice)});
    }
    std::vector<Oddity> take() { return std::move(all_); }

private:
    std::vector<Oddity> all_;
};

void findInStrands(const hair::StrandFindings& found, Oddities& odd) {
    odd.add(
        "no_strands", found.strands == 0 ? 1 : 0, "there are no strands",
        "export the hair as curves or lines, not as a mesh");
    odd.add(
        "single_point_strands", found.single_point_strands,
        countText(found.single_point_strands, "strand") + " of a single point",
        "leave them out where the hair is made: nothing of them is drawn");
    odd.add(
        "zero_length_strands", found.zero_length_strands,
        countText(found.zero_length_strands, "strand") + " without length, all points at one place",
        "leave them out where the hair is made: nothing of them is drawn");
    odd.add(
        "zero_length_segments", found.zero_length_segments,
        countText(found.zero_length_segments, "segment") + " without length",
        "space the points evenly: hairbench groom convert IN OUT --vertices N");
    odd.add(
        "duplicate_strands", found.duplicate_strands,
        countText(found.duplicate_strands, "strand") + " equal to another, point for point",
        "leave them out where the hair is made: they cost time and show nothing");
    if (found.duplicate_roots > found.duplicate_strands) {
        const std::uint32_t more = found.duplicate_roots - found.duplicate_strands;
        odd.add(
            "duplicate_roots", more,
            countText(more, "strand") + " with the root of another, but not its shape",
            "no harm to drawing; of guides only one of them can be a corner of root triangles");
    }
    const auto most = static_cast<std::uint64_t>(found.points_per_strand.maximum);
    odd.add(
        "long_strands", most > kMostGuideVertices ? most : 0,
        "strands of up to " + countText(most, "point"),
        "guides have at most 256 and are resampled; do it once: hairbench groom convert IN OUT "
        "--vertices 256");
}

void findInUnits(const hair::StrandSet& strands, const hair::StrandFindings& found, Oddities& odd) {
    const std::string scale = plainNumber(found.metres_per_unit);
    odd.add(
        "unit", !found.unit_stated && found.metres_per_unit != 1.0 ? 1 : 0,
        "lengths that look like " + found.unit + ", and a file that doesn't state its unit",
        "say it: --scale " + scale +
            " here and in hairbench groom convert, /groom/placement/scale " + scale +
            " in a scene");
    const double length = found.lengths.median * found.metres_per_unit;
    odd.add(
        "lengths", found.unit_stated && (length < kShortest || length > kLongest) ? 1 : 0,
        "a median strand of " + lengthText(length) + ", in the unit that is stated",
        "if this is hair, the unit is another: --scale overrides it here and in hairbench groom "
        "convert");
    const double width = found.widths.median * found.metres_per_unit;
    odd.add(
        "widths", strands.widths.known() && (width < kThinnest || width > kThickest) ? 1 : 0,
        "widths of " + lengthText(width) + " (median); human hair is 0.017 to 0.181 mm wide",
        "scale them to the unit of the points where the hair is made, or take no notice: they are "
        "for drawing alone");
}

void findOnMesh(const hair::MeshFindings& found, Oddities& odd) {
    odd.add(
        "roots_off_surface", found.roots_off_surface,
        countText(found.roots_off_surface, "root") + " further than " +
            lengthText(found.tolerance) + " from the mesh, up to " +
            lengthText(found.root_distances.maximum),
        "check the units (--scale) and that the hair was made for this mesh, in the same place");
    odd.add(
        "strands_inside", found.strands_inside.value_or(0),
        countText(found.strands_inside.value_or(0), "strand") + " deeper than " +
            lengthText(found.tolerance) + " inside the mesh, up to " +
            lengthText(found.deepest.value_or(0.0)),
        "push them out where the hair is made, or let a simulation with collision do it");
    odd.add(
        "mesh_not_closed", found.not_closed.empty() ? 0 : 1,
        "a mesh that is not closed: " + found.not_closed,
        "close it if it is to be known which strands are inside");
}

}  // namespace

std::vector<Oddity>
findOddities(const hair::StrandSet& strands, const hair::StrandFindings& findings) {
    Oddities odd;
    findInStrands(findings, odd);
    if (findings.strands > 0) findInUnits(strands, findings, odd);
    if (findings.mesh) findOnMesh(*findings.mesh, odd);
    return odd.take();
}

}  // namespace benchmarks
