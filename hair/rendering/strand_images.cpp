#include "hair/rendering/strand_images.h"

#include "hair/rendering/working_color.h"

namespace hair {

StrandTexture::StrandTexture(
    const engine::Device& device, const RenderSettings& settings,
    const std::optional<engine::Pixels>& pixels)
    : texture_(
          device, pixels.value_or(engine::Pixels{1, 1, {255, 255, 255, 255}}),
          engine::Texels::display_color,
          hasLinearLight(settings) ? engine::Decoding::linear : engine::Decoding::none,
          "strand texture"),
      sampler_(
          device, {.horizontal = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                   .vertical = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}) {}

}  // namespace hair
