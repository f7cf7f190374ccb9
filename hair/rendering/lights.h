#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

#include "hair/gpu_structs.h"
#include "hair/settings.h"

namespace hair::rendering {

// World -> Vulkan clip space: y down, depth 0 at the near plane and 1 at the far plane.
glm::mat4 viewProjection(const CameraSettings& camera, float aspect);

// The lights as shaders read them, in the settings' order.
std::vector<gpu::Light> makeLights(const Settings& settings);

// kLightKinds of shading/options.glsl.
std::uint32_t lightKinds(const Settings& settings);

}  // namespace hair::rendering
