#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/commands.h"
#include "hair/groom/groom.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/settings.h"

// How many strands a picture draws, in which draws and at which level of detail.
namespace hair::rendering {

constexpr std::uint32_t divideUp(std::uint32_t value, std::uint32_t divisor) {
    return (value + divisor - 1) / divisor;
}

// How many strands, patches and vertices a picture draws, and by which draws: thesis 2.3.5. The
// strands of a groom are those of one triangle, each a patch of its own in every guide segment.
struct StrandPlan {
    std::uint32_t triangles = 0;
    std::uint32_t segments = 0;  // guide segments per guide
    std::uint32_t density = 0;  // strands per root triangle at level 0
    std::uint32_t tessellation = 0;  // drawn segments per guide segment at level 0
    // Most strands that are drawn: those of the forced level, or in LodMode::distance of level 0.
    std::uint32_t forced_density = 0;
    std::uint32_t forced_tessellation = 0;
    float forced_level = 0.0f;  // 0 in LodMode::distance
    float forced_scale = 1.0f;  // 2^-forced_level
    bool morphs = false;  // ends of drawn segments may be off their curve: drawnPieces
    std::uint32_t patches_per_triangle = 0;  // per guide segment
    std::uint32_t strands_per_patch = 0;
    LodMode lod_mode = LodMode::forced;
    bool residuals = false;  // strands of the groom have them
    bool skinned = false;  // roots follow the triangles of a mesh that deforms
    bool merged_hairs = false;  // strands of coarser levels are drawn as those they stand for
    bool own_colors = false;  // strands differ in color
    float reach = 0.0f;  // m, how far offsets move points of strands
    float greatest_width = 0.0f;  // m, at level 0 of detail; with gaps between merged hairs

    // Patches of the whole picture, numbered [triangle][part][segment].
    std::uint32_t patches() const { return triangles * patches_per_triangle * segments; }
    // Most vertices that one patch tessellates to.
    std::uint32_t verticesPerPatch() const;
    // Drawn strands and their drawn segments; at LodMode::distance those of level 0.
    std::uint64_t strands() const;
    std::uint64_t drawnSegments() const;
};

// Strands that are drawn of a root triangle at a level of detail, scale = 2^-level: the last one is
// as wide as the fraction, so that none comes or goes with a jump. At least 1.
std::uint32_t drawnStrands(std::uint32_t density, float scale);

// Drawn segments per guide segment at a level of detail: the coarsest of the nested sets that has
// at least tessellation * scale. Each set has as many times fewer than the one before as that
// number's smallest factor, down to 1; a prime number has none between it and 1.
struct DrawnPieces {
    std::uint32_t count = 1;
    bool morphs = false;  // ends that the next set lacks are on their way to its lines
};
DrawnPieces drawnPieces(std::uint32_t tessellation, float scale);

// `isoline_limit` is the device's maxTessellationGenerationLevel: a denser triangle takes several
// patches. 0, of a device without tessellation: one patch takes them all.
StrandPlan planStrands(
    std::uint32_t triangles, std::uint32_t segments, const StrandSettings& strands,
    const LodSettings& lod, std::uint32_t isoline_limit);

// The plan of the strands that the settings ask for. Throws engine::Error "<JSON pointer>:
// <reason>" where the view lacks what they need.
StrandPlan
planStrands(const StrandView& view, const Settings& settings, std::uint32_t isoline_limit);

// What the pipeline statistics must say of the strands' draws. Absent where only the device knows.
struct ExpectedCounts {
    std::uint64_t tessellation_control_patches = 0;
    std::optional<std::uint64_t> tessellation_evaluation_invocations;
    std::optional<std::uint64_t> geometry_invocations;
    std::optional<std::uint64_t> geometry_primitives;
};
ExpectedCounts expectedCounts(const StrandPlan& plan);

// Draws of one vertex per patch such that no draw, counted per instance, tessellates to more than
// `max_vertices`. Patch index = instance * segments + vertex in all of them.
std::vector<engine::Draw>
planDraws(const StrandPlan& plan, Submission submission, std::uint32_t max_vertices);

// How many times wider strands may become in LodMode::distance, 1 or more.
//
// Strands thrown at random cover 1 - exp(-a) of what is behind them, a the sum of their areas over
// that area: fewer and wider ones of the same sum cover as much. But they stick out: hair of area A
// and outline P becomes A + P (s - 1) w / 2 where strands of width w are s times as wide (Steiner's
// formula, without its term in the square). With P / A = 2 / R of a disc as large as the hair that
// is (s - 1) w / R more, and it may be kOutlineGrowth.
float greatestWidthScale(const groom::Groom& groom, const StrandSettings& settings);

inline constexpr float kOutlineGrowth = 0.03f;

// What LodMode::distance makes of a head of hair, seen from /camera/position.
struct DistanceLod {
    double mean_level = 0.0;  // over root triangles, or over the strands of a groom
    std::optional<std::uint64_t> strands;  // drawn; absent where the device orders them
};

// `guides` are the points of the guides now, [guide][vertex], m; `view` is theirs.
DistanceLod distanceLod(
    const groom::Groom& groom, std::span<const glm::vec3> guides, const StrandView& view,
    const Settings& settings);

// The published program's random pairs, which every root triangle has alike: [strand], in [0, 1),
// multiples of 2^-24. They are made here, for the sines of devices are too different to give the
// same hair: the formula takes the last bits of them.
std::vector<glm::vec2> thesisRootPattern(std::uint32_t density);

}  // namespace hair::rendering
