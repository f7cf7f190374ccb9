#include "hair/rendering/strand_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/error.h"

namespace hair {

namespace {

constexpr std::uint32_t divideUp(std::uint32_t value, std::uint32_t divisor) {
    return (value + divisor - 1) / divisor;
}

std::uint32_t smallestFactor(std::uint32_t number) {
    for (std::uint32_t factor = 2; factor * factor <= number; ++factor)
        if (number % factor == 0) return factor;
    return number;
}

// As strands/lod.glsl has it, to the last bit.
float scaledCount(std::uint32_t count, float scale) {
    return std::max(static_cast<float>(count) * scale, 1.0f);
}

}  // namespace

std::uint32_t drawnStrands(std::uint32_t density, float scale) {
    return static_cast<std::uint32_t>(std::ceil(scaledCount(density, scale)));
}

DrawnPieces drawnPieces(std::uint32_t tessellation, float scale) {
    const float wanted = scaledCount(tessellation, scale);
    std::uint32_t count = tessellation;
    while (count > 1) {
        const std::uint32_t fewer = count / smallestFactor(count);
        if (wanted > static_cast<float>(fewer)) break;
        count = fewer;
    }
    return {.count = count, .morphs = wanted < static_cast<float>(count)};
}

StrandPlan planStrands(
    std::uint32_t triangles, std::uint32_t segments, const StrandSettings& strands,
    const LodSettings& lod, std::uint32_t isoline_limit) {
    StrandPlan plan;
    plan.triangles = triangles;
    plan.segments = segments;
    plan.density = strands.density;
    plan.tessellation = strands.tessellation;
    plan.lod_mode = lod.mode;
    plan.forced_level = lod.mode == LodMode::forced ? lod.level : 0.0f;
    plan.forced_scale = std::exp2(-plan.forced_level);
    const DrawnPieces pieces = drawnPieces(strands.tessellation, plan.forced_scale);
    plan.forced_density = drawnStrands(strands.density, plan.forced_scale);
    plan.forced_tessellation = pieces.count;
    plan.morphs = lod.mode == LodMode::distance || pieces.morphs;
    plan.patches_per_triangle = divideUp(plan.forced_density, isoline_limit);
    plan.strands_per_patch = divideUp(plan.forced_density, plan.patches_per_triangle);
    return plan;
}

StrandPlan
planStrands(const StrandView& view, const Settings& settings, std::uint32_t isoline_limit) {
    if (settings.strands.collision_rule && view.contacts == 0)
        throw engine::Error(
            "/strands/collision_rule", "is set, but it is not known where guides touch bodies");
    const std::uint32_t segments = view.vertices_per_guide - 1;
    if (settings.strands.source == StrandSource::root_triangles)
        return planStrands(
            view.triangle_count, segments, settings.strands, settings.lod, isoline_limit);
    StrandSettings strands = settings.strands;
    strands.density = view.bound_strand_count;
    return planStrands(1, segments, strands, settings.lod, 1);
}

std::uint32_t StrandPlan::verticesPerPatch() const {
    return strands_per_patch * (forced_tessellation + 1);
}

std::uint64_t StrandPlan::strands() const { return std::uint64_t{triangles} * forced_density; }

std::uint64_t StrandPlan::drawnSegments() const {
    return strands() * segments * forced_tessellation;
}

ExpectedCounts expectedCounts(const StrandPlan& plan) {
    ExpectedCounts counts{.tessellation_control_patches = plan.patches()};
    if (plan.lod_mode == LodMode::distance) return counts;
    counts.tessellation_evaluation_invocations =
        plan.strands() * plan.segments * (plan.forced_tessellation + 1);
    counts.geometry_invocations = plan.drawnSegments();
    counts.geometry_primitives = 2 * plan.drawnSegments();  // a quad is a strip of two triangles
    return counts;
}

std::vector<engine::Draw>
planDraws(const StrandPlan& plan, Submission submission, std::uint32_t max_vertices) {
    const std::uint32_t patches_per_draw = max_vertices / plan.verticesPerPatch();
    assert(patches_per_draw > 0);
    const bool instanced = submission == Submission::instanced;
    const std::uint32_t patches = instanced ? plan.segments : plan.patches();
    const std::uint32_t instances = instanced ? plan.triangles * plan.patches_per_triangle : 1;
    std::vector<engine::Draw> draws;
    for (std::uint32_t first = 0; first < patches; first += patches_per_draw) {
        draws.push_back(
            {.vertices = std::min(patches_per_draw, patches - first),
             .instances = instances,
             .first_vertex = first});
        if (patches - first <= patches_per_draw)
            break;  // first may overflow on devices with no limit
    }
    return draws;
}

}  // namespace hair
