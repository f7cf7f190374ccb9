#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/commands.h"
#include "hair/groom/groom.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

// How many strands a picture draws, in which draws and at which level of detail.
namespace hair::rendering {

constexpr std::uint32_t divideUp(std::uint32_t value, std::uint32_t divisor) {
    return (value + divisor - 1) / divisor;
}

// Counts of the strands, patches and vertices that a picture draws: thesis 2.3.5. The strands of a
// groom count as those of one root triangle, each a patch of its own in every guide segment.
struct StrandPlan {
    std::uint32_t triangles = 0;
    std::uint32_t segments = 0;  // guide segments per guide
    std::uint32_t density = 0;  // strands per root triangle at level 0
    std::uint32_t tessellation = 0;  // drawn segments per guide segment at level 0
    // Counts at the forced level, or at level 0 in other modes.
    std::uint32_t forced_density = 0;
    std::uint32_t forced_tessellation = 0;
    float forced_level = 0.0f;  // 0 in other modes
    float forced_scale = 1.0f;  // 2^-forced_level
    bool morphs = false;  // ends of drawn segments may leave their curve: DrawnPieces
    std::uint32_t patches_per_triangle = 0;  // per guide segment
    std::uint32_t strands_per_patch = 0;
    LodMode lod_mode = LodMode::forced;
    bool residuals = false;  // the groom's strands have residuals
    bool skinned = false;  // roots follow the triangles of a mesh that deforms
    bool merged_hairs = false;  // strands of coarser levels show the hairs they stand for
    bool own_colors = false;  // strands differ in colour
    float reach = 0.0f;  // m; greatest distance by which offsets move points
    float greatest_width = 0.0f;  // m, at level 0 of detail; with gaps between merged hairs

    // Patches of the whole picture, numbered [triangle][part][segment].
    std::uint32_t patches() const { return triangles * patches_per_triangle * segments; }
    // Most vertices that one patch tessellates to.
    std::uint32_t verticesPerPatch() const;
    // Drawn strands and their drawn segments; unless the level is forced, those of level 0.
    std::uint64_t strands() const;
    std::uint64_t drawnSegments() const;
};

// Returns the number of strands drawn per root triangle at a level of detail, scale = 2^-level. At
// least 1. The last strand's width is scaled by the fraction of the count, so that no strand pops
// in or out.
std::uint32_t drawnStrands(std::uint32_t density, float scale);

// Drawn segments per guide segment at a level of detail: the coarsest of the nested sets with at
// least tessellation * scale segments. Each set has the size of the previous one divided by its
// smallest prime factor, down to 1. A prime number has no set between it and 1.
struct DrawnPieces {
    std::uint32_t count = 1;
    bool morphs = false;  // ends that the next set lacks move towards its lines
};
DrawnPieces drawnPieces(std::uint32_t tessellation, float scale);

// `isoline_limit` is the device's maxTessellationGenerationLevel; denser triangles take several
// patches. 0, for a device without tessellation: one patch takes all strands.
StrandPlan planStrands(
    std::uint32_t triangles, std::uint32_t segments, const StrandSettings& strands,
    const LodSettings& lod, std::uint32_t isoline_limit);

// Returns the plan of the strands that the settings ask for. Throws engine::Error "<JSON pointer>:
// <reason>" if the view lacks data for it.
StrandPlan
planStrands(const StrandView& view, const Settings& settings, std::uint32_t isoline_limit);

// Expected pipeline statistics of the strands' draws. Absent if only the device knows them.
struct ExpectedCounts {
    std::uint64_t tessellation_control_patches = 0;
    std::optional<std::uint64_t> tessellation_evaluation_invocations;
    std::optional<std::uint64_t> geometry_invocations;
    std::optional<std::uint64_t> geometry_primitives;
};
ExpectedCounts expectedCounts(const StrandPlan& plan);

// Returns draws of one vertex per patch. No instance of a draw tessellates to more than
// `max_vertices` vertices. Patch index = instance * segments + vertex in all of them.
std::vector<engine::Draw>
planDraws(const StrandPlan& plan, Submission submission, std::uint32_t max_vertices);

// Returns how many times wider strands may become in LodMode::distance, 1 or more.
//
// Strands at random places cover 1 - exp(-a) of the area behind them, where a is the sum of their
// areas over that area. Fewer and wider strands with the same sum cover as much, but they stick
// out. Hair of area A and outline P grows to A + P (s - 1) w / 2 if strands of width w become s
// times as wide (Steiner's formula, without its quadratic term). A disc as large as the hair has P
// / A = 2 / R, so the relative growth is (s - 1) w / R. It may be up to kOutlineGrowth.
float greatestWidthScale(const groom::Groom& groom, const StrandSettings& settings);

inline constexpr float kOutlineGrowth = 0.03f;

// Returns the most strands that a root triangle draws in LodMode::distance, at most plan.density.
// `eye`: the camera in the frame of `view`. Roots are within the strands' bounding sphere.
std::uint32_t mostStrands(
    const StrandPlan& plan, const LodSettings& lod, const StrandView& view, const glm::vec3& eye);

// Level of detail of a head of hair in LodMode::distance, seen from /camera/position.
struct DistanceLod {
    double mean_level = 0.0;  // over root triangles, or over the strands of a groom
    std::optional<std::uint64_t> strands;  // drawn; absent if the device orders them
};

// `guides` are the current points of the guides, [guide][vertex], m; `view` is of the same moment.
DistanceLod distanceLod(
    const groom::Groom& groom, std::span<const glm::vec3> guides, const StrandView& view,
    const Settings& settings);

// Order of the strands of each cluster, a root triangle, for levels of detail that keep the first
// of them.
//
// A strand is the mean of its guides, so two strands of a cluster are never farther apart than half
// of the sum of their weights' differences times the greatest distance between two of the guides at
// one vertex. In that measure, the first k strands have one within covering / sqrt(k + 1) of each
// other strand. The order is that of Gonzalez 1985, Clustering to Minimize the Maximum Intercluster
// Distance, but keeps away from edges too. If strands follow one guide, the measure of strands of
// different guides is greater by 2.
struct ClusterOrder {
    std::vector<std::uint32_t> strands;  // [triangle][place in the order]
    std::vector<float> coverings;  // [triangle]
};

// Takes a time proportional to the square of the density.
ClusterOrder
orderClusters(std::uint32_t seed, std::uint32_t triangles, const StrandSettings& settings);

// Returns the published program's random pairs, the same for every root triangle: [strand], in [0,
// 1), multiples of 2^-24. The host computes them, because the formula uses the last bits of sines,
// which differ too much between devices to give the same hair.
std::vector<glm::vec2> thesisRootPattern(std::uint32_t density);

}  // namespace hair::rendering
