#pragma once

#include <optional>

#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/settings.h"

namespace hair::rendering {

// Rendered samples -> the picture: the mean over MSAA samples and SSAA pixels (thesis 2.3.7). One
// sample a pixel of display colours is copied, which takes lavapipe 0.5 ms instead of 11. Of linear
// light the mean is kept as the target's radiance(), and the picture is what the tone map makes of
// it.
class ResolvePass {
public:
    ResolvePass(
        const engine::Device& device, const RenderSettings& render,
        const engine::TargetDescription& target);

    void record(engine::Commands& commands, const engine::Target& target) const;

private:
    std::optional<engine::ComputePipeline> pipeline_;  // none: a copy will do
};

}  // namespace hair::rendering
