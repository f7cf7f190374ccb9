#pragma once

#include <optional>

#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/settings.h"

namespace hair {

// Rendered samples -> the picture: the mean over MSAA samples and SSAA pixels (thesis 2.3.7). One
// sample a pixel is copied, which takes lavapipe 0.5 ms instead of 11.
class ResolvePass {
public:
    ResolvePass(
        const engine::Device& device, const RenderSettings& render,
        const engine::TargetDescription& target);

    void record(engine::Commands& commands, const engine::Target& target) const;

private:
    std::optional<engine::ComputePipeline> average_;  // none: one sample a pixel, a copy will do
};

}  // namespace hair
