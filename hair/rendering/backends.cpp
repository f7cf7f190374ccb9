#include "hair/rendering/backends.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "engine/error.h"
#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/shader_codes.h"

namespace hair {

namespace {

struct BackendRow {
    Backend backend;
    std::unique_ptr<StrandBackend> (*make)(const BackendContext&);
};

// All back ends, one row each.
constexpr std::array kBackends{
    BackendRow{Backend::tessellation, makeTessellationBackend},
    BackendRow{Backend::pulling_geometry, makePullingGeometryBackend},
};

constexpr std::uint32_t pushSize(const StrandStages& stages) {
    return stages.watched ? std::uint32_t{sizeof(gpu::WatchedPush)}
                          : std::uint32_t{sizeof(gpu::StrandPush)};
}

}  // namespace

std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context) {
    const auto row = std::ranges::find(kBackends, backend, &BackendRow::backend);
    assert(row != kBackends.end());
    if (!context.stages.last) return makeEmptyBackend();
    if (backend != Backend::tessellation && context.stages != StrandStages{})
        throw engine::Unsupported("/strands/backend", "only tessellation's stages can be left out");
    return row->make(context);
}

engine::Constants strandConstants(const StrandSettings& strands, const StrandPlan& plan) {
    return {
        {gpu::kCurveConstant, shaderCode(strands.curve)},
        {gpu::kTaperConstant, shaderCode(strands.taper)},
        {gpu::kLodModeConstant, shaderCode(plan.lod_mode)},
        {gpu::kSourceConstant, shaderCode(strands.source)},
        {gpu::kWidthConstant, shaderCode(strands.width)},
        {gpu::kOffsetsConstant, hasOffsets(strands)},
        {gpu::kInterpolationConstant, shaderCode(strands.interpolation)},
        {gpu::kCollisionRuleConstant, strands.collision_rule},
        {gpu::kRandomnessConstant, shaderCode(strands.randomness)},
        {gpu::kLodMorphConstant, plan.morphs}};
}

engine::GraphicsDescription strandPipeline(const BackendContext& context) {
    const StrandOutput& output = context.output;
    const StrandStages& stages = context.stages;
    std::vector<engine::ColorTarget> colors = output.colors;
    if (stages.last != StrandStage::fragment)
        for (engine::ColorTarget& color : colors) color.blend = engine::Blend::keep;
    engine::Constants constants = strandConstants(context.strands, context.plan);
    constants.emplace_back(gpu::kPixelSamplesConstant, output.samples);
    constants.insert(constants.end(), output.shading.begin(), output.shading.end());
    return {
        .constants = constants,
        .push_size = pushSize(stages),
        .colors = colors,
        .depth_format = output.depth_format,
        .samples = output.samples,
        .depth_write = output.depth_write,
        .discard = discards(stages),
        .sampled_images = output.sampled_images};
}

}  // namespace hair
