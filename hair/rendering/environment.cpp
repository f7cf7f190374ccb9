#include "hair/rendering/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/trigonometric.hpp>

#include "hair/gpu_structs.h"

namespace hair::rendering {
namespace {

std::array<double, 9> harmonics(const glm::dvec3& n) {
    return {
        0.282095,
        0.488603 * n.y,
        0.488603 * n.z,
        0.488603 * n.x,
        1.092548 * n.x * n.y,
        1.092548 * n.y * n.z,
        0.315392 * (3 * n.z * n.z - 1),
        1.092548 * n.x * n.z,
        0.546274 * (n.x * n.x - n.y * n.y)};
}

// The cosine lobe's harmonics over pi, by l: Ramamoorthi and Hanrahan 2001, eq. 8.
constexpr std::array kLobe{1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25};

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

// ---- Irradiance ---------------------------------------------------------------------------------

std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn) {
    using std::numbers::pi;
    std::array<glm::dvec3, 9> sums{};
    const float* texel = picture.rgb.data();
    for (std::uint32_t row = 0; row < picture.height; ++row) {
        const double top = pi * row / picture.height;
        const double bottom = pi * (row + 1) / picture.height;
        const double solid_angle = 2 * pi / picture.width * (std::cos(top) - std::cos(bottom));
        const double polar = (top + bottom) / 2;
        for (std::uint32_t column = 0; column < picture.width; ++column, texel += 3) {
            const double azimuth = turn + 2 * pi * (0.5 - (column + 0.5) / picture.width);
            const std::array basis = harmonics(
                {std::sin(polar) * std::sin(azimuth), std::cos(polar),
                 std::sin(polar) * std::cos(azimuth)});
            const glm::dvec3 light = solid_angle * glm::dvec3(texel[0], texel[1], texel[2]);
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += basis[i] * light;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] *= kLobe[i];
    return sums;
}

// ---- The pass -----------------------------------------------------------------------------------

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
                    .depth_compare = engine::kIsNearerOrEqual,
                    .depth_write = false});
}

void EnvironmentPass::draw(engine::Commands& commands, std::uint64_t picture) const {
    if (!background_) return;
    commands.bind(*background_, gpu::EnvironmentPush{.picture = picture, .environment = address()});
    commands.draw({.vertices = 3});
}

}  // namespace hair::rendering
