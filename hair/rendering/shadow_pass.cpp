#include "hair/rendering/shadow_pass.h"

namespace hair {

namespace {

engine::Buffer parameterBuffer(const engine::Device& device) {
    return {
        device,
        {.size = sizeof(gpu::ShadowParameters),
         .usage = engine::Usage::upload,
         .name = "shadow parameters"}};
}

engine::Image onePixel(const engine::Device& device) {
    return {
        device, {.format = VK_FORMAT_R8G8B8A8_UNORM,
                 .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                 .name = "no shadow"}};
}

}  // namespace

ShadowPass::ShadowPass(const engine::Device& device, const Settings&, const StrandPlan&)
    : parameters_{parameterBuffer(device), parameterBuffer(device)}, sampler_(device, {}) {
    for (int i = 0; i < 3; ++i) atlases_.push_back(onePixel(device));
    device.runOnce([&](engine::Commands& commands) {
        for (const engine::Image& image : atlases_)
            commands.transition(
                image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                engine::Access::anything, engine::Access::graphics_read);
    });
    for (const engine::Image& image : atlases_) images_.push_back({&image, &sampler_});
}

void ShadowPass::record(
    engine::Passes& passes, const SceneMeshes&, const StrandView&, const gpu::PictureParameters&) {
    parameters_[passes.slot()].write(gpu::ShadowParameters{});
}

}  // namespace hair
