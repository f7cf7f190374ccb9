#pragma once

#include <glm/vec3.hpp>

#include "hair/shading_settings.h"

// The colour of much hair and the absorption in a fibre, which make each other: Chiang et al. 2016,
// A practical and controllable hair and fur model for production path tracing, equation (9).
namespace hair {

// sigma_a, over a radius of a fibre, of red, green and blue: from the pigments, or that for which
// much hair has /shading/color. Linear colours below 1e-4 count as 1e-4.
glm::dvec3 absorption(const ShadingSettings& shading);

// The linear RGB that much hair has.
glm::dvec3 linearColor(const ShadingSettings& shading);

}  // namespace hair
