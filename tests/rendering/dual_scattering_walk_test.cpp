#include "hair/reference/fiber.h"
#include "hair/rendering/fiber.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/rendering/fiber_rig.h"

// Dual scattering compared with light followed from fibre to fibre.
namespace hair::rendering {
namespace {

using std::numbers::pi;

double inclination(const glm::dvec3& w) { return std::asin(w.x); }

// Numbers of a random walk: a step takes eight.
struct Walk {
    std::uint32_t index;
    std::uint32_t next = 0;
    double number() { return random01(29, index, next++); }
};

struct Step {
    bool forward;
    double theta;  // of the light that leaves, as seen on arrival: theta_i of the next fibre
    glm::dvec3 carried;  // part of the light
};

// Light from inclination theta_i meets a fibre at a random place. The reference follows light
// backwards, as path tracers do.
Step meet(const Fiber& fiber, double theta_i, Walk& walk) {
    const glm::dvec3 from = direction(std::sin(theta_i), 0);
    const double h = 2 * walk.number() - 1;
    const std::array u{walk.number(), walk.number(), walk.number(), walk.number()};
    const glm::dvec3 to = reference::sampleDirection(fiber, from, h, u);
    return {
        .forward = to.y < 0,
        .theta = -inclination(to),
        .carried =
            reference::scattering(fiber, from, to, h) / reference::samplingPdf(fiber, from, to, h)};
}

// Like meet(), but the fibre's direction differs by a random angle, whose variance in each plane
// along the fibre is the fibre's own.
Step meetTilted(const Fiber& fiber, double theta_i, Walk& walk) {
    const double length =
        std::sqrt(-2 * fiber.tilt_variance * std::log(1 - walk.number()));  // Box and Muller
    const double turn = 2 * pi * walk.number();
    const glm::dvec3 axis =
        glm::normalize(glm::dvec3(1, length * std::cos(turn), length * std::sin(turn)));
    // Any vectors across the axis do: light meets the fibre at a random place.
    const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
    const glm::dmat3 frame(axis, side, glm::cross(axis, side));
    const glm::dvec3 from = direction(std::sin(theta_i), 0);
    const double h = 2 * walk.number() - 1;
    const std::array u{walk.number(), walk.number(), walk.number(), walk.number()};
    const glm::dvec3 wo = from * frame;
    const glm::dvec3 wi = reference::sampleDirection(fiber, wo, h, u);
    const glm::dvec3 to = frame * wi;
    return {
        .forward = to.y < 0,
        .theta = -inclination(to),
        .carried =
            reference::scattering(fiber, wo, wi, h) / reference::samplingPdf(fiber, wo, wi, h)};
}

TEST(FiberAverages, SpreadAsFibresOfDifferentDirectionsDo) {
    constexpr std::uint32_t kSamples = 60000;
    ShadingSettings shading = brownFiber();
    shading.longitudinal_roughness = 0.1f;
    for (const float spread : {5.0f, 12.0f}) {
        for (const float roughness : {0.1f, 0.3f}) {
            shading.azimuthal_roughness = roughness;
            shading.orientation_spread = spread;
            const Fiber fiber = makeFiber(shading);
            const FiberAverages averages = averageOverFiber(fiber, 0);
            glm::dvec2 weight(0);
            glm::dvec2 sum(0);
            glm::dvec2 square(0);
            for (std::uint32_t i = 0; i < kSamples; ++i) {
                Walk walk{i};
                const Step step = meetTilted(fiber, 0, walk);
                const double carried = step.carried.r + step.carried.g + step.carried.b;
                const glm::length_t side = step.forward ? 0 : 1;
                weight[side] += carried;
                sum[side] += carried * step.theta;
                square[side] += carried * step.theta * step.theta;
            }
            const glm::dvec2 mean = sum / weight;
            const glm::dvec2 variance = square / weight - mean * mean;
            // The bound of AreTheMeansOfSampledDirections, for the same reasons.
            EXPECT_NEAR(variance.x / averages.forward_variance, 1, 0.15) << spread << roughness;
            EXPECT_NEAR(variance.y / averages.backward_variance, 1, 0.15) << spread << roughness;
        }
    }
}

TEST(FiberAverages, AreTheMeansOfSampledDirections) {
    constexpr std::uint32_t kSamples = 40000;
    const Fiber fiber = makeFiber(brownFiber());
    for (const double theta : {0.0, 0.7}) {
        const FiberAverages averages = averageOverFiber(fiber, theta);
        glm::dvec3 forward(0);
        glm::dvec3 backward(0);
        double weight = 0;
        double shift = 0;
        double square = 0;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            Walk walk{i};
            const Step step = meet(fiber, theta, walk);
            (step.forward ? forward : backward) += step.carried / double{kSamples};
            if (!step.forward) continue;
            const double change = theta - step.theta;
            const double carried = step.carried.r + step.carried.g + step.carried.b;
            weight += carried;
            shift += carried * change;
            square += carried * change * change;
        }
        // Four standard errors of a fraction of 40,000 are at most 0.01.
        EXPECT_NEAR(forward.r, averages.forward.r, 0.01);
        EXPECT_NEAR(forward.b, averages.forward.b, 0.01);
        EXPECT_NEAR(backward.r, averages.backward.r, 0.01);
        EXPECT_NEAR(backward.b, averages.backward.b, 0.01);
        shift /= weight;
        // v_p is the variance of theta for narrow lobes, at theta = 0; here lobes are up to 0.6 rad
        // wide, and theta ends at pi / 2.
        EXPECT_NEAR(shift, averages.forward_shift, theta == 0 ? 0.01 : 0.05);
        EXPECT_NEAR((square / weight - shift * shift) / averages.forward_variance, 1, 0.15)
            << theta;
    }
}

// Follows light through a random number of fibres, direction by direction, as long as it goes
// forward. Dual scattering instead uses a_f at the incoming light's inclination, and narrow lobes.
TEST(GlobalScattering, IsThatOfARandomWalk) {
    constexpr std::uint32_t kWalks = 20000;
    for (const float roughness : {0.1f, 0.3f}) {
        ShadingSettings shading = brownFiber();
        shading.longitudinal_roughness = roughness;
        const Fiber fiber = makeFiber(shading);
        for (const double theta : {0.0, 0.5}) {
            for (const double strands : {0.5, 3.0}) {
                const reference::GlobalScattering global =
                    reference::globalScattering(averageOverFiber(fiber, theta), strands);
                double direct = 0;
                glm::dvec3 forward(0);
                for (std::uint32_t i = 0; i < kWalks; ++i) {
                    Walk walk{i};
                    // Distances between fibres are exponential.
                    double way = -std::log(1 - walk.number());
                    if (way > strands) {
                        direct += 1.0 / kWalks;
                        continue;
                    }
                    glm::dvec3 carried(1);
                    double at = theta;
                    for (; way <= strands; way -= std::log(1 - walk.number())) {
                        const Step step = meet(fiber, at, walk);
                        carried *= step.forward ? step.carried : glm::dvec3(0);
                        if (!step.forward) break;
                        at = step.theta;
                    }
                    forward += carried / double{kWalks};
                }
                // Four standard errors of a fraction of 20,000: 0.014.
                EXPECT_NEAR(direct, global.direct, 0.014);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(forward[c], global.forward[c], 0.014)
                        << roughness << ' ' << theta << ' ' << strands;
                EXPECT_LE(global.direct + global.forward.r, 1);
            }
        }
    }
}

TEST(GlobalScattering, SpreadsAsARandomWalk) {
    constexpr std::uint32_t kWalks = 10000;
    constexpr int kFibers = 3;
    ShadingSettings shading = brownFiber();
    shading.longitudinal_roughness = 0.1f;
    const Fiber fiber = makeFiber(shading);
    const FiberAverages averages = averageOverFiber(fiber, 0);
    double weight = 0;
    double sum = 0;
    double square = 0;
    for (std::uint32_t i = 0; i < kWalks; ++i) {
        Walk walk{i};
        double at = 0;
        double carried = 1;
        for (int k = 0; k < kFibers && carried > 0; ++k) {
            const Step step = meet(fiber, at, walk);
            carried *= step.forward ? step.carried.g : 0;
            at = step.theta;
        }
        weight += carried;
        sum += carried * at;
        square += carried * at * at;
    }
    const double shift = sum / weight;
    EXPECT_NEAR(shift, -kFibers * averages.forward_shift, 0.01);
    EXPECT_NEAR((square / weight - shift * shift) / (kFibers * averages.forward_variance), 1, 0.15);
}

// The fibre's scattering of the light that comes through others, as a mean over the fibre and its
// azimuths. The test compares it with random walks of the light through them. It is the whole
// scattering without the light that meets no strand; nothing is behind the fibre.
TEST(DualScattering, ScattersWhatComesThroughOthersAsARandomWalk) {
    constexpr std::uint32_t kWalks = 30000;
    constexpr int kAround = 96;
    constexpr double kStrands = 2;
    const Fiber fiber = makeFiber(brownFiber());
    const double theta_i = 0.3;
    const glm::dvec3 wi = direction(std::sin(theta_i), 0);
    for (const double sin_theta_o : {-0.7, -0.2, 0.5}) {
        const auto eye = [&](std::uint32_t i) {
            return direction(sin_theta_o, i * 2 * pi / kAround);
        };
        double scattered = 0;
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const double h = 2 * random01(2, i, 1) - 1;
            const auto at = [&](double strands) {
                return reference::dualScattering(
                           fiber, 1, eye(i), wi, h, {.strands = strands, .ended = 1})
                    .g;
            };
            scattered += (at(kStrands) - std::exp(-kStrands) * at(0)) / kAround;
        }
        double walked = 0;
        for (std::uint32_t i = 0; i < kWalks; ++i) {
            Walk walk{i};
            double way = -std::log(1 - walk.number());
            if (way > kStrands) continue;
            double theta = theta_i;
            double carried = 1;
            for (; way <= kStrands && carried > 0; way -= std::log(1 - walk.number())) {
                const Step step = meet(fiber, theta, walk);
                carried *= step.forward ? step.carried.g : 0;
                theta = step.theta;
            }
            const glm::dvec3 from = direction(std::sin(theta), 0);
            const double h = 2 * walk.number() - 1;
            if (carried > 0)
                walked += carried * reference::scattering(fiber, eye(i), from, h).g / kWalks;
        }
        // The greatest value is 0.05. One lobe, with the variance of all of R, TT and TRT, differs
        // from them by 0.002, and standard errors are up to 0.0012.
        EXPECT_NEAR(scattered, walked, 0.005) << sin_theta_o;
    }
}

}  // namespace
}  // namespace hair::rendering
