#pragma once

#include <cstdint>

#include "engine/buffer.h"
#include "engine/device.h"
#include "hair/groom/groom.h"
#include "hair/groom/strand_set.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// What rendering reads of a groom and does not change, on the device.
class GroomBuffers {
public:
    // `model` is what settings.strands.offsets names, null if that is empty. Throws engine::Error
    // as checkStrands and makeStrandOffsets do.
    GroomBuffers(
        const engine::Device& device, const Groom& groom, const Settings& settings,
        const StrandSet* model);

    // Lacks the guides' address and the head's motion.
    const StrandView& view() const { return view_; }

private:
    engine::Buffer root_triangles_;
    engine::Buffer root_normals_;
    engine::Buffer widths_;
    engine::Buffer bound_strands_;  // gpu::BoundStrand
    engine::Buffer root_pattern_;
    engine::Buffer root_frames_;  // gpu::RootFrame
    engine::Buffer offsets_;
    StrandView view_;
};

// Whether the groom has what the strands are to be drawn with. Throws engine::Error
// "<JSON pointer>: <reason>".
void checkStrands(const StrandSettings& settings, const Groom& groom);

}  // namespace hair
