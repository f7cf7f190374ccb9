#pragma once

#include <optional>

#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/settings.h"

namespace hair::rendering {

// Resolves the rendered samples to the picture where they differ (engine::Resolve): the mean over
// MSAA samples and SSAA pixels (thesis 2.3.7). In linear light, the target's radiance() keeps the
// mean, and the tone map makes the picture from it. If an attachment resolves at the end of
// rendering, this pass is an empty rendering, so its time is that of the resolve.
class ResolvePass {
public:
    ResolvePass(
        const engine::Device& device, const RenderSettings& render,
        const engine::TargetDescription& target);

    engine::PassKind kind() const {
        return pipeline_ ? engine::PassKind::compute : engine::PassKind::graphics;
    }

    void record(engine::Commands& commands, const engine::Target& target) const;

private:
    std::optional<engine::ComputePipeline> pipeline_;  // absent: an attachment resolves
};

}  // namespace hair::rendering
