#include "hair/rendering/lights.h"

#include <cstddef>

#include "hair/rendering/working_color.h"

namespace hair {

static_assert(offsetof(gpu::Light, color) == 32 && sizeof(gpu::Light) == 48);

std::vector<gpu::Light> makeLights(const Settings& settings) {
    std::vector<gpu::Light> lights;
    for (const LightSettings& light : settings.shading.lights) {
        lights.push_back(
            {.position = light.position,
             .type = gpu::kLightPoint,
             .to_light = {},
             .radius = light.radius,
             .color = light.strength * workingColor(settings.render, light.color),
             .reference_distance = light.reference_distance});
    }
    return lights;
}

}  // namespace hair
