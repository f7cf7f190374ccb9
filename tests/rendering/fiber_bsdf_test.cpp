#include "hair/reference/fiber.h"
#include "hair/rendering/fiber.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "tests/rendering/fiber_rig.h"

namespace hair::rendering {
namespace {

using std::numbers::pi;
constexpr double kSphere = 4 * pi;

double mean(const glm::dvec3& color) { return (color.r + color.g + color.b) / 3; }

std::array<double, 4> numbers(std::uint32_t index) {
    std::array<double, 4> u{};
    for (std::uint32_t i = 0; i < 4; ++i) u[i] = random01(11, index, i);
    return u;
}

TEST(FiberFresnel, IsWhatIsWorkedOutByHand) {
    EXPECT_NEAR(fresnel(1, 1.55), 0.0465206, 1e-7);  // (0.55 / 2.55)^2
    EXPECT_NEAR(fresnel(0, 1.55), 1, 1e-12);
    // 60 degrees into 1.5: cos theta_t = sqrt(2 / 3), amplitudes -0.4202041 and -0.0424492.
    EXPECT_NEAR(fresnel(0.5, 1.5), 0.0891867, 1e-7);
    // Brewster's angle reflects one polarisation alone, by ((1 - eta^2) / (1 + eta^2))^2.
    EXPECT_NEAR(fresnel(1 / std::sqrt(3.25), 1.5), 0.5 * std::pow(1.25 / 3.25, 2), 1e-12);
}

TEST(LongitudinalScattering, IntegratesToOne) {
    constexpr int kSteps = 4000;
    for (const double variance : {4e-4, 0.0065, 0.08, 0.1, 0.3, 2.0, 30.0, 110.0}) {
        for (const double theta_o : {0.0, 0.7, -1.4, pi / 2}) {
            double sum = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double theta = ((i + 0.5) / kSteps - 0.5) * pi;
                sum += reference::longitudinal(theta, theta_o, variance) * std::cos(theta) * pi /
                       kSteps;
            }
            // The midpoint rule is wrong by step^2 / 24 times the change of f' from pole to pole.
            const double step = pi / kSteps;
            EXPECT_NEAR(sum, 1, 1.1 * step * step / 24 * (1 + 1 / variance) + 1e-9)
                << variance << ' ' << theta_o;
        }
    }
}

TEST(AzimuthalScattering, IntegratesToOneAndToItsCdf) {
    constexpr int kSteps = 20000;
    for (const double scale : {0.01, 0.1, 0.5, 4.0}) {
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            if (i == kSteps / 4) {
                EXPECT_NEAR(sum, trimmedLogisticCdf(-pi / 2, scale), 1e-6) << scale;
            }
            const double x = ((i + 0.5) / kSteps * 2 - 1) * pi;
            sum += reference::trimmedLogistic(x, scale) * 2 * pi / kSteps;
        }
        EXPECT_NEAR(sum, 1, 1e-6) << scale;
    }
}

// Light that is not absorbed leaves again, for any widths of the lobes: the integral of f |cos
// theta_i| over all directions is 1 on average over the fibre.
TEST(WhiteFurnace, HoldsWithUniformSamples) {
    for (const float m : kRoughnesses) {
        for (const float n : kRoughnesses) {
            const Fiber fiber = makeFiber(whiteFiber(m, n));
            const std::vector<FiberSample> samples = uniformSamples(m, n);
            for (const double sin_theta_o : {0.2, -0.9}) {
                double sum = 0;
                for (const FiberSample& sample : samples)
                    sum += reference::scattering(
                               fiber, direction(sin_theta_o, 1.0), sample.wi, sample.h)
                               .g;
                const double mean_scattered = sum * kSphere / static_cast<double>(samples.size());
                EXPECT_GT(mean_scattered, 0.95) << m << ' ' << n << ' ' << sin_theta_o;
                EXPECT_LT(mean_scattered, 1.05) << m << ' ' << n << ' ' << sin_theta_o;
            }
        }
    }
}

TEST(WhiteFurnace, HoldsWithImportanceSampling) {
    constexpr std::uint32_t kSamples = 400;
    for (const float m : kRoughnesses) {
        for (const float n : kRoughnesses) {
            const Fiber fiber = makeFiber(whiteFiber(m, n));
            const glm::dvec3 wo = direction(0.4, -2.0);
            double sum = 0;
            for (std::uint32_t i = 0; i < kSamples; ++i) {
                const double h = 2 * random01(5, i, 4) - 1;
                const glm::dvec3 wi = reference::sampleDirection(fiber, wo, h, numbers(i));
                const double pdf = reference::samplingPdf(fiber, wo, wi, h);
                if (pdf > 0) sum += reference::scattering(fiber, wo, wi, h).g / pdf;
            }
            EXPECT_GT(sum / kSamples, 0.99) << m << ' ' << n;
            EXPECT_LT(sum / kSamples, 1.01) << m << ' ' << n;
        }
    }
}

