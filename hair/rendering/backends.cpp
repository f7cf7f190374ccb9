#include "hair/rendering/backends.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "engine/target.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/strand_offsets.h"

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

constexpr std::size_t kFirstShadingConstant = 16;  // in shading/options.glsl

}  // namespace

std::unique_ptr<StrandBackend> makeBackend(Backend backend, const BackendContext& context) {
    const auto row = std::ranges::find(kBackends, backend, &BackendRow::backend);
    assert(row != kBackends.end());
    return row->make(context);
}

engine::Constants strandConstants(const StrandSettings& strands, LodMode lod_mode) {
    return {
        static_cast<std::uint32_t>(strands.curve),
        static_cast<std::uint32_t>(strands.taper),
        static_cast<std::uint32_t>(lod_mode),
        static_cast<std::uint32_t>(strands.source),
        static_cast<std::uint32_t>(strands.width),
        hasOffsets(strands) ? 1u : 0u,
        static_cast<std::uint32_t>(strands.interpolation),
        strands.collision_rule ? 1u : 0u,
        static_cast<std::uint32_t>(strands.randomness)};
}

engine::GraphicsDescription strandPipeline(const BackendContext& context) {
    const StrandOutput& output = context.output;
    engine::Constants constants = strandConstants(context.strands, context.plan.lod_mode);
    assert(constants.size() <= kFirstShadingConstant);
    constants.resize(kFirstShadingConstant);
    constants.insert(constants.end(), output.shading.begin(), output.shading.end());
    return {
        .constants = constants,
        .push_size = sizeof(gpu::StrandPush),
        .colors = output.colors,
        .depth_format = output.depth_format,
        .samples = output.samples,
        .depth_write = output.depth_write,
        .alpha_to_coverage = output.alpha_to_coverage,
        .sampled_images = output.sampled_images};
}

}  // namespace hair
