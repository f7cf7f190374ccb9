#pragma once

#include <memory>

#include "hair/rendering/strand_blend.h"
#include "hair/rendering/strand_view.h"

// The makers that the table in blends.cpp lists.
namespace hair {

struct BlendContext {
    const engine::Device& device;
    const Settings& settings;
    const engine::Target& target;
    const StrandView& view;  // for the sphere that strands can't leave
};

// Throws engine::Unsupported for what the device lacks.
std::unique_ptr<StrandBlend> makeBlend(const BlendContext& context);

// The nearest fragment is seen.
std::unique_ptr<StrandBlend> makeOpaqueBlend(const BlendContext& context);

// The nearest fragment, in a color that says what /render/show asks for.
std::unique_ptr<StrandBlend> makeShownBlend(const BlendContext& context);

// The nearest fragment of every sample; one covers as many as its alpha says.
std::unique_ptr<StrandBlend> makeSampleBlend(const BlendContext& context);

// A weighted mean of all fragments: McGuire and Bavoil 2013.
std::unique_ptr<StrandBlend> makeWeightedBlend(const BlendContext& context);

// All fragments in their order, from lists.
std::unique_ptr<StrandBlend> makeListBlend(const BlendContext& context);

// Nothing is seen: of StrandStages that end before raster.
std::unique_ptr<StrandBlend> makeDiscardedBlend();

// The pipeline of a pass that blends a fragment over every pixel of the target.
engine::GraphicsDescription
compositePipeline(const RenderSettings& render, const char* fragment_shader);

}  // namespace hair
