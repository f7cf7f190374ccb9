#include "hair/reference/fiber.h"
#include "hair/rendering/fiber.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/rendering/fiber_rig.h"

namespace hair::rendering {
namespace {

using std::numbers::pi;

TEST(FiberAverages, AreAllOfTheLightOfAWhiteFiber) {
    for (const float n : kRoughnesses) {
        for (const double theta : {0.0, 0.6, 1.3, pi / 2}) {
            const FiberAverages white = averageOverFiber(makeFiber(whiteFiber(0.3f, n)), theta);
            EXPECT_NEAR(white.forward.g + white.backward.g, 1, 1e-9) << n << ' ' << theta;
            const FiberAverages brown = averageOverFiber(makeFiber(brownFiber()), theta);
            if (theta < 1.5) {
                EXPECT_LT(brown.forward.g + brown.backward.g, 1) << theta;
            }
            EXPECT_LE(brown.forward.b, brown.forward.r) << theta;
        }
    }
}

// By Simpson's rule over sin theta, with the mean strand of power 1 - tip_lightening / 2. The two
// rules agree to 1e-4 on these smooth averages, except for the kink of Fresnel's reflection at 90
// degrees.
TEST(SurfaceTransmittance, IsTheForwardPartOfLightFromAllDirections) {
    ShadingSettings shading = brownFiber();
    shading.model = ShadingModel::dual_scattering;
    shading.density_factor = 0.9f;
    shading.tip_lightening = 0.3f;
    Fiber fiber = makeFiber(shading);
    fiber.absorption *= 0.85 * 0.85;
    constexpr int kParts = 64;
    glm::dvec3 passed(0);
    for (int i = 0; i < kParts; ++i) {
        // Light met at sin theta: cos theta (a ring is even in sin theta).
        const double sine = static_cast<double>(i) / kParts;
        const double weight = i == 0 ? 1 : i % 2 == 1 ? 4 : 2;
        const double theta = std::asin(sine);
        passed += weight * std::cos(theta) * averageOverFiber(fiber, theta).forward;
    }
    const glm::dvec3 expected = 0.9 * passed / (3.0 * kParts) / (pi / 4);
    const glm::dvec3 found = surfaceTransmittance(shading);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(found[channel], expected[channel], 2e-3) << channel;
    EXPECT_GT(found.r, found.b) << "brown hair passes more red light";

    shading.model = ShadingModel::marschner;
    shading.shadows.stopped = 0.75f;
    EXPECT_EQ(surfaceTransmittance(shading), glm::dvec3(0.25));
}

// Fibres in a row: light goes forward i times, back, and so on. These are the paper's double sums
// term by term, but light first meets a Poisson number of fibres with mean i. In the paper the
// third power of 1 - a_f^2 is under a_b^3, not the second.
TEST(LocalScattering, IsTheSumOverItsPaths) {
    const FiberAverages averages{
        .forward = {0.8, 0.5, 0.3},
        .backward = {0.15, 0.3, 0.1},
        .forward_shift = 0.02,
        .backward_shift = -0.05,
        .forward_variance = 0.01,
        .backward_variance = 0.03};
    const LocalScattering local = localScattering(averages);
    double weights = 0;
    double shifts = 0;
    double variances = 0;
    for (int c = 0; c < 3; ++c) {
        const double f = averages.forward[c];
        const double b = averages.backward[c];
        double sum = 0;
        // First a random number of fibres with mean `in`, then `forward` forward and `backward`
        // back.
        const auto add = [&](int in, int forward, int backward) {
            double probability = std::exp(-in);
            for (int met = 0; met < 3 * in + 40; ++met) {
                const double part =
                    probability * std::pow(f, met + forward) * std::pow(b, backward);
                sum += part;
                weights += part;
                shifts += part * ((met + forward) * 0.02 + backward * -0.05);
                variances += part * ((met + forward) * 0.01 + backward * 0.03);
                probability *= static_cast<double>(in) / (met + 1);
            }
        };
        constexpr int kDeepest = 60;  // (0.8 exp(-0.2))^60 is 1e-11
        for (int i = 1; i < kDeepest; ++i) {
            add(i, i, 1);
            for (int j = 0; j < i; ++j)
                for (int k = j + 1; k < kDeepest; ++k) add(i, (i - j - 1) + (k - j - 1) + k, 3);
        }
        EXPECT_NEAR(local.albedo[c], sum, 1e-6 * sum);
    }
    EXPECT_NEAR(local.shift, shifts / weights, 1e-7);
    EXPECT_NEAR(local.variance, variances / weights, 1e-7);
}

// The reflection of a stack of layers has a closed form: R = b + f^2 R / (1 - b R). If the next
// layer gets p instead of f of the light, S = b + p f S / (1 - b R). The sum of one and three
// scatterings backward is less; it misses the terms of fifth order in b.
TEST(LocalScattering, ReflectsNoMoreThanAllLayersDo) {
    for (const float n : kRoughnesses) {
        for (const float eumelanin : {0.0f, 0.1f, 1.0f}) {
            for (const float eta : {1.01f, 1.55f, 3.0f}) {
                ShadingSettings shading = brownFiber();
                shading.azimuthal_roughness = n;
                shading.eumelanin = eumelanin;
                shading.refractive_index = eta;
                const FiberAverages averages = averageOverFiber(makeFiber(shading), 0.4);
                const LocalScattering local = localScattering(averages);
                for (int c = 0; c < 3; ++c) {
                    const double f = averages.forward[c];
                    const double b = averages.backward[c];
                    // b R^2 - (1 + b^2 - f^2) R + b = 0
                    const double p = 1 + b * b - f * f;
                    const double stack = 2 * b / (p + std::sqrt(std::max(p * p - 4 * b * b, 0.0)));
                    EXPECT_LE(stack, 1 + 1e-6);  // the square root of a number that is 0 for a
                                                 // white fibre
                    const double q = f * std::exp(f - 1);
                    const double all = b / (1 - q / (1 - b * stack));
                    const double some = b + local.albedo[c];
                    EXPECT_LE(some, all + 1e-9) << n << ' ' << eumelanin << ' ' << eta;
                    // The term of fifth order in the series of S, from R = r_1 b + r_3 b^3.
                    const double rest = 1 - f * f;
                    const double r_1 = 1 / rest;
                    const double r_3 = f * f / std::pow(rest, 3);
                    const double missing = std::pow(b, 5) * q *
                                           ((r_3 + r_1 * r_1) / std::pow(1 - q, 2) +
                                            q * r_1 * r_1 / std::pow(1 - q, 3));
                    if (b < 0.1 * rest) {
                        EXPECT_NEAR(some, all, 1.2 * missing + 1e-12);
                    }
                }
            }
        }
    }
}

TEST(DualScattering, IsTheFibersOwnWhereNothingElseIs) {
    const Fiber fiber = makeFiber(brownFiber());
    const glm::dvec3 wo = direction(0.2, 0);
    const glm::dvec3 wi = direction(-0.3, 1.0);
    EXPECT_EQ(
        reference::dualScattering(fiber, 0, wo, wi, 0.3, {}),
        reference::scattering(fiber, wo, wi, 0.3));
    // Without density, only the light that meets no strand remains.
    EXPECT_NEAR(
        reference::dualScattering(fiber, 0, wo, wi, 0.3, {.strands = 2}).g,
        std::exp(-2.0) * reference::scattering(fiber, wo, wi, 0.3).g, 1e-12);
    // Hair around the fibre adds light; hair in front of it takes light away.
    const double alone = reference::scattering(fiber, wo, wi, 0.3).g;
    const double among = reference::dualScattering(fiber, 0.7, wo, wi, 0.3, {}).g;
    EXPECT_GT(among, alone);
    EXPECT_LT(reference::dualScattering(fiber, 0.7, wo, wi, 0.3, {.strands = 20}).g, 0.1 * among);
}

}  // namespace
}  // namespace hair::rendering
