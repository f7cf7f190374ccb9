#pragma once

#include <optional>

#include "engine/frame_loop.h"
#include "engine/pipeline.h"
#include "engine/target.h"
#include "hair/settings.h"

namespace hair::rendering {

// Rendered samples -> the picture, where it is not what is rendered (engine::Resolve): the mean
// over MSAA samples and SSAA pixels (thesis 2.3.7). Of linear light the mean is kept as the
// target's radiance(), and the picture is what the tone map makes of it. Where rendering's end
// resolves, this is a rendering of nothing: what it takes is what the resolve does.
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
    std::optional<engine::ComputePipeline> pipeline_;  // none: by an attachment
};

}  // namespace hair::rendering
