#include "hair/simulation/stiffness.h"

#include <cmath>

#include <gtest/gtest.h>

#include "hair/simulation/solvers.h"

namespace hair::simulation {
namespace {

// time_step is a float: 1/60 is off by 5e-8, which enters squared.
constexpr double kStepRounding = 2e-7;

TEST(Stiffness, IsTheThesissNumberAtTheThesissParameters) {
    SimulationSettings settings;
    for (const float k : {0.0f, 0.002f, 0.01f, 0.3f, 0.95f}) {
        settings.global.stiffness = k;
        settings.local.stiffness = k;
        EXPECT_NEAR(globalStiffness(settings, stepOf(settings)), double{k}, kStepRounding);
        EXPECT_NEAR(
            localStiffness(settings, stepOf(settings), kReferenceSegment), double{k},
            kStepRounding);
    }
    EXPECT_NEAR(velocityKept(settings, stepOf(settings)), 0.95, kStepRounding);
}

TEST(Stiffness, IsRawInThesisScaling) {
    SimulationSettings settings;
    settings.stiffness_scaling = StiffnessScaling::thesis;
    settings.time_step = 0.1f;
    settings.local = {.stiffness = 0.25f, .iterations = 3};
    settings.global.stiffness = 0.5f;
    settings.friction = 0.25f;
    EXPECT_EQ(globalStiffness(settings, stepOf(settings)), 0.5);
    EXPECT_EQ(localStiffness(settings, stepOf(settings), 1.0), 0.25);
    EXPECT_EQ(velocityKept(settings, stepOf(settings)), 0.75);
}

// (1 - friction)^(dt / h0): 0.81 per 1/60 s is 0.9 per 1/120 s and 0.81^2 per 1/30 s.
TEST(Stiffness, KeepsTheSameVelocityPerSecond) {
    SimulationSettings settings;
    settings.friction = 0.19f;
    settings.time_step = 1.0f / 120.0f;
    EXPECT_NEAR(velocityKept(settings, stepOf(settings)), 0.9, kStepRounding);
    settings.time_step = 1.0f / 30.0f;
    EXPECT_NEAR(velocityKept(settings, stepOf(settings)), 0.81 * 0.81, kStepRounding);
}

// k = 1/2 is c = 1; half the step c = 1/4, k = 1/5; twice the step c = 4, k = 4/5.
TEST(Stiffness, ScalesTheGlobalFactorWithTheSquareOfTheStep) {
    SimulationSettings settings;
    settings.global.stiffness = 0.5f;
    settings.time_step = 1.0f / 120.0f;
    EXPECT_NEAR(globalStiffness(settings, stepOf(settings)), 0.2, kStepRounding);
    settings.time_step = 1.0f / 30.0f;
    EXPECT_NEAR(globalStiffness(settings, stepOf(settings)), 0.8, kStepRounding);
    settings.global.stiffness = 1.0f;
    EXPECT_EQ(globalStiffness(settings, stepOf(settings)), 1.0);
}

// Any number of iterations together leaves the same error as ten at k.
TEST(Stiffness, ComposesToTheSameLocalFactorAtAnyIterationCount) {
    SimulationSettings settings;
    settings.local.stiffness = 0.05f;
    for (const std::uint32_t iterations : {1u, 2u, 7u, 10u, 64u}) {
        settings.local.iterations = iterations;
        const double left = std::pow(
            1.0 - localStiffness(settings, stepOf(settings), kReferenceSegment), iterations);
        EXPECT_NEAR(left, std::pow(0.95, 10.0), kStepRounding);
    }
}

// Ten iterations at the reference leave one half of an error. The exponent of the remaining part is
// proportional to dt^2 / l^4.
TEST(Stiffness, ScalesTheLocalFactorWithStepAndSegmentLength) {
    SimulationSettings settings;
    settings.local.stiffness = static_cast<float>(1.0 - std::pow(0.5, 0.1));  // ten leave one half
    settings.local.iterations = 1;
    EXPECT_NEAR(localStiffness(settings, stepOf(settings), kReferenceSegment), 0.5, 1e-6);
    const double sixteenth = 1.0 - std::pow(0.5, 1.0 / 16.0);
    EXPECT_NEAR(
        localStiffness(settings, stepOf(settings), 2.0 * kReferenceSegment), sixteenth, 1e-6);
    settings.time_step = 1.0f / 240.0f;
    EXPECT_NEAR(localStiffness(settings, stepOf(settings), kReferenceSegment), sixteenth, 1e-6);
    EXPECT_NEAR(localStiffness(settings, stepOf(settings), 0.5 * kReferenceSegment), 0.5, 1e-6);
}

TEST(Stiffness, StaysInRangeAtTheEndsOfEveryParameter) {
    SimulationSettings settings;
    for (const float k : {0.0f, 1e-7f, 0.5f, 0.9999999f, 1.0f})
        for (const float step : {0.0005f, 0.1f})
            for (const std::uint32_t iterations : {0u, 1u, 64u})
                for (const double length : {0.0, 1e-30, 1e-4, 2.0, 1e30}) {
                    settings.time_step = step;
                    settings.global.stiffness = k;
                    settings.local = {.stiffness = k, .iterations = iterations};
                    const double local = localStiffness(settings, stepOf(settings), length);
                    const double global = globalStiffness(settings, stepOf(settings));
                    EXPECT_TRUE(local >= 0.0 && local <= kGreatestLocalStiffness) << local;
                    EXPECT_TRUE(global >= 0.0 && global <= 1.0) << global;
                }
}

}  // namespace
}  // namespace hair::simulation
