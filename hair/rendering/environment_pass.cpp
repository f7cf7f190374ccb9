#include "hair/rendering/environment_pass.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include <glm/trigonometric.hpp>

#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/irradiance.h"
#include "hair/rendering/target_description.h"

namespace hair {

namespace {

static_assert(offsetof(gpu::EnvironmentParameters, irradiance) == 20);
static_assert(sizeof(gpu::EnvironmentParameters) == 128);

// Radiance is clamped here. A half-precision file holds a sun of up to 65504.
constexpr float kBrightest = 1e6f;

// The picture's radiance times the strength, clamped to [0, kBrightest]; 0 where it is no number.
engine::FloatPixels soundLight(engine::FloatPixels picture, float strength) {
    for (float& value : picture.rgb) {
        value *= strength;
        value = value > 0.0f ? std::min(value, kBrightest) : 0.0f;
    }
    return picture;
}

gpu::EnvironmentParameters
parametersOf(const engine::FloatPixels& light, float turn, std::uint64_t texels) {
    gpu::EnvironmentParameters parameters{
        .texels = texels,
        .width = light.width,
        .height = light.height,
        .turn = turn,
        .irradiance = {}};
    const std::array harmonics = irradianceHarmonics(light, double{turn});
    std::ranges::copy(harmonics, parameters.irradiance);
    return parameters;
}

}  // namespace

EnvironmentPass::EnvironmentPass(
    const engine::Device& device, const Settings& settings, const RenderAssets& assets) {
    if (!assets.environment) return;
    const RenderSettings& render = settings.render;
    const engine::FloatPixels light = soundLight(*assets.environment, render.environment_strength);
    texels_ = engine::makeBuffer(device, std::span(light.rgb), "environment");
    const gpu::EnvironmentParameters parameters =
        parametersOf(light, glm::radians(render.environment_turn), texels_.address());
    parameters_ = engine::makeBuffer(device, std::span(&parameters, 1), "environment parameters");
    background_.emplace(
        device, engine::GraphicsDescription{
                    .shaders = {"environment/background.vert", "environment/background.frag"},
                    .constants = {{gpu::kBackgroundLinearLightConstant, hasLinearLight(render)}},
                    .push_size = sizeof(gpu::EnvironmentPush),
                    .colors = {{colorFormat(render)}},
                    .depth_format = engine::Target::kDepthFormat,
                    .samples = render.msaa,
                    .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                    .depth_write = false});
}

void EnvironmentPass::draw(engine::Commands& commands, std::uint64_t picture) const {
    if (!background_) return;
    commands.bind(*background_, gpu::EnvironmentPush{.picture = picture, .environment = address()});
    commands.draw({.vertices = 3});
}

}  // namespace hair
