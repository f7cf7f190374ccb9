#include "hair/rendering/renderer.h"

#include "hair/gpu_structs.h"
#include "hair/rendering/picture_parameters.h"
#include "hair/rendering/strand_offsets.h"

namespace hair {

namespace {

engine::TargetDescription targetDescription(const RenderSettings& render) {
    return {
        .width = render.width, .height = render.height, .msaa = render.msaa, .ssaa = render.ssaa};
}

engine::Buffer parameterBuffer(const engine::Device& device) {
    return {
        device,
        {.size = sizeof(gpu::PictureParameters),
         .usage = engine::Usage::upload,
         .name = "picture parameters"}};
}

}  // namespace

Renderer::Renderer(
    const engine::Device& device, const Settings& settings, const StrandView& view,
    const Mesh* mesh)
    : settings_(settings),
      plan_(planStrands(view, settings, device.info().limits.maxTessellationGenerationLevel)),
      target_(device, targetDescription(settings.render)),
      parameters_{parameterBuffer(device), parameterBuffer(device)},
      backend_(makeBackend(
          settings.strands.backend, {device, plan_, settings_.strands, settings_.render.msaa})),
      overlay_(device, settings.render.overlays, settings.render.msaa),
      resolve_(device, target_.description()) {
    if (settings.render.hair && hasOffsets(settings.strands)) frames_.emplace(device, view);
    if (mesh && settings.render.head) mesh_.emplace(device, *mesh, settings.render.msaa);
}

void Renderer::record(engine::Passes& passes, const StrandView& view) {
    const engine::Buffer& parameters = parameters_[passes.slot()];
    parameters.write(
        pictureParameters(settings_, plan_, view, frames_ ? frames_->normals().address() : 0));
    const std::uint64_t picture = parameters.address();
    const glm::vec3 background = settings_.render.background;

    if (frames_) {
        passes.pass("frames", engine::PassKind::compute, [&](engine::Commands& commands) {
            frames_->record(commands, view);
        });
    }
    const auto render = [&](const char* name, engine::Load load, const auto& draw) {
        passes.pass(name, engine::PassKind::graphics, [&](engine::Commands& commands) {
            target_.beginRendering(commands, load, {background.r, background.g, background.b});
            draw(commands);
            target_.endRendering(commands);
        });
    };
    render("scene", engine::Load::clear, [&](engine::Commands& commands) {
        if (mesh_) mesh_->draw(commands, picture);
    });
    if (settings_.render.hair) {
        render("strands", engine::Load::keep, [&](engine::Commands& commands) {
            backend_->draw(commands, picture);
        });
    }
    if (!overlay_.empty()) {
        render("overlay", engine::Load::keep, [&](engine::Commands& commands) {
            overlay_.draw(commands, picture, view);
        });
    }
    passes.pass("resolve", engine::PassKind::compute, [&](engine::Commands& commands) {
        resolve_.record(commands, target_);
    });
}

}  // namespace hair
