#include "hair/rendering/lights.h"

#include <cstddef>

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
        .reference_distance = light.reference_distance};
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

static_assert(offsetof(gpu::Light, color) == 32 && sizeof(gpu::Light) == 48);

std::vector<gpu::Light> makeLights(const Settings& settings) {
    std::vector<gpu::Light> lights;
    for (const LightSettings& light : settings.shading.lights)
        lights.push_back(makeLight(settings.render, light));
    return lights;
}

std::uint32_t lightKinds(const Settings& settings) {
    std::uint32_t kinds = 0;
    for (const gpu::Light& light : makeLights(settings)) {
        if (light.type == gpu::kLightDirectional) kinds |= gpu::kSomeDirectional;
        const bool distant = light.type == gpu::kLightDirectional;
        if (light.type == gpu::kLightSphere || (distant && light.radius > 0.0f))
            kinds |= gpu::kSomeSpheres;
        if (light.reference_distance > 0.0f) kinds |= gpu::kSomeWeaken;
    }
    return kinds;
}

}  // namespace hair::rendering
