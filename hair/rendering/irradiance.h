#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "engine/image_file.h"

namespace hair {

// Spherical harmonics of irradiance / pi under a latitude-longitude picture of light, turned by so
// many radians about +y: l = 0 to 2, m = -l to l, real and orthonormal as in Ramamoorthi and
// Hanrahan 2001, An Efficient Representation for Irradiance Environment Maps (their eq. 3).
// shaders/environment/radiance.glsl says which way the picture lies round +y.
std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn);

}  // namespace hair
