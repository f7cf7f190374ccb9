// Lights on the device compared with the laws of optics.
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/rendering/model_probe.h"

namespace hair::rendering {
namespace {

constexpr double kRounding = 4e-6;  // relative: some thirty roundings in single precision

gpu::ModelProbe at(const glm::vec3& position, const glm::vec3& normal = {0, 0, 1}) {
    return {
        .position = position,
        .normal = normal,
        .exponent = 50.0f,
        .tangent = {1, 0, 0},
        .to_eye = {0, 0, 1}};
}

class Lights : public GpuTest {
protected:
    static gpu::ModelProbe probe(const LightSettings& light, const gpu::ModelProbe& point) {
        return probeModels(device(), {light}, {point}).front();
    }
};

TEST_F(Lights, OfTheThesisAreTheSameEverywhere) {
    const LightSettings light{.position = {1, 2, 3}, .color = {1.0f, 0.5f, 0.0f}, .strength = 3.0f};
    for (const float far : {0.5f, 40.0f}) {
        const gpu::ModelProbe found = probe(light, at(glm::vec3(1, 2, 3) - glm::vec3(0, 0, far)));
        EXPECT_NEAR(glm::distance(found.to_light, glm::vec3(0, 0, 1)), 0.0, kRounding);
        EXPECT_NEAR(found.color.x, 3.0, 3.0 * kRounding);
        EXPECT_NEAR(found.color.y, 3.0 * 0.21404114, kRounding);  // sRGB's 0.5, as printed
        EXPECT_EQ(found.color.z, 0.0f);
        EXPECT_EQ(found.angular_radius, 0.0f);
    }
}

TEST_F(Lights, WeakenWithTheSquareOfTheDistance) {
    for (const LightType type : {LightType::point, LightType::sphere}) {
        const LightSettings light{
            .type = type, .position = {0, 0, 5}, .reference_distance = 2.0f, .radius = 0.5f};
        for (const float far : {0.75f, 2.0f, 4.0f})
            EXPECT_NEAR(
                probe(light, at({0, 0, 5 - far})).color.x * far * far / 4.0f, 1.0, kRounding);
    }
}

TEST_F(Lights, AreFiniteWhereTheyAre) {
    for (const LightType type : {LightType::point, LightType::sphere}) {
        const LightSettings light{
            .type = type, .position = {0.5f, 0, 5}, .reference_distance = 1.0f, .radius = 0.1f};
        const gpu::ModelProbe found = probe(light, at(light.position));
        EXPECT_NEAR(glm::length(found.to_light), 1.0, kRounding);
        EXPECT_TRUE(std::isfinite(found.color.x));
        EXPECT_TRUE(std::isfinite(found.phong_diffuse));
        EXPECT_TRUE(std::isfinite(found.kajiya_kay_specular));
    }
}

// For points within a metre, the direction of a point light 1 km away varies by 1e-3, and its light
// by 2e-3.
TEST_F(Lights, DirectionalOnesAreInfinitelyFar) {
    const glm::vec3 to_light = glm::normalize(glm::vec3(0.3f, 0.5f, 0.8f));
    const LightSettings near_by{.type = LightType::directional, .direction = -0.5f * to_light};
    const LightSettings far{.position = 1000.0f * to_light, .reference_distance = 1000.0f};
    for (const glm::vec3 position : {glm::vec3(0, 0, 0), {0.5f, 0.5f, 0}, {0, -0.6f, 0.4f}}) {
        const gpu::ModelProbe a = probe(near_by, at(position));
        const gpu::ModelProbe b = probe(far, at(position));
        EXPECT_NEAR(glm::distance(a.to_light, b.to_light), 0.0, 1.01e-3);
        EXPECT_NEAR(a.color.x, b.color.x, 2.01e-3);
        EXPECT_NEAR(a.matt, b.matt, 1.01e-3);
    }
}

// Irradiance of a surface under a sphere of radiance 1, over that of a surface that faces it. The
// sphere has the angular radius `angular` and is `tilt` off the normal. It is the mean over
// directions within the cone, evenly spread by a grid over the disc of sines.
double meanCosine(double angular, double tilt) {
    const double largest = std::sin(angular);
    constexpr int kSteps = 400;
    double sum = 0.0, facing = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double sine = largest * std::sqrt((i + 0.5) / kSteps);
        const double cosine = std::sqrt(1.0 - sine * sine);
        for (int j = 0; j < 180; ++j) {
            const double around = (j + 0.5) * std::numbers::pi / 90.0;
            const double up = cosine * std::cos(tilt) + sine * std::cos(around) * std::sin(tilt);
            // Solid angle of a ring of the same sine^2: 1 / cosine.
            sum += std::max(up, 0.0) / cosine;
            facing += 1.0;
        }
    }
    return sum / facing;
}

TEST_F(Lights, SpheresLightMattSurfacesAsTheirWholeFaceDoes) {
    for (const double angular : {0.05, 0.3, 0.6}) {
        const LightSettings light{
            .type = LightType::sphere,
            .position = {0, 0, 2},
            .radius = static_cast<float>(2.0 * std::sin(angular))};
        for (const double tilt : {0.0, 0.5, 1.2, 1.45, 1.6, 1.8, 2.3}) {
            const glm::vec3 normal(std::sin(tilt), 0.0, std::cos(tilt));
            const gpu::ModelProbe found = probe(light, at({0, 0, 0}, normal));
            // The error of Vulkan's arc sine: 4096 units in the last place.
            EXPECT_NEAR(found.angular_radius, angular, 4096 * 0x1p-23 * angular);
            // The error that mattResponse() documents; the integral's own error is below 1e-3.
            EXPECT_NEAR(found.matt, meanCosine(angular, tilt), 0.04 * std::sin(angular) + 1e-3)
                << angular << " " << tilt;
        }
    }
}

// The mean of a lobe over the directions of a disc. A lobe exp(-n a^2 / 2) of one angle keeps its
// integral; the disc's spread of that angle is r^2 / 4.
TEST_F(Lights, SizeWidensHighlights) {
    const double angular = 0.2, n = 100.0;
    const LightSettings light{
        .type = LightType::sphere,
        .position = {0, 0, 2},
        .radius = static_cast<float>(2.0 * std::sin(angular))};
    gpu::ModelProbe point = at({0, 0, 0});
    point.exponent = static_cast<float>(n);
    std::mt19937 random(3);
    const auto number = [&] { return 2.0 * (random() + 0.5) / 4294967296.0 - 1.0; };
    double squares = 0.0;
    int inside = 0;
    while (inside < 100000) {
        const double x = number(), y = number();
        if (x * x + y * y > 1.0) continue;
        squares += angular * angular * x * x;
        ++inside;
    }
    // The mean square of 100000 has a relative standard deviation of 0.3 %.
    EXPECT_NEAR(
        probe(light, point).widened_exponent, 1.0 / (1.0 / n + squares / inside),
        0.01 / (1.0 / n + squares / inside));
}

}  // namespace
}  // namespace hair::rendering
