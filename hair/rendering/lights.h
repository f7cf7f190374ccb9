#pragma once

#include <cstdint>
#include <vector>

#include "hair/gpu_structs.h"
#include "hair/settings.h"

namespace hair {

// The lights as shaders read them, in the settings' order.
std::vector<gpu::Light> makeLights(const Settings& settings);

// kLightKinds of shading/options.glsl.
std::uint32_t lightKinds(const Settings& settings);

}  // namespace hair
