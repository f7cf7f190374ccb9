#include "hair/rendering/lights.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/pipeline.h"
#include "hair/rendering/render_assets.h"

namespace hair::rendering {
namespace {

gpu::Light makeLight(const RenderSettings& render, const LightSettings& light) {
    gpu::Light result{
        .position = light.position,
        .type = gpu::kLightPoint,
        .to_light = {},
        .radius = 0.0f,
        .color = light.strength * workingColor(render, light.color),
        .reference_distance = light.reference_distance,
        .half_width = {},
        .half_height = {}};
    if (light.type == LightType::directional) {
        result.type = gpu::kLightDirectional;
        result.to_light = -glm::normalize(light.direction);
        result.radius = glm::radians(light.angular_radius);
        result.reference_distance = 0.0f;
    }
    if (light.type == LightType::sphere) {
        result.type = gpu::kLightSphere;
        result.radius = light.radius;
    }
    if (light.type == LightType::rectangle) {
        const RectangleFace face = rectangleFace(light);
        result.type = gpu::kLightRectangle;
        result.to_light = -face.normal;
        result.half_width = face.half_width;
        result.half_height = face.half_height;
        // In front of its middle, irradiance / pi is the radiance times the form factor.
        if (light.reference_distance > 0.0f)
            result.color /= static_cast<float>(rectangleFormFactor(light));
    }
    return result;
}

}  // namespace

static_assert(gpu::kNearDepth == engine::kNearDepth && gpu::kFarDepth == engine::kFarDepth);

glm::mat4 viewProjection(const CameraSettings& camera, float aspect) {
    // glm's depth is 0 at the first plane and 1 at the second.
    static_assert(engine::kFarDepth == 0.0f && engine::kNearDepth == 1.0f);
    glm::mat4 projection = glm::perspectiveRH_ZO(
        glm::radians(camera.field_of_view), aspect, camera.far_plane, camera.near_plane);
    projection[1][1] = -projection[1][1];
    return projection * glm::lookAtRH(camera.position, camera.target, camera.up);
}

RectangleFace rectangleFace(const LightSettings& light) {
    const glm::vec3 normal = glm::normalize(light.direction);
    glm::vec3 up = light.up - glm::dot(light.up, normal) * normal;
    if (glm::length(up) <= 1e-4f * glm::length(light.up)) up = glm::vec3(1, 0, 0);
    up = glm::normalize(up - glm::dot(up, normal) * normal);
    return {
        .normal = normal,
        .half_width = 0.5f * light.width * glm::cross(normal, up),
        .half_height = 0.5f * light.height * up};
}

double rectangleFormFactor(const LightSettings& light) {
    const double distance{light.reference_distance};
    const double x = 0.5 * double{light.width} / distance;
    const double y = 0.5 * double{light.height} / distance;
    const double by_x = std::sqrt(1.0 + x * x);
    const double by_y = std::sqrt(1.0 + y * y);
    return 2.0 / std::numbers::pi *
           (x / by_x * std::atan(y / by_x) + y / by_y * std::atan(x / by_y));
}

static_assert(offsetof(gpu::Light, half_width) == 48 && sizeof(gpu::Light) == 72);

std::vector<gpu::Light> makeLights(const Settings& settings) {
    std::vector<gpu::Light> lights;
    for (const LightSettings& light : settings.shading.lights)
        lights.push_back(makeLight(settings.render, light));
    return lights;
}

std::uint32_t shadowMaps(const LightSettings& light) {
    const bool sized = (light.type == LightType::sphere && light.radius > 0.0f) ||
                       light.type == LightType::rectangle ||
                       (light.type == LightType::directional && light.angular_radius > 0.0f);
    return sized && light.shadows ? light.shadow_samples : 1;
}

std::uint32_t lightKinds(const Settings& settings) {
    std::uint32_t kinds = 0;
    for (const LightSettings& light : settings.shading.lights)
        if (shadowMaps(light) > 1) kinds |= gpu::kSomeSampled;
    for (const gpu::Light& light : makeLights(settings)) {
        if (light.type == gpu::kLightRectangle) kinds |= gpu::kSomeRectangles | gpu::kSomeSpheres;
        if (light.type == gpu::kLightDirectional) kinds |= gpu::kSomeDirectional;
        const bool distant = light.type == gpu::kLightDirectional;
        if (light.type == gpu::kLightSphere || (distant && light.radius > 0.0f))
            kinds |= gpu::kSomeSpheres;
        if (light.reference_distance > 0.0f) kinds |= gpu::kSomeAttenuate;
    }
    return kinds;
}

}  // namespace hair::rendering
