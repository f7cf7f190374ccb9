// Light on matt surfaces under a picture of light from all around.
#include "hair/rendering/environment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <gtest/gtest.h>

#include "hair/reference/fiber.h"
#include "hair/rendering/fiber.h"
#include "hair/rendering/render_assets.h"
#include "tests/rendering/environments.h"
#include "tests/rendering/fiber_rig.h"

namespace hair::rendering {
namespace {

const glm::dvec3 kTilted = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));

// Real harmonics by their definition (Ramamoorthi and Hanrahan 2001, eq. 3), with the constants as
// square roots.
double irradianceAt(const std::array<glm::dvec3, 9>& c, const glm::dvec3& n) {
    const double p = std::numbers::pi;
    const double y[9] = {
        std::sqrt(1 / (4 * p)),
        std::sqrt(3 / (4 * p)) * n.y,
        std::sqrt(3 / (4 * p)) * n.z,
        std::sqrt(3 / (4 * p)) * n.x,
        std::sqrt(15 / (4 * p)) * n.x * n.y,
        std::sqrt(15 / (4 * p)) * n.y * n.z,
        std::sqrt(5 / (16 * p)) * (3 * n.z * n.z - 1),
        std::sqrt(15 / (4 * p)) * n.x * n.z,
        std::sqrt(15 / (16 * p)) * (n.x * n.x - n.y * n.y)};
    double sum = 0;
    for (int i = 0; i < 9; ++i) sum += c[i].g * y[i];
    return sum;
}

double legendre2(double x) { return (3 * x * x - 1) / 2; }

// The sum takes a texel's middle for all of it. In a picture 128 px high that is an error of (pi /
// 128)^2 / 24 for a function that bends by 1 per radian^2, times 6 for l = 2.
constexpr double kQuadrature = 2e-4;

TEST(Irradiance, OfEvenLightIsThatLight) {
    const auto harmonics = irradianceHarmonics(environmentOf([](auto) { return 0.7; }), 0);
    for (const glm::dvec3& n : someDirections()) EXPECT_NEAR(irradianceAt(harmonics, n), 0.7, 2e-4);
}

// A clamped cosine has factors of pi, 2 pi / 3 and pi / 4 on l = 0, 1 and 2 (their eq. 8), so
// light of those alone loses nothing.
TEST(Irradiance, OfSmoothLightIsExact) {
    for (const double turn : {0.0, 0.5, -2.0}) {
        const auto harmonics = irradianceHarmonics(
            environmentOf([](const glm::dvec3& d) {
                const double x = glm::dot(d, kTilted);
                return 1 + 0.4 * x + 0.5 * legendre2(x);
            }),
            turn);
        const glm::dvec3 axis = turned(kTilted, turn);
        for (const glm::dvec3& n : someDirections()) {
            const double x = glm::dot(n, axis);
            EXPECT_NEAR(
                irradianceAt(harmonics, n), 1 + 0.4 * 2 / 3 * x + 0.5 / 4 * legendre2(x),
                kQuadrature);
        }
    }
}

// Light of max(cos, 0) has the series 1/4 + 1/2 P1 + 5/16 P2 - 3/32 P4 ..., and a surface that
// faces it gets 2/3. Nine terms give 1/4 + 1/3 + 5/64 = 0.6615, which is 0.8 % less. In other
// directions the missing terms are -1/24 * -3/32 = 0.4 %.
TEST(Irradiance, OfACosineLobeIsWithinAPerCent) {
    const auto harmonics = irradianceHarmonics(
        environmentOf([](const glm::dvec3& d) { return std::max(glm::dot(d, kTilted), 0.0); }), 0);
    EXPECT_NEAR(irradianceAt(harmonics, kTilted), 2.0 / 3.0, 0.01 * 2.0 / 3.0);
    for (const glm::dvec3& n : someDirections()) {
        const double x = glm::dot(n, kTilted);
        EXPECT_NEAR(
            irradianceAt(harmonics, n), 0.25 + x / 3 + 5.0 / 64 * legendre2(x), kQuadrature);
    }
}

// ---- As lights ----------------------------------------------------------------------------------

double irradianceOf(const LightSettings& light) {
    const RenderSettings linear{.tone_map = ToneMap::srgb};
    return std::numbers::pi * double{light.strength} * workingColor(linear, light.color).g;
}

// sRGB's curve there and back in single precision.
constexpr double kColorRounding = 1e-5;

