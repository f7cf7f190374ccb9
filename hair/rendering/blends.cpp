#include "hair/rendering/blends.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "hair/gpu_structs.h"
#include "hair/rendering/target_description.h"

namespace hair {

namespace {

struct BlendRow {
    Transparency transparency;
    std::unique_ptr<StrandBlend> (*make)(const BlendContext&);
};

// All kinds of transparency, one row each.
constexpr std::array kBlends{
    BlendRow{Transparency::none, makeOpaqueBlend},
    BlendRow{Transparency::alpha_to_coverage, makeSampleBlend},
    BlendRow{Transparency::weighted_blended, makeWeightedBlend},
    BlendRow{Transparency::fragment_list, makeListBlend},
};

}  // namespace

std::unique_ptr<StrandBlend> makeBlend(const BlendContext& context) {
    if (context.settings.render.show != Show::shading) return makeShownBlend(context);
    const auto row =
        std::ranges::find(kBlends, context.settings.render.transparency, &BlendRow::transparency);
    assert(row != kBlends.end());
    return row->make(context);
}

engine::GraphicsDescription
compositePipeline(const RenderSettings& render, const char* fragment_shader) {
    return {
        .shaders = {"composite/screen.vert", fragment_shader},
        .push_size = sizeof(gpu::CompositePush),
        .colors = {{colorFormat(render), engine::Blend::over}},
        .depth_format = engine::Target::kDepthFormat,
        .samples = render.msaa,
        .depth_compare = VK_COMPARE_OP_ALWAYS,
        .depth_write = false};
}

}  // namespace hair
