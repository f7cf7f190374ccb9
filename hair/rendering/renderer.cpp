#include "hair/rendering/renderer.h"

#include <span>

#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/lights.h"
#include "hair/rendering/picture_parameters.h"
#include "hair/rendering/strand_offsets.h"
#include "hair/rendering/target_description.h"
#include "hair/rendering/working_color.h"

namespace hair {

namespace {

engine::Buffer parameterBuffer(const engine::Device& device) {
    return {
        device,
        {.size = sizeof(gpu::PictureParameters),
         .usage = engine::Usage::upload,
         .name = "picture parameters"}};
}

std::vector<engine::SampledImage>
strandImages(const StrandTexture& texture, const ShadowPass& shadows) {
    std::vector<engine::SampledImage> images{texture.image()};
    images.insert(images.end(), shadows.images().begin(), shadows.images().end());
    return images;
}

}  // namespace

Renderer::Renderer(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    const RenderAssets& assets, const StrandStages& stages)
    : settings_(settings),
      plan_(planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)),
      target_(device, targetDescription(settings.render)),
      parameters_{parameterBuffer(device), parameterBuffer(device)},
      lights_(
          engine::makeBuffer(device, std::span<const gpu::Light>(makeLights(settings)), "lights")),
      optics_(device, settings), shadows_(device, settings, plan_, assets),
      environment_(device, settings, assets), meshes_(device, settings, assets),
      texture_(device, settings.render, assets.strand_texture),
      strand_images_(strandImages(texture_, shadows_)),
      strands_(device, settings, plan_, target_, view, stages), overlay_(device, settings, assets),
      resolve_(device, settings.render, target_.description()) {
    if (settings.render.hair && hasOffsets(settings.strands)) frames_.emplace(device, view);
}

void Renderer::record(engine::Passes& passes, const StrandView& view) {
    const gpu::PictureParameters picture_parameters = pictureParameters(
        settings_, plan_, view,
        {.guide_normals = frames_ ? frames_->normals().address() : 0,
         .lights = lights_.address(),
         .optics = optics_.address(),
         .shadows = shadows_.address(passes.slot()),
         .environment = environment_.address(),
         .fragments = strands_.fragments()});
    const engine::Buffer& parameters = parameters_[passes.slot()];
    parameters.write(picture_parameters);
    const std::uint64_t picture = parameters.address();
    const glm::vec3 background = workingColor(settings_.render, settings_.render.background);

    if (frames_) {
        passes.pass("frames", engine::PassKind::compute, [&](engine::Commands& commands) {
            frames_->record(commands, view);
        });
    }
    shadows_.record(passes, meshes_, view, picture_parameters);
    passes.pass("scene", engine::PassKind::graphics, [&](engine::Commands& commands) {
        target_.beginRendering(
            commands, engine::Load::clear, {background.r, background.g, background.b});
        meshes_.draw(commands, picture, shadows_.images());
        environment_.draw(commands, picture);
        target_.endRendering(commands);
    });
    if (settings_.render.hair) strands_.record(passes, target_, picture, strand_images_);
    if (!overlay_.empty()) {
        passes.pass("overlay", engine::PassKind::graphics, [&](engine::Commands& commands) {
            target_.beginRendering(commands, engine::Load::keep, {});
            overlay_.draw(commands, picture, view);
            target_.endRendering(commands);
        });
    }
    passes.pass("resolve", engine::PassKind::compute, [&](engine::Commands& commands) {
        resolve_.record(commands, target_);
    });
}

}  // namespace hair
