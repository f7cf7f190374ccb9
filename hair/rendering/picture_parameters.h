#pragma once

#include <cstdint>

#include "hair/gpu_structs.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// Addresses of what else shaders read; 0 where they don't.
struct PictureBuffers {
    std::uint64_t guide_normals = 0;  // FramesPass::normals()
    std::uint64_t lights = 0;
    std::uint64_t optics = 0;
    std::uint64_t shadows = 0;
    std::uint64_t environment = 0;
    std::uint64_t fragments = 0;
};

// What every shader of a picture reads. `plan` is the one that planStrands makes of the settings.
gpu::PictureParameters pictureParameters(
    const Settings& settings, const StrandPlan& plan, const StrandView& view,
    const PictureBuffers& buffers);

}  // namespace hair
