#include "benchmarks/measure/machine_watch.h"

#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks::measure {
namespace {

using testing::ElementsAre;

constexpr double kBusy = 0.5;
constexpr double kQuiet = 0.05;  // docs/measuring.md: above 5 % others disturb

// Plays a machine; nobody sleeps.
class QuietWaitTest : public testing::Test {
protected:
    // Each look takes the next of `loads_`, or the last one.
    std::optional<double> look(double seconds) {
        slept_ += seconds;
        const std::size_t place = std::min(looks_++, loads_.size() - 1);
        return loads_[place];
    }

    std::vector<std::optional<double>> loads_{kBusy};
    std::size_t looks_ = 0;
    double slept_ = 0.0;
    std::vector<double> told_;
    QuietWait wait_{
        [this](double seconds) { return look(seconds); },
        [this](double share) { told_.push_back(share); }};
};

TEST_F(QuietWaitTest, LooksOnceAtAQuietMachine) {
    loads_ = {kQuiet};
    for (int i = 0; i < 100; ++i) wait_.wait(10.0);
    EXPECT_EQ(looks_, 100u);
    EXPECT_THAT(told_, ElementsAre());
}

TEST_F(QuietWaitTest, EndsWhenOthersEnd) {
    loads_ = {kBusy, 0.06, kQuiet};
    wait_.wait(10.0);
    EXPECT_EQ(looks_, 3u);
    EXPECT_THAT(told_, ElementsAre(kBusy));
}

TEST_F(QuietWaitTest, IsBoundedForACaseAndForARun) {
    wait_.wait(60.0);
    EXPECT_NEAR(slept_, kMostQuietWait, kQuietLook);
    for (int i = 0; i < 100; ++i) wait_.wait(60.0);
    EXPECT_NEAR(slept_, kMostQuietWaits, kQuietLook);
    EXPECT_THAT(told_, ElementsAre(kBusy));  // once
}

TEST_F(QuietWaitTest, IsNoLongerThanACaseMayMeasure) {
    wait_.wait(1.0);
    EXPECT_LE(slept_, 1.0 + 1e-9);
    EXPECT_GE(slept_, 0.7);
}

// Whoever asks for counts waits for nothing.
TEST_F(QuietWaitTest, IsNoneWithoutTimeToMeasure) {
    wait_.wait(0.0);
    EXPECT_EQ(looks_, 0u);
}

TEST_F(QuietWaitTest, IsNoneWhereTheLoadIsUnknown) {
    loads_ = {std::nullopt};
    wait_.wait(10.0);
    EXPECT_EQ(looks_, 1u);
}

}  // namespace
}  // namespace benchmarks::measure
