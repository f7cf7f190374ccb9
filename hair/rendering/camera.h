#pragma once

#include <glm/mat4x4.hpp>

#include "hair/settings.h"

namespace hair {

// World -> Vulkan clip space: y down, depth 0 at the near plane and 1 at the far plane.
glm::mat4 viewProjection(const CameraSettings& camera, float aspect);

}  // namespace hair
