#pragma once

#include <cstdint>

#include "engine/buffer.h"
#include "engine/commands.h"
#include "engine/pipeline.h"
#include "hair/rendering/strand_view.h"

namespace hair {

// Frames along the guides that don't turn about them, for the offsets of strands. They start at the
// root with what the groom has at rest, turned as little as the guide's direction there has turned:
// as long as that isn't reversed they move without a jump.
class FramesPass {
public:
    // `view` gives the counts.
    FramesPass(const engine::Device& device, const StrandView& view);

    // After what moved the guides; before what draws.
    void record(engine::Commands& commands, const StrandView& view) const;

    // vec3 [guide][vertex], unit length, across the guide.
    const engine::Buffer& normals() const { return normals_; }

private:
    engine::ComputePipeline pipeline_;
    engine::Buffer normals_;
};

}  // namespace hair
