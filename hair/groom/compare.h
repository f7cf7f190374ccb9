#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"
#include "hair/groom/mesh/body_mesh.h"

// Similarity of two grooms, by the measures of papers on the reconstruction of strands:
// docs/grooms.md has the definitions. Strands are continuous here: evenly spaced samples of
// one groom are compared with the polylines of the other, so that no measure depends on the places
// of vertices.
namespace hair::groom {

// A point counts as found in the other groom if a point of a strand there is no farther away than
// `distance` and the tangents differ by no more than `angle`.
struct MatchThreshold {
    double distance;  // m
    double angle;  // degrees
};

// Thresholds of Sklyarova et al. 2023, Neural Haircut, and of papers that compare with it.
inline constexpr std::array kUsualThresholds{
    MatchThreshold{2e-3, 20.0}, MatchThreshold{3e-3, 30.0}, MatchThreshold{4e-3, 40.0}};

// Whether strands of opposite directions match: reconstructions of line segments don't know root
// from tip.
enum class StrandDirections { from_root_to_tip, either_way };

struct CompareSettings {
    std::vector<MatchThreshold> thresholds{kUsualThresholds.begin(), kUsualThresholds.end()};
    double spacing = 2e-3;  // m, greatest spacing of samples along strands
    double curvature_step = 5e-3;  // m of arc between the directions that give curvature
    // Samples of a strand, evenly along it, that its consistency is computed from. They are few,
    // because a sample has many matches in dense hair. 0: all samples.
    std::uint32_t consistency_samples = 16;
    StrandDirections directions = StrandDirections::from_root_to_tip;
    std::uint32_t threads = 0;  // 0: as many as the machine has; the results are the same
};

// The samples of a groom.
struct SampledStrands {
    std::uint32_t strands = 0;
    std::uint32_t without_length = 0;  // strands that are left out of all measures
    std::size_t samples = 0;
    double length = 0.0;  // of all strands, m
};

// Shares from 0 to 1; the first groom is the reference.
struct MatchScores {
    MatchThreshold threshold;
    double precision = 0.0;  // share of the second groom's samples found in the reference
    double recall = 0.0;  // share of the reference's samples found in the second groom
    double f1 = 0.0;  // their harmonic mean; 0 if both are 0
    // Mean over the reference's strands of the greatest share of a strand's consistency_samples
    // that a single strand of the other groom has. Pan, Niessner and Kirschstein 2025, HairGS.
    double strand_consistency = 0.0;
};

// Statistics of the distances from one groom's samples to the other's strands, m. Quantiles as in
// Summary.
struct DistanceFindings {
    double mean = 0.0;
    double mean_square = 0.0;  // m^2
    double median = 0.0;
    double percentile90 = 0.0;
    double percentile95 = 0.0;
    double percentile99 = 0.0;
    double maximum = 0.0;  // the one-sided Hausdorff distance, up to half a spacing
};

// Distribution of a quantity in both grooms.
struct DistributionFindings {
    Summary first;
    Summary second;
    // The area between both cumulative distributions, in the quantity's unit: the earth mover's or
    // first Wasserstein distance.
    double earth_movers_distance = 0.0;
    std::vector<double> edges;  // of the bins, ascending; one more bin is beyond the last edge
    std::vector<double> first_shares;  // [bin]
    std::vector<double> second_shares;
    double histogram_distance = 0.0;  // sum over bins of the shares' absolute differences, 0 to 2
};

// How far a groom's samples reach into a body.
struct PenetrationFindings {
    std::size_t samples_inside = 0;  // deeper than kSurfaceTolerance
    double share = 0.0;  // of all samples
    std::uint32_t strands_inside = 0;  // with a sample inside
    double mean_depth = 0.0;  // of the samples inside, m
    double deepest = 0.0;  // m
};

struct StrandComparison {
    SampledStrands first;
    SampledStrands second;
    bool equal = false;  // the same strands in the same order, point for point
    std::vector<MatchScores> scores;  // [threshold]
    DistanceFindings first_to_second;
    DistanceFindings second_to_first;
    DistributionFindings lengths;  // of strands, m
    DistributionFindings curvatures;  // along strands, 1/m
    std::optional<PenetrationFindings> first_inside;  // if a mesh is given
    std::optional<PenetrationFindings> second_inside;
};

// Strands and mesh are in metres; `mesh` may be null. Throws engine::Error for settings out of
// range, for a groom with coordinates that are not finite, and for a groom in which no strand has a
// length.
StrandComparison compareStrands(
    const StrandSet& first, const StrandSet& second, const BodyMesh* mesh,
    const CompareSettings& settings);

}  // namespace hair::groom