TEST(EnvironmentLights, HaveAllLightOfThePicture) {
    RenderSettings render{
        .tone_map = ToneMap::srgb, .environment_strength = 3.0f, .environment_turn = 40.0f};
    // 1 + 0.6 cos: 4 pi in all; texels' solid angles are exact and their middles off by 1e-4.
    const auto picture =
        environmentOf([](const glm::dvec3& d) { return 1 + 0.6 * glm::dot(d, kTilted); });
    for (const std::uint32_t count : {1u, 7u, 12u, 48u}) {
        const std::vector<LightSettings> lights = environmentLights(picture, render, count);
        ASSERT_EQ(lights.size(), count);
        double sum = 0;
        for (const LightSettings& light : lights) sum += irradianceOf(light);
        EXPECT_NEAR(sum, 3 * 4 * std::numbers::pi, 3 * 4 * std::numbers::pi * 2e-4) << count;
    }
}

// Twelve directions are the corners of an icosahedron, with equal parts of an even light, except
// for the texels at the parts' edges: 250 of a part's 2,700. Half of these are on either side, up
// to the square root of their number.
TEST(EnvironmentLights, OfEvenLightAreEqualAndWiderThanTheirPart) {
    const auto lights =
        environmentLights(environmentOf([](auto) { return 0.7; }), {.tone_map = ToneMap::srgb}, 12);
    double squares[3]{};
    for (const LightSettings& light : lights) {
        EXPECT_NEAR(irradianceOf(light), 0.7 * 4 * std::numbers::pi / 12, 0.7 * 0.02);
        EXPECT_EQ(light.type, LightType::directional);
        // A cap of a twelfth of the sphere has 1 - cos r = 1/6; of twice its area, nearly.
        const double radius = std::numbers::sqrt2 * std::acos(5.0 / 6);
        EXPECT_NEAR(light.angular_radius, radius * 180 / std::numbers::pi, 1e-4);
        for (int axis = 0; axis < 3; ++axis)
            squares[axis] += light.direction[axis] * light.direction[axis];
    }
    // A spherical design: means of squares are 1/3.
    for (const double sum : squares) EXPECT_NEAR(sum, 4, 1e-5);
}

TEST(EnvironmentLights, ComeFromWhereThePictureIsBright) {
    for (const double degrees : {0.0, 90.0, -130.0}) {
        const auto lights = environmentLights(
            environmentOf(
                [](const glm::dvec3& d) { return glm::dot(d, kTilted) > 0.99 ? 50.0 : 0.0; }),
            {.tone_map = ToneMap::srgb, .environment_turn = static_cast<float>(degrees)}, 48);
        const auto brightest = std::ranges::max_element(lights, {}, irradianceOf);
        const glm::dvec3 axis = turned(kTilted, degrees * std::numbers::pi / 180);
        // One of 48 directions is within 20 degrees.
        EXPECT_GT(glm::dot(-glm::dvec3(brightest->direction), axis), 0.94) << degrees;
    }
}

// In even light from all around, a white fibre looks as bright as its surroundings: the white
// furnace. Twelve lights of 48 degrees stand for all directions; they widen the lobes accordingly.
TEST(EnvironmentLights, AreAFurnaceForAWhiteFiber) {
    const auto lights =
        environmentLights(environmentOf([](auto) { return 1.0; }), {.tone_map = ToneMap::srgb}, 12);
    for (const float roughness : {0.3f, 0.5f}) {
        Fiber fiber = makeFiber(whiteFiber(roughness, roughness));
        const double variance = std::pow(std::acos(5.0 / 6), 2) / 2;  // of a disc along an axis
        for (double& v : fiber.variances) v += variance;
        // The logistic distribution's variance is (pi s)^2 / 3.
        fiber.azimuthal_scale = std::sqrt(
            std::pow(fiber.azimuthal_scale, 2) + 3 * variance / std::pow(std::numbers::pi, 2));
        double sum = 0;
        int count = 0;
        for (const glm::dvec3& eye : someDirections()) {
            for (const double h : {-0.75, -0.25, 0.25, 0.75}) {
                for (const LightSettings& light : lights)
                    sum += irradianceOf(light) *
                           reference::scattering(fiber, eye, -glm::dvec3(light.direction), h).g;
                ++count;
            }
        }
        EXPECT_NEAR(sum / count, 1, 0.05) << roughness;
    }
}

}  // namespace
}  // namespace hair::rendering
