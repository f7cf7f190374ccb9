#include "hair/simulation/simulation.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace hair::simulation {
namespace {

// Times are floats in the settings, so the tests start from floats too.
constexpr float kSixtieth = 1.0f / 60.0f;

std::vector<std::uint32_t> stepsOf(FixedStep steps, float frame_time, int frames) {
    std::vector<std::uint32_t> result;
    for (int i = 0; i < frames; ++i) result.push_back(steps.stepsFor(double{frame_time}));
    return result;
}

TEST(FixedStep, TakesOneStepAFrameWhenTheyAreEqual) {
    for (const float time : {kSixtieth, 1.0f / 144.0f, 0.0005f, 0.1f, 0.0123f}) {
        const auto steps = stepsOf(FixedStep(double{time}), time, 100000);
        EXPECT_EQ(steps, std::vector<std::uint32_t>(100000, 1)) << time;
    }
}

TEST(FixedStep, TakesTwoStepsAFrameAtThirtyHertz) {
    const auto steps = stepsOf(FixedStep(double{kSixtieth}), 1.0f / 30.0f, 10000);
    EXPECT_EQ(steps, std::vector<std::uint32_t>(10000, 2));
}

// 144 frames take 60 steps: 5 in every 12 frames, and never two in one frame.
TEST(FixedStep, SpreadsSixtyStepsOverAHundredAndFortyFourFrames) {
    const auto steps = stepsOf(FixedStep(double{kSixtieth}), 1.0f / 144.0f, 144000);
    for (std::size_t i = 0; i < steps.size(); i += 12)
        ASSERT_EQ(
            std::accumulate(
                steps.begin() + static_cast<std::ptrdiff_t>(i),
                steps.begin() + static_cast<std::ptrdiff_t>(i + 12), 0u),
            5u)
            << i;
    for (const std::uint32_t count : steps) ASSERT_LE(count, 1u);
}

TEST(FixedStep, TakesNoStepInNoTime) {
    FixedStep steps(double{kSixtieth});
    for (int i = 0; i < 100; ++i) EXPECT_EQ(steps.stepsFor(0.0), 0u);
    EXPECT_EQ(steps.stepsFor(double{kSixtieth}), 1u);
}

// 1/60 s has 16 2/3 steps of 1 ms. The floats are off by less than 1e-7.
TEST(FixedStep, TakesManyStepsAFrame) {
    const auto steps = stepsOf(FixedStep(0.001), kSixtieth, 3000);
    const std::uint32_t total = std::accumulate(steps.begin(), steps.end(), 0u);
    EXPECT_NEAR(total, 50000, 1);
    EXPECT_EQ(stepsOf(FixedStep(0.0005), 1.0f, 1).front(), 2000u);
}

TEST(FixedStep, FollowsFramesOfChangingLength) {
    FixedStep steps(0.25);
    EXPECT_EQ(steps.stepsFor(0.125), 0u);
    EXPECT_EQ(steps.stepsFor(0.25), 1u);
    EXPECT_EQ(steps.stepsFor(0.125), 1u);
    EXPECT_EQ(steps.stepsFor(1.125), 4u);
    steps.reset();
    EXPECT_EQ(steps.stepsFor(0.125), 0u);
}

}  // namespace
}  // namespace hair::simulation
