#include "hair/rendering/shading_constants.h"

#include "hair/rendering/lights.h"
#include "hair/rendering/working_color.h"
#include "hair/shader_codes.h"

namespace hair {

engine::Constants shadingConstants(const Settings& settings) {
    const ShadingSettings& shading = settings.shading;
    const RenderSettings& render = settings.render;
    return {
        {gpu::kModelConstant, shaderCode(shading.model)},
        {gpu::kLightCountConstant, static_cast<std::uint32_t>(shading.lights.size())},
        {gpu::kMeshShadowsConstant, shading.shadows.meshes},
        {gpu::kHairShadowsConstant, shading.shadows.hair != HairShadows::none},
        {gpu::kEnvironmentConstant, !render.environment.empty()},
        {gpu::kLinearLightConstant, hasLinearLight(render)},
        {gpu::kAnalyticCoverageConstant,
         render.coverage == Coverage::analytic && render.show == Show::shading},
        {gpu::kStrandTextureConstant, !settings.strands.texture.empty()},
        {gpu::kShowConstant, shaderCode(render.show)},
        {gpu::kLightKindsConstant, lightKinds(settings)}};
}

}  // namespace hair
