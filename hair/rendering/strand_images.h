#pragma once

#include <cstdint>
#include <optional>

#include "engine/commands.h"
#include "engine/sampler.h"
#include "engine/texture.h"
#include "hair/settings.h"

namespace hair {

// What fragment shaders of strands sample, at these bindings: the strands' texture, then
// ShadowPass::images().
inline constexpr std::uint32_t kStrandImages = 4;

// The picture on strands, on the device, for strands/texture.glsl: its colours become working
// colours. One white pixel where there is none.
class StrandTexture {
public:
    StrandTexture(
        const engine::Device& device, const RenderSettings& settings,
        const std::optional<engine::Pixels>& pixels);

    engine::SampledImage image() const { return {&texture_.image(), &sampler_}; }

private:
    engine::Texture texture_;
    engine::Sampler sampler_;
};

}  // namespace hair
