#pragma once

#include <glm/vec3.hpp>

#include "hair/settings.h"

// What a scene's colours, which are display RGB, mean to a path tracer, which has linear RGB.
namespace benchmarks {

// sRGB's transfer curve (IEC 61966-2-1), which goes on above 1.
glm::dvec3 toLinear(const glm::dvec3& display);

// Absorption over a radius of a fibre, for which much hair has this linear colour when light
// scatters in it again and again: Chiang et al. 2016, A practical and controllable hair and fur
// model for production path tracing, equation (9). Colours below 1e-4 count as 1e-4.
glm::dvec3 absorptionOf(const glm::dvec3& color, double azimuthal_roughness);

// Radiant intensity of a point light. The scenes' light does not weaken with distance; this one
// does, and lights a white matt surface that faces it at `target` to a radiance of its colour.
glm::dvec3 lightIntensity(const hair::LightSettings& light, const glm::dvec3& target);

}  // namespace benchmarks
