#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

#include "hair/gpu_structs.h"
#include "hair/settings.h"

// The camera and the lights of a picture as shaders read them.
namespace hair::rendering {

// World -> Vulkan clip space: y down, depth from engine::kNearDepth to engine::kFarDepth.
glm::mat4 viewProjection(const CameraSettings& camera, float aspect);

// The lights as shaders read them, in the settings' order.
std::vector<gpu::Light> makeLights(const Settings& settings);

// The value of kLightKinds in shading/options.glsl.
std::uint32_t lightKinds(const Settings& settings);

}  // namespace hair::rendering
