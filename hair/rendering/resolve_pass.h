#pragma once

#include "engine/pipeline.h"
#include "engine/target.h"

namespace hair {

// Rendered samples -> the picture: the mean over MSAA samples and SSAA pixels (thesis 2.3.7).
class ResolvePass {
public:
    ResolvePass(const engine::Device& device, const engine::TargetDescription& target);

    void record(engine::Commands& commands, const engine::Target& target) const;

private:
    engine::ComputePipeline pipeline_;
};

}  // namespace hair
