#include "benchmarks/viewer/toolbar.h"

#include <cmath>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace benchmarks::viewer {
namespace {

const Sphere kGroom{{0.01f, -0.03f, 0.02f}, 0.2f};

hair::WindSettings wind(hair::WindMode mode, float value, glm::vec3 direction) {
    hair::WindSettings wind;
    wind.mode = mode;
    wind.direction = direction;
    setWind(wind, value);
    return wind;
}

TEST(WindArrow, PointsWhereTheWindBlows) {
    const hair::WindSettings blows = wind(hair::WindMode::thesis, 6.0f, {0, -3, 4});
    const glm::vec3 arrow = windTip(blows, kGroom) - kGroom.center;
    EXPECT_LT(glm::length(glm::normalize(arrow) - glm::vec3(0, -0.6f, 0.8f)), 1e-6f);
}

TEST(WindArrow, IsLongerTheStrongerTheWind) {
    float before = 0.0f;
    for (const float strength : {0.0f, 0.5f, 3.0f, 15.0f, 200.0f, 1500.0f}) {
        const auto tip = windTip(wind(hair::WindMode::thesis, strength, {1, 0, 0}), kGroom);
        const float length = glm::length(tip - kGroom.center);
        EXPECT_GT(length, before) << strength;
        before = length;
    }
    EXPECT_LT(before, 5.0f * kGroom.radius);  // a storm is still near the groom
}

TEST(WindArrow, TipSetsTheWindThatHasIt) {
    for (const hair::WindMode mode : {hair::WindMode::thesis, hair::WindMode::drag}) {
        for (const float value : {0.1f, 2.0f, 15.0f, 90.0f}) {
            const hair::WindSettings wanted = wind(mode, value, {0.48f, 0.6f, -0.64f});
            hair::WindSettings set = wind(mode, 1.0f, {1, 0, 0});
            setWindTip(set, kGroom, windTip(wanted, kGroom));
            EXPECT_EQ(set.mode, mode);
            // Float rounding of an exponential.
            EXPECT_NEAR(windOf(set), value, 1e-4f * value + 1e-5f);
            EXPECT_LT(glm::length(set.direction - wanted.direction), 1e-5f);
        }
    }
}

TEST(WindArrow, KeepsADirectionInStillAir) {
    hair::WindSettings set = wind(hair::WindMode::thesis, 5.0f, {0, 0, 1});
    setWindTip(set, kGroom, kGroom.center);
    EXPECT_EQ(windOf(set), 0.0f);
    EXPECT_EQ(set.direction, glm::vec3(0, 0, 1));
}

// Limits of the settings: /simulation/wind in the scene's schema.
TEST(WindArrow, StaysWithinTheLimits) {
    hair::WindSettings set = wind(hair::WindMode::thesis, 1.0f, {1, 0, 0});
    setWindTip(set, kGroom, {1000.0f, 0, 0});
    EXPECT_EQ(set.strength, 1500.0f);
    set.mode = hair::WindMode::drag;
    setWindTip(set, kGroom, {1000.0f, 0, 0});
    EXPECT_EQ(set.speed, 100.0f);
    EXPECT_EQ(set.strength, 1500.0f);  // unchanged, because it belongs to the other mode
}

TEST(WindArrow, GivesAWindWithoutADirectionOne) {
    hair::WindSettings set;
    set.direction = {0, 0, 0};
    setWind(set, 3.0f);
    EXPECT_NEAR(glm::length(set.direction), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace benchmarks::viewer
