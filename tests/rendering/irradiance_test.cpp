// Light on matt surfaces under a picture of light from all around.
#include "hair/rendering/environment.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <gtest/gtest.h>

#include "tests/rendering/environments.h"

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

// The middle of a texel stands for all of it: of a picture 128 px high that is an error of
// (pi / 128)^2 / 24 of what bends by 1 per radian^2, times 6 for l = 2.
constexpr double kQuadrature = 2e-4;

TEST(Irradiance, OfEvenLightIsThatLight) {
    const auto harmonics = irradianceHarmonics(environmentOf([](auto) { return 0.7; }), 0);
    for (const glm::dvec3& n : someDirections()) EXPECT_NEAR(irradianceAt(harmonics, n), 0.7, 2e-4);
}

// A clamped cosine has factors of pi, 2 pi / 3 and pi / 4 on l = 0, 1 and 2 (their eq. 8), so of
// light of those alone nothing is lost.
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
// faces it gets 2/3: nine terms give 1/4 + 1/3 + 5/64 = 0.6615, which is 0.8 % less. What they
// leave out is -1/24 * -3/32 = 0.4 % in the other directions.
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

}  // namespace
}  // namespace hair::rendering
