#include "hair/rendering/strand_images.h"

namespace hair {

StrandTexture::StrandTexture(const engine::Device& device, const std::optional<engine::Pixels>&)
    : image_(
          device, {.format = VK_FORMAT_R8G8B8A8_UNORM,
                   .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                   .name = "strand texture"}),
      sampler_(device, {}) {
    device.runOnce([&](engine::Commands& commands) {
        commands.transition(
            image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            engine::Access::anything, engine::Access::graphics_read);
    });
}

}  // namespace hair
