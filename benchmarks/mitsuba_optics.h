#pragma once

#include <glm/vec3.hpp>

#include "hair/settings.h"

// What a scene's lights mean to a path tracer, which has linear RGB and units: a light's colour is
// the radiance of a white matt surface that faces it. Where ours does not weaken with distance,
// theirs does, and they agree at `target`.
namespace benchmarks {

// Linear RGB, with the strength.
glm::dvec3 lightColor(const hair::RenderSettings& render, const hair::LightSettings& light);

// Radiant intensity of a point light of a linear colour.
glm::dvec3
lightIntensity(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target);

// Radiance of the surface of a sphere of light.
glm::dvec3
lightRadiance(const hair::LightSettings& light, const glm::dvec3& color, const glm::dvec3& target);

}  // namespace benchmarks
