#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/device.h"
#include "engine/image_file.h"
#include "engine/sampler.h"
#include "engine/image.h"
#include "engine/commands.h"

namespace hair {

// What fragment shaders of strands sample, at these bindings: the strands' texture, then
// ShadowPass::images().
inline constexpr std::uint32_t kStrandImages = 4;

// The picture on strands, on the device; one white pixel where there is none.
class StrandTexture {
public:
    StrandTexture(const engine::Device& device, const std::optional<engine::Pixels>& pixels);

    engine::SampledImage image() const { return {&image_, &sampler_}; }

private:
    engine::Image image_;
    engine::Sampler sampler_;
};

}  // namespace hair
