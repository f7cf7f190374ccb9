#pragma once

#include "engine/pipeline.h"
#include "hair/settings.h"

namespace hair {

// The specialization constants of shaders/shading/options.glsl.
engine::Constants shadingConstants(const Settings& settings);

}  // namespace hair
