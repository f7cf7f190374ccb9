#pragma once

#include "hair/gpu_structs.h"
#include "hair/rendering/strand_plan.h"
#include "hair/rendering/strand_view.h"
#include "hair/settings.h"

namespace hair {

// What every shader of a picture reads. `plan` is the one that planStrands makes of the settings.
gpu::PictureParameters
pictureParameters(const Settings& settings, const StrandPlan& plan, const StrandView& view);

}  // namespace hair
