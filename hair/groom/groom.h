#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

// The two forms of hair: guides at rest, which simulation and rendering read, and strands as files
// hold them.
namespace hair::groom {

// A strand between guides: at rest, vertex k is the weighted mean of vertex k of the three guides
// plus `offset`. Without weights it follows the head alone, and needs points of its own.
struct StrandBinding {
    std::array<std::uint32_t, 3> guides{};
    glm::vec3 weights{1.0f, 0.0f, 0.0f};  // sum 1; all 0: no guide counts
    glm::vec3 offset{0.0f, 0.0f, 0.0f};   // m; puts the root where the file has it
    float width = 0.0f;  // m, at the root; 0: the common width

    bool followsHead() const { return weights == glm::vec3(0.0f); }
};

// Positions of guides over time, from a file that plays: linear between samples, and still before
// the first and after the last.
struct GuideCache {
    std::vector<double> times;  // [sample], s, ascending from 0; empty: there is no cache
    std::vector<glm::vec3> points;  // [sample][strand][vertex], m
    std::optional<float> strength;  // 1/s^2, of springs to it; absent: guides are put there
};

// Guide hairs at rest with the triangles that span them. Import and growth make it, simulation and
// rendering read it. Nothing changes it after it is built.
struct Groom {
    std::uint32_t strand_count = 0;
    std::uint32_t vertices_per_strand = 0;  // V >= 2, the same for every strand
    std::vector<glm::vec3> points;          // [strand][vertex], m, root first
    std::vector<glm::vec3> root_normals;  // [strand], of the scalp, unit length; empty: not known
    std::vector<float> widths;  // [strand][vertex], diameters, m; empty: not known
    // Guide indices; strands grow between them.
    std::vector<std::array<std::uint32_t, 3>> root_triangles;
    // The strands, of the file or grown, that the guides were chosen from. Strands that follow the
    // head alone come after them.
    std::vector<StrandBinding> bindings;
    // The bound strands' own points at rest; the bindings give only the mean of their guides. In a
    // strand with vertices_per_strand points, each point belongs to a vertex of the guides. Points
    // of other strands are placed by arc length. Empty: not known.
    std::vector<std::uint32_t> bound_ends;  // [binding], index after its last point; ascends
    std::vector<glm::vec3> bound_points;  // [point], strand after strand, m, root first
    // Numbers of the file's groups; empty: there are none. Strands that follow the head alone have
    // kNoGroup.
    std::vector<std::int32_t> guide_groups;  // [strand]
    std::vector<std::int32_t> groups;  // [binding]
    std::vector<std::string> warnings;  // of the file that strands are from
    GuideCache cache;

    static constexpr std::int32_t kNoGroup = -1;

    std::uint32_t segmentsPerStrand() const { return vertices_per_strand - 1; }
    std::span<const glm::vec3> strand(std::uint32_t index) const& {
        return std::span(points).subspan(
            std::size_t{index} * vertices_per_strand, vertices_per_strand);
    }
    std::span<const glm::vec3> strand(std::uint32_t) const&& = delete;  // would dangle
    std::span<const glm::vec3> boundStrand(std::size_t binding) const& {
        const std::uint32_t first = binding == 0 ? 0 : bound_ends[binding - 1];
        return std::span(bound_points).subspan(first, bound_ends[binding] - first);
    }
    std::span<const glm::vec3> boundStrand(std::size_t) const&& = delete;
};

// An attribute of strands: none, one value everywhere, or a value for each point.
template <class Value>
struct PointAttribute {
    std::optional<Value> everywhere;  // counts if `values` is empty
    std::vector<Value> values;  // [point], or empty

