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

// The face of a rectangle light.
struct RectangleFace {
    glm::vec3 normal;  // unit length; the direction of its light
    glm::vec3 half_width;  // m, from the middle of the face to the middle of a side
    glm::vec3 half_height;  // m
};

RectangleFace rectangleFace(const LightSettings& light);

// Returns irradiance / pi, for a radiance of 1, on a surface that faces a rectangle's middle at its
// reference_distance. It is the form factor of a rectangle and a parallel element on its axis: four
// times that of an element in front of a corner (Howell, Menguec, Daun and Siegel, Thermal
// Radiation Heat Transfer).
double rectangleFormFactor(const LightSettings& light);

// Number of shadow maps of each kind that a light has, if there are shadows. 1 without a size.
std::uint32_t shadowMaps(const LightSettings& light);

// The value of kLightKinds in shading/options.glsl.
std::uint32_t lightKinds(const Settings& settings);

}  // namespace hair::rendering
