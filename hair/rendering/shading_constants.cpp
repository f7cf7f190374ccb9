#include "hair/rendering/shading_constants.h"

#include "hair/rendering/lights.h"
#include "hair/rendering/working_color.h"

namespace hair {

engine::Constants shadingConstants(const Settings& settings) {
    const ShadingSettings& shading = settings.shading;
    const RenderSettings& render = settings.render;
    return {
        static_cast<std::uint32_t>(shading.model),
        static_cast<std::uint32_t>(shading.lights.size()),
        shading.shadows.meshes ? 1u : 0u,
        shading.shadows.hair != HairShadows::none ? 1u : 0u,
        !render.environment.empty() ? 1u : 0u,
        hasLinearLight(render) ? 1u : 0u,
        render.coverage == Coverage::analytic && render.show == Show::shading ? 1u : 0u,
        !settings.strands.texture.empty() ? 1u : 0u,
        static_cast<std::uint32_t>(render.show),
        lightKinds(settings)};
}

}  // namespace hair