    bool known() const { return everywhere.has_value() || !values.empty(); }
    // The value at a point; requires known().
    const Value& at(std::size_t point) const {
        return values.empty() ? *everywhere : values[point];
    }
};

// Strands of a file that can't be used, for one reason.
struct LeftOutStrands {
    std::string reason;  // completes "strands ...": "of a single point"
    std::uint32_t count = 0;
    std::uint32_t first = 0;  // number of the first of them in the file, from 0
};

// Strands as files hold them: each has its own number of points, and there is other data that the
// format stores. Importers make it, exporters write it, and a Groom is made from it. In every set,
// `ends` ascends strictly (a strand has at least one point) and its last element is the number of
// points, all numbers are finite, and vectors that are not empty have the sizes stated here.
// Readers of formats may return other sets to usableStrands() alone.
struct StrandSet {
    std::vector<std::uint32_t> ends;  // [strand], index after its last point
    std::vector<glm::vec3> points;  // [point], strand after strand, root first, file's unit
    PointAttribute<float> widths;  // diameters, file's unit
    PointAttribute<float> transparencies;  // 0 opaque to 1
    PointAttribute<glm::vec3> colors;  // RGB, 0 to 1, as in the file
    std::vector<glm::vec2> root_uvs;  // [strand], texture coordinates of the mesh at the root
    std::vector<std::int32_t> groups;  // [strand], number of the group that it belongs to
    std::vector<std::uint8_t> guides;  // [strand], 1 for those that the file calls guides, or 0
    std::vector<std::array<std::uint32_t, 3>> root_triangles;  // strand indices
    std::optional<double> metres_per_unit;  // if the format or the file states it
    std::optional<std::uint8_t> up;  // upward axis, 0 x, 1 y, 2 z, if the format or file states it
    std::string comment;  // the file's own description
    std::vector<std::string> warnings;  // data of the file that this can't hold
    std::vector<LeftOutStrands> left_out;  // one for each reason; `warnings` has them in words

    // A strand that its reader found to be unusable.
    struct Fault {
        std::uint32_t strand;
        std::string_view reason;  // as in LeftOutStrands
    };
    std::vector<Fault> faults;  // ascending; only for usableStrands()

    std::uint32_t strandCount() const { return static_cast<std::uint32_t>(ends.size()); }
    std::uint32_t first(std::uint32_t strand) const { return strand == 0 ? 0 : ends[strand - 1]; }
    std::uint32_t size(std::uint32_t strand) const { return ends[strand] - first(strand); }
    std::span<const glm::vec3> strand(std::uint32_t strand) const& {
        return std::span(points).subspan(first(strand), size(strand));
    }
    std::span<const glm::vec3> strand(std::uint32_t) const&& = delete;
};

// Returns the strands with these ascending indices, with everything that belongs to them. Root
// triangles stay if all of their corners do.
StrandSet keepStrands(StrandSet strands, std::span<const std::uint32_t> kept);

// Throws engine::Error for a group without strands; it lists the groups that there are.
void requireGroups(const StrandSet& strands, std::span<const std::int32_t> groups);

// Returns the strands that belong to one of the groups. Throws as requireGroups() does.
StrandSet keepGroups(StrandSet strands, std::span<const std::int32_t> groups);

// Returns the numbers of the strands that the file flags as guides, ascending.
std::vector<std::uint32_t> flaggedGuides(const StrandSet& strands);

// A choice for strands of a file that can't be used.
enum class BadStrands { left_out, refused, kept };
constexpr BadStrands badStrands(bool is_strict) {
    return is_strict ? BadStrands::refused : BadStrands::left_out;
}

// Leaves out strands that can't be drawn or simulated: without points, of one point, with a number
// that is not finite or a negative width, and those with a fault that their reader found. Root
// triangles with such a corner go too. A warning for each reason counts the strands and names the
// first. In `strands` ends may repeat and numbers be NaN or infinite. Throws engine::Error if no
// strand is left, or if any are left out and they are `refused`. Must not be called with `kept`.
StrandSet usableStrands(StrandSet strands, BadStrands bad = BadStrands::left_out);

// Returns "3 strands of a single point (the first is strand 5, counted from 0) are left out".
std::string warningOf(const LeftOutStrands& left_out);

// The number of points that every strand has; absent if they differ or there are no strands.
std::optional<std::uint32_t> commonSize(const StrandSet& strands);

// The greatest number of points of a strand; 0 without strands.
std::uint32_t greatestSize(const StrandSet& strands);

// Resamples every strand to `vertices` >= 2 points, evenly spaced by arc length along its polyline.
// Both ends are kept to the bit, and attributes of points are interpolated. A strand that already
// has this number of points stays as it is. A strand of one point, or without length, stays at its
// place. Throws engine::Error if the result has 2^32 points or more.
StrandSet resample(StrandSet strands, std::uint32_t vertices);

// Resamples each strand to a number of points of its own: at least 2, or its present number.
StrandSet resample(StrandSet strands, std::span<const std::uint32_t> sizes);

}  // namespace hair::groom
