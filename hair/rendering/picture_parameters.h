#pragma once

#include <cstdint>

#include "hair/gpu_structs.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// What every shader of a picture reads. `plan` is the one that planStrands makes of the settings;
// `guide_normals` is the address of FramesPass::normals(), or 0 where strands are not offset.
gpu::PictureParameters pictureParameters(
    const Settings& settings, const StrandPlan& plan, const StrandView& view,
    std::uint64_t guide_normals);

}  // namespace hair