// The mean of a function over f's directions is the same with both ways of sampling, so the
// frequency of directions follows their density. Absorption and tilt make lobes differ.
TEST(FiberSampling, ComesAsOftenAsItsDensitySays) {
    constexpr std::uint32_t kSamples = 20000;
    for (const float m : {0.3f, 0.7f}) {
        for (const float n : {0.3f, 0.7f}) {
            ShadingSettings shading = brownFiber();
            shading.longitudinal_roughness = m;
            shading.azimuthal_roughness = n;
            const Fiber fiber = makeFiber(shading);
            const glm::dvec3 wo = direction(0.3, 0.5);
            const auto light = [](const glm::dvec3& wi) { return wi.z * wi.z + wi.x + 1.2; };
            double uniform = 0;
            const std::vector<FiberSample> samples = uniformSamples(m, n);
            for (const FiberSample& sample : samples)
                uniform +=
                    light(sample.wi) * mean(reference::scattering(fiber, wo, sample.wi, sample.h));
            uniform *= kSphere / static_cast<double>(samples.size());
            double chosen = 0;
            for (std::uint32_t i = 0; i < kSamples; ++i) {
                const double h = 2 * random01(5, i, 4) - 1;
                const glm::dvec3 wi = reference::sampleDirection(fiber, wo, h, numbers(i));
                chosen += light(wi) * mean(reference::scattering(fiber, wo, wi, h)) /
                          reference::samplingPdf(fiber, wo, wi, h);
            }
            EXPECT_NEAR(chosen / kSamples / uniform, 1, 0.05) << m << ' ' << n;
        }
    }
}

TEST(FiberAttenuation, IsAllOfTheLightThatIsNotAbsorbed) {
    for (const double theta : {0.0, 0.8, -1.5, pi / 2}) {
        for (const double h : {-1.0, -0.6, 0.0, 0.99}) {
            Fiber fiber = makeFiber(whiteFiber(0.3f, 0.3f));
            double white = 0;
            for (const glm::dvec3& a : fiberPath(fiber, theta, h).attenuations) white += a.r;
            EXPECT_NEAR(white, 1, 1e-9) << theta << ' ' << h;
            fiber.absorption = {0.1, 1.0, 10.0};
            glm::dvec3 sum(0);
            for (const glm::dvec3& a : fiberPath(fiber, theta, h).attenuations) sum += a;
            if (std::abs(h) < 1 && theta < 1.5) {
                EXPECT_LT(sum.r, white);
                EXPECT_LT(sum.g, sum.r);
                EXPECT_LT(sum.b, sum.g);
            }
        }
    }
    // Straight through the middle: 4.652 % reflected, twice; 2 radii of absorption on the way.
    Fiber fiber = makeFiber(whiteFiber(0.3f, 0.3f));
    fiber.absorption = glm::dvec3(0.5);
    const FiberPath path = fiberPath(fiber, 0, 0);
    EXPECT_NEAR(path.attenuations[1].r, std::pow(1 - 0.0465206, 2) * std::exp(-1.0), 1e-7);
}

// The scales' outer faces tilt towards the root, -x: R's half angle is -tilt. In Marschner et al.
// 2003 TT and TRT go the other way.
TEST(FiberTilt, MovesLobes) {
    ShadingSettings shading;
    shading.cuticle_tilt = 3.0f;
    const Fiber fiber = makeFiber(shading);
    const double expected[]{-6, 3, 12, 0};
    for (std::size_t p = 0; p < kFiberLobes; ++p)
        EXPECT_NEAR(glm::degrees(fiber.shifts[p]), expected[p], 1e-6) << p;

    // Only R returns light from a black fibre.
    shading.color = glm::vec3(0.0f);
    shading.longitudinal_roughness = 0.1f;
    Fiber black = makeFiber(shading);
    black.absorption = glm::dvec3(100);
    double best = 0;
    double best_sum = 0;
    const double theta_o = glm::radians(20.0);
    for (double theta_i = -1.0; theta_i < 1.0; theta_i += 0.001) {
        const double value =
            reference::scattering(
                black, direction(std::sin(theta_o), 0), direction(std::sin(theta_i), 0), 0)
                .g;
        if (value > best) {
            best = value;
            best_sum = theta_i + theta_o;
        }
    }
    // 1 / cos theta in M_p moves its maximum by v tan(theta), here 0.1 degrees.
    EXPECT_NEAR(glm::degrees(best_sum), -6, 0.2);
}

TEST(FiberScattering, IsFiniteAtTheEdges) {
    for (const float roughness : {0.05f, 0.3f, 1.0f}) {
        for (const float absorbed : {0.0f, 1.0f}) {
            ShadingSettings shading = whiteFiber(roughness, roughness);
            shading.color -= absorbed;
            shading.cuticle_tilt = 10.0f;
            shading.refractive_index = 1.01f;
            const Fiber fiber = makeFiber(shading);
            for (const double h : {-1.0, 0.0, 1.0}) {
                for (const double o : {-1.0, 0.3, 1.0}) {
                    for (const double i : {-1.0, 0.3, 1.0}) {
                        const double value =
                            reference::scattering(fiber, direction(o, 0), direction(i, pi), h).g;
                        EXPECT_TRUE(std::isfinite(value)) << h << ' ' << o << ' ' << i;
                        EXPECT_GE(value, 0) << h << ' ' << o << ' ' << i;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace hair::rendering
