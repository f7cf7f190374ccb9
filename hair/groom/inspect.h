#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "hair/groom/groom.h"
#include "hair/groom/mesh/mesh.h"

// Contents and oddities of a file of strands.
namespace hair::groom {

// The quartiles, extremes and mean of many numbers.
struct Summary {
    double minimum = 0.0;
    double quartile1 = 0.0;
    double median = 0.0;
    double quartile3 = 0.0;
    double maximum = 0.0;
    double mean = 0.0;
};

// Points within this distance count as on the surface, m. Triangles deviate from the round head
// that they stand for by e^2 / 8 r: 0.5 mm for a coarse mesh with edges of e = 2 cm on a head of r
// = 10 cm. Hair is up to 0.1 mm wide, and a distance of more than a millimetre is visible.
inline constexpr double kSurfaceTolerance = 1e-3;

// How strands lie on the mesh that they grow on; distances in metres.
struct MeshFindings {
    Summary root_distances;  // of roots from the surface, unsigned
    std::uint32_t roots_off_surface = 0;  // further than `tolerance`
    double tolerance = 0.0;  // m
    std::uint32_t tips_on_surface = 0;  // counted only if most roots are off it
    // An open mesh has its inside where the winding number is 1/2 or more. Absent if the mesh
    // bounds no body.
    std::optional<std::uint32_t> strands_inside;  // with a vertex deeper than `tolerance`
    std::optional<std::size_t> points_inside;  // deeper than `tolerance`
    std::optional<double> deepest;  // m
    bool closed = false;
    std::string not_closed;  // why it is not closed, or why the three are absent
    std::vector<std::string> warnings;  // as in Mesh
};

// A strand that lies apart from the others. Units, sizes and views do not count it.
struct Stray {
    std::uint32_t strand;
    bool by_root;  // its root is far from the other roots; otherwise it has a far too long segment
    double distance;  // from the middle of the roots, or that segment's length; file's unit
};

// Returns strays, farthest first. A root is astray at more than four times the distance from the
// median root that 95 % of the roots are within, a segment at more than four times the length that
// 95 % of the strands' longest segments are below. So at most 5 % of the strands are strays, and a
// groom of fewer than 20 strands has none.
std::vector<Stray> findStrays(const StrandSet& strands);

// Returns the strands that are no strays, in ascending order.
std::vector<std::uint32_t> strandsBut(const StrandSet& strands, const std::vector<Stray>& strays);

struct Unit {
    std::string name;  // "m", "cm", "mm" or "inch"; a stated one may be another: "0.5 m"
    double metres;  // its length
    std::string reason;  // a sentence
};

Unit statedUnit(double metres);

// A unit by the sizes of a scalp and of hair, from those that are not strays.
struct UnitGuess {
    Unit unit;
    // Its likelihood over the sum for all units that are tried, 0 to 1.
    double certainty = 0.0;
};

// Contents and oddities of a groom. Lengths are in the file's unit.
struct StrandFindings {
    std::uint32_t strands = 0;
    std::size_t points = 0;
    Summary points_per_strand;
    Summary lengths;
    Summary segment_lengths;
    std::vector<Stray> strays;
    glm::vec3 minimum{0.0f};  // bounding box without strays
    glm::vec3 maximum{0.0f};
    Summary widths;  // all 0 if not known

    std::uint32_t single_point_strands = 0;
    std::size_t zero_length_segments = 0;
    std::uint32_t zero_length_strands = 0;  // of two points or more
    std::uint32_t duplicate_strands = 0;  // equal to one before them, point for point
    std::uint32_t duplicate_roots = 0;  // at the root of one before them

    std::string unit;  // "m", "cm", "mm" or "inch", or a stated one of another length: "0.5 m"
    bool unit_stated = false;
    double metres_per_unit = 1.0;
    std::string unit_reason;  // a sentence: the file states it, or what the guess rests on
    // If a unit is stated and the sizes of at least 20 strands clearly suggest another.
    std::optional<UnitGuess> other_unit;
    std::optional<MeshFindings> mesh;
};

// `mesh` is in metres and may be null. The strands are scaled to metres by `metres_per_unit` or, if
// that is absent, by the unit of the findings.
StrandFindings
inspect(const StrandSet& strands, const Mesh* mesh, std::optional<double> metres_per_unit);

// The length of a polyline.
double arcLength(std::span<const glm::vec3> points);

// Returns the strands that are equal to an earlier one, point for point, in ascending order.
std::vector<std::uint32_t> duplicateStrands(const StrandSet& strands);

// Returns the length in metres of "m", "cm", "mm" or "inch". Throws engine::Error for others.
double metresOf(std::string_view unit);

// Returns the quantile at a share from 0 to 1, interpolated between two numbers if its rank isn't
// whole (Hyndman and Fan 1996, Sample quantiles in statistical packages, definition 7). Needs at
// least one number. Reorders the numbers, because a copy would take too much memory.
double quantileOf(std::span<float> numbers, double share);

// Quartiles by quantileOf(), so it also reorders the numbers. All 0 without numbers.
Summary summaryOf(std::vector<float>& numbers);

}  // namespace hair::groom
