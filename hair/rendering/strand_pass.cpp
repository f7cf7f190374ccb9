#include "hair/rendering/strand_pass.h"

#include "hair/rendering/shading_constants.h"
#include "hair/rendering/strand_images.h"
#include "hair/rendering/target_description.h"

namespace hair {

StrandPass::StrandPass(
    const engine::Device& device, const Settings& settings, const StrandPlan& plan,
    const engine::Target&)
    : backend_(makeBackend(
          settings.strands.backend,
          {.device = device,
           .plan = plan,
           .strands = settings.strands,
           .output = {
               .fragment = "strands/strand.frag",
               .colors = {{colorFormat(settings.render)}},
               .samples = settings.render.msaa,
               .shading = shadingConstants(settings),
               .sampled_images = kStrandImages}})) {}

void StrandPass::record(
    engine::Passes& passes, const engine::Target& target, std::uint64_t picture,
    std::span<const engine::SampledImage> images) const {
    passes.pass("strands", engine::PassKind::graphics, [&](engine::Commands& commands) {
        target.beginRendering(commands, engine::Load::keep, {});
        backend_->draw(commands, picture, images);
        target.endRendering(commands);
    });
}

}  // namespace hair
