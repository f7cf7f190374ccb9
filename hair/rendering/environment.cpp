#include "hair/rendering/environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <glm/trigonometric.hpp>

#include "engine/float_pictures.h"
#include "engine/transfer.h"
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

// Radiance is clamped to this. A half-precision file holds a sun of up to 65504.
constexpr float kBrightest = 1e6f;

// The picture's radiance times the strength, clamped to [0, kBrightest]; NaN becomes 0.
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

// Calls f(direction, light) for each texel: the direction of its middle, unit length, and its
// radiance times its solid angle.
template <class Function>
void forEachTexel(const engine::FloatPixels& picture, double turn, Function f) {
    using std::numbers::pi;
    const float* texel = picture.rgb.data();
    for (std::uint32_t row = 0; row < picture.height; ++row) {
        const double top = pi * row / picture.height;
        const double bottom = pi * (row + 1) / picture.height;
        const double solid_angle = 2 * pi / picture.width * (std::cos(top) - std::cos(bottom));
        const double polar = (top + bottom) / 2;
        for (std::uint32_t column = 0; column < picture.width; ++column, texel += 3) {
            const double azimuth = turn + 2 * pi * (0.5 - (column + 0.5) / picture.width);
            const glm::dvec3 direction{
                std::sin(polar) * std::sin(azimuth), std::cos(polar),
                std::sin(polar) * std::cos(azimuth)};
            f(direction, solid_angle * glm::dvec3(texel[0], texel[1], texel[2]));
        }
    }
}

// Directions spread about evenly over the sphere.
std::vector<glm::dvec3> spread(std::uint32_t count) {
    std::vector<glm::dvec3> directions;
    if (count == 12) {
        const double golden = std::numbers::phi;
        for (const double a : {-1.0, 1.0}) {
            for (const double b : {-golden, golden}) {
                directions.push_back(glm::normalize(glm::dvec3(0.0, a, b)));
                directions.push_back(glm::normalize(glm::dvec3(a, b, 0.0)));
                directions.push_back(glm::normalize(glm::dvec3(b, 0.0, a)));
            }
        }
        return directions;
    }
    const double turn = 2 * std::numbers::pi * (2 - std::numbers::phi);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double y = 1 - (2.0 * i + 1) / count;
        const double across = std::sqrt(1 - y * y);
        directions.emplace_back(across * std::cos(turn * i), y, across * std::sin(turn * i));
    }
    return directions;
}

}  // namespace

// ---- Irradiance ---------------------------------------------------------------------------------

std::array<glm::dvec3, 9> irradianceHarmonics(const engine::FloatPixels& picture, double turn) {
    std::array<glm::dvec3, 9> sums{};
    forEachTexel(picture, turn, [&](const glm::dvec3& direction, const glm::dvec3& light) {
        const std::array basis = harmonics(direction);
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += basis[i] * light;
    });
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] *= kLobe[i];
    return sums;
}

// ---- Lights -------------------------------------------------------------------------------------

std::vector<LightSettings> environmentLights(
    const engine::FloatPixels& picture, const RenderSettings& render, std::uint32_t count) {
    const std::vector<glm::dvec3> middles = spread(count);
    std::vector<glm::dvec3> irradiances(count);
    const engine::FloatPixels light = soundLight(picture, render.environment_strength);
    const double turn = glm::radians(double{render.environment_turn});
    forEachTexel(light, turn, [&](const glm::dvec3& direction, const glm::dvec3& radiance) {
        const auto nearest = std::ranges::max_element(
            middles, {}, [&](const glm::dvec3& middle) { return glm::dot(middle, direction); });
        irradiances[static_cast<std::size_t>(nearest - middles.begin())] += radiance;
    });
    // A cap of a part's solid angle, 2 pi (1 - cos r), with its area doubled, so that the light of
    // neighbouring parts joins without a gap.
    const double radius =
        std::numbers::sqrt2 * std::acos(std::max(1.0 - 2.0 / std::max(count, 1u), -1.0));
    std::vector<LightSettings> lights;
    for (std::uint32_t i = 0; i < count; ++i) {
        // A light's colour is irradiance / pi, split into display RGB up to 1 and a strength.
        const glm::dvec3 color = irradiances[i] / std::numbers::pi;
        const double strength = std::max({color.r, color.g, color.b, 1e-12});
        const glm::dvec3 part = color / strength;
        const bool is_linear = hasLinearLight(render);
        lights.push_back(
            {.type = LightType::directional,
             .direction = glm::vec3(-middles[i]),
             .color = glm::vec3(is_linear ? toDisplay(part) : toDisplay(color)),
             .strength = is_linear ? static_cast<float>(strength) : 1.0f,
             .angular_radius = static_cast<float>(std::min(glm::degrees(radius), 90.0))});
    }
    return lights;
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
