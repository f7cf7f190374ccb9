#include "hair/simulation/forces.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/error.h"
#include "hair/reference/wind.h"

namespace hair::simulation {
namespace {

constexpr double kExact = 1e-12;  // rounding of double

TEST(WindCone, HoldsTheHalfAngleAndQuarterTurns) {
    for (const glm::vec3 direction :
         {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 0.1f),
          glm::vec3(-0.3f, 0.5f, 0.7f), glm::vec3(1, 1, 1)}) {
        const WindSettings settings{.direction = direction, .cone_angle = 20.0f};
        const auto cone = windCone(settings);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(direction));
        const double cosine = std::cos(20.0 * std::numbers::pi / 180.0);
        glm::dvec3 sum{0.0};
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(glm::length(cone[i]), 1.0, kExact);
            EXPECT_NEAR(glm::dot(cone[i], axis), cosine, kExact);
            // The sideways parts are at right angles, so the product is that of the parts along the
            // axis.
            EXPECT_NEAR(glm::dot(cone[i], cone[(i + 1) % 4]), cosine * cosine, kExact);
            sum += cone[i];
        }
        EXPECT_LT(glm::length(sum - 4.0 * cosine * axis), kExact);
    }
}

TEST(WindCone, IsTheDirectionAtNoAngle) {
    for (const glm::dvec3& v : windCone({.direction = {0, 0, 2}, .cone_angle = 0.0f}))
        EXPECT_LT(glm::length(v - glm::dvec3(0, 0, 1)), kExact);
}

// Along +x, worked out by hand: y is the first axis with the smallest component, so u = x X y = z
// and v = x X z = -y.
TEST(WindCone, HasTheDocumentedOrder) {
    const auto cone = windCone({.direction = {1, 0, 0}, .cone_angle = 30.0f});
    const double c = std::sqrt(3.0) / 2.0;
    EXPECT_LT(glm::length(cone[0] - glm::dvec3(c, 0, 0.5)), kExact);
    EXPECT_LT(glm::length(cone[1] - glm::dvec3(c, -0.5, 0)), kExact);
    EXPECT_LT(glm::length(cone[2] - glm::dvec3(c, 0, -0.5)), kExact);
    EXPECT_LT(glm::length(cone[3] - glm::dvec3(c, 0.5, 0)), kExact);
}

TEST(WindCone, RefusesADirectionWithoutLength) {
    EXPECT_THROW(windCone({.direction = {0, 0, 0}}), engine::Error);
}

TEST(WindMagnitude, FollowsEquation13) {
    const WindSettings settings{.gust_rate = 2.0f};
    EXPECT_EQ(windMagnitude(settings, 0.0), 0.5);
    EXPECT_NEAR(windMagnitude(settings, std::numbers::pi / 4.0), 1.5, kExact);
    EXPECT_NEAR(windMagnitude(settings, std::numbers::pi / 8.0), 1.0, kExact);
}

TEST(ReferenceWind, WeighsWithNumbersThatSumToOne) {
    double mean = 0.0;
    for (std::uint32_t strand = 0; strand < 1000; ++strand) {
        const auto weights = reference::windWeights(1, strand);
        double sum = 0.0;
        for (const double weight : weights) {
            EXPECT_GE(weight, 0.0);
            sum += weight;
        }
        EXPECT_NEAR(sum, 1.0, kExact);
        mean += weights[0] / 1000.0;
    }
    // The mean is 1/4 by symmetry. The deviation of one weight is at most 1/4, and of the mean
    // 0.008.
    EXPECT_NEAR(mean, 0.25, 0.03);
}

TEST(ReferenceWind, BlowsInsideTheCone) {
    const WindSettings settings{.strength = 15.0f};
    const glm::dvec3 even = reference::strandWind(settings, {0.25, 0.25, 0.25, 0.25});
    const double cosine = std::cos(20.0 * std::numbers::pi / 180.0);
    EXPECT_LT(glm::length(even - glm::dvec3(15.0 * cosine, 0, 0)), 1e-9);
    const auto cone = windCone(settings);
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<double, 4> weights{};
        weights[i] = 1.0;
        EXPECT_LT(glm::length(reference::strandWind(settings, weights) - 15.0 * cone[i]), 1e-9);
    }
}

// Equation 14, worked out by hand. T = y, W = (3, 4, 5): (T x W) x T = (3, 0, 5). T = (1, 1, 0) /
// sqrt 2, W = x: W - T (T W) = (1/2, -1/2, 0). Along the tangent there is no acceleration, nor
// without a tangent.
TEST(ReferenceWind, FollowsEquation14) {
    const std::vector<glm::dvec3> up{{0, 0, 0}, {0, 2, 0}, {0, 2, 0}};
    const auto across = reference::windAccelerations(up, {3, 4, 5}, 0.5);
    EXPECT_EQ(across[0], glm::dvec3(0.0));
    EXPECT_LT(glm::length(across[1] - glm::dvec3(1.5, 0, 2.5)), kExact);
    EXPECT_EQ(across[2], glm::dvec3(0.0));
    const std::vector<glm::dvec3> slanted{{1, 1, 1}, {3, 3, 1}, {5, 3, 1}};
    const auto sideways = reference::windAccelerations(slanted, {1, 0, 0}, 1.0);
    EXPECT_LT(glm::length(sideways[1] - glm::dvec3(0.5, -0.5, 0)), kExact);
    EXPECT_LT(glm::length(sideways[2]), kExact);
}

}  // namespace
}  // namespace hair::simulation
