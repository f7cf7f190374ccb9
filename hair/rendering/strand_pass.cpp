#include "hair/rendering/strand_pass.h"

#include "hair/rendering/blends.h"
#include "hair/rendering/shading_constants.h"
#include "hair/rendering/strand_images.h"

namespace hair {

namespace {

StrandOutput shaded(StrandOutput output, const Settings& settings) {
    output.shading = shadingConstants(settings);
    output.sampled_images = kStrandImages;
    return output;
}

std::unique_ptr<StrandBlend> blendOf(const BlendContext& context, const StrandStages& stages) {
    return stages.last && discards(stages) ? makeDiscardedBlend() : makeBlend(context);
}

}  // namespace

StrandPass::StrandPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const engine::Target& target, const StrandView& view, const StrandStages& stages)
    : blend_(blendOf(
          {.device = device, .settings = settings, .target = target, .view = view}, stages)),
      backend_(makeBackend(
          settings.strands.backend, {.device = device,
                                     .plan = plan,
                                     .strands = settings.strands,
                                     .output = shaded(blend_->output(), settings),
                                     .stages = stages})) {}

void StrandPass::record(
    engine::Passes& passes, const engine::Target& target, std::uint64_t picture,
    std::span<const engine::SampledImage> images) const {
    blend_->record(passes, target, [&](engine::Commands& commands) {
        backend_->draw(commands, picture, images);
    });
}

}  // namespace hair
