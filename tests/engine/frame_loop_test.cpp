#include "engine/frame_loop.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/target.h"
#include "tests/gpu_fixture.h"
#include "tests/largest_difference.h"
#include "tests/required.h"

namespace engine {
namespace {

class FrameLoopTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        big_.emplace(
            device(), BufferDescription{.size = 64 << 20, .name = "big", .purpose = "tests"});
        small_.emplace(
            device(), BufferDescription{.size = 1 << 10, .name = "small", .purpose = "tests"});
    }

    void TearDown() override {
        big_.reset();
        small_.reset();
        GpuTest::TearDown();
    }

    // Two passes of very different cost. The first has two parts.
    void record(Passes& passes) {
        const auto fill = [&](const Buffer& buffer) {
            return [&](Commands& commands) { commands.fill(buffer, 1); };
        };
        passes.pass("big", PassKind::compute, fill(*big_));
        passes.pass("small", PassKind::compute, fill(*small_));
        passes.pass("big", PassKind::compute, fill(*big_));
        slots_.push_back(passes.slot());
    }

    // Overlapped frames have a timestamp after each pass.
    std::vector<FrameRecord> play(Timing timing, int frames, std::uint32_t in_flight = 2) {
        FrameLoop loop(
            device(), timing, {.frames = in_flight, .timestamps = TimestampPlacement::passes});
        slots_.clear();
        for (int i = 0; i < frames; ++i) loop.frame([&](Passes& passes) { record(passes); });
        return loop.finish();
    }

    std::optional<Buffer> big_;
    std::optional<Buffer> small_;
    std::vector<std::uint32_t> slots_;
};

TEST_F(FrameLoopTest, SumsPassesOfOneNameInEveryTimedMode) {
    for (const Timing timing : {Timing::overlapped, Timing::isolated, Timing::wall_clock}) {
        const std::vector<FrameRecord> frames = play(timing, 3);
        ASSERT_EQ(frames.size(), 3u);
        for (const FrameRecord& frame : frames) {
            ASSERT_EQ(frame.passes.size(), 2u);
            EXPECT_EQ(frame.passes[0].name, "big");
            EXPECT_EQ(frame.passes[1].name, "small");
            EXPECT_GE(frame.passes[1].milliseconds, 0.0);
            EXPECT_GT(frame.interval, 0.0);
        }
    }
}

TEST_F(FrameLoopTest, ChargesWorkToThePassThatDidIt) {
    // 128 MiB against 1 KiB: despite disturbances, the order is correct in the fastest frame.
    for (const Timing timing : {Timing::isolated, Timing::wall_clock}) {
        Extremes big;
        Extremes small;
        for (const FrameRecord& frame : play(timing, 5)) {
            big.add(frame.passes[0].milliseconds);
            small.add(frame.passes[1].milliseconds);
        }
        EXPECT_GT(big.least(), small.least());
    }
}

TEST_F(FrameLoopTest, KeepsAsManyFramesInFlightAsAskedForWhenOverlapped) {
    play(Timing::overlapped, 4);
    EXPECT_EQ(slots_, (std::vector<std::uint32_t>{0, 1, 0, 1}));
    play(Timing::overlapped, 3, 1);
    EXPECT_EQ(slots_, (std::vector<std::uint32_t>{0, 0, 0}));
    play(Timing::overlapped, 5, 4);
    EXPECT_EQ(slots_, (std::vector<std::uint32_t>{0, 1, 2, 3, 0}));
    play(Timing::isolated, 3, 4);
    EXPECT_EQ(slots_, (std::vector<std::uint32_t>{0, 0, 0}));
}

// The passes' times are then unknown, not 0.
TEST_F(FrameLoopTest, StampsOverlappedFramesAtTheirEndsOnlyWhereNotAskedForMore) {
    FrameLoop loop(device(), Timing::overlapped);
    for (int i = 0; i < 3; ++i) loop.frame([&](Passes& passes) { record(passes); });
    for (const FrameRecord& frame : loop.finish()) {
        EXPECT_GT(frame.device, 0.0);
        EXPECT_TRUE(frame.passes.empty());
    }
}

// Two barriers and two timestamps take less than filling 64 MiB, despite disturbances.
TEST_F(FrameLoopTest, TellsWhatAnEmptyPassTakes) {
    const std::optional<double> empty = emptyPassTime(device());
    ASSERT_EQ(empty.has_value(), device().info().timestamp_valid_bits > 0);
    if (!empty) return;
    Extremes big;
    for (const FrameRecord& frame : play(Timing::isolated, 5))
        big.add(frame.passes[0].milliseconds);
    EXPECT_GE(*empty, 0.0);
    EXPECT_LT(*empty, big.least());
}

// An interval consists of waiting, recording and submitting in sequence, by one clock.
TEST_F(FrameLoopTest, SharesOutTheTimeOfTheCpu) {
    for (const Timing timing : {Timing::overlapped, Timing::isolated})
        for (const FrameRecord& frame : play(timing, 4)) {
            EXPECT_GE(frame.wait, 0.0);
            EXPECT_GT(frame.record, 0.0);
            EXPECT_GT(frame.submit, 0.0);
            // 1 us for the rounding of sums in ms.
            EXPECT_LE(frame.wait + frame.record + frame.submit, frame.interval + 1e-3);
        }
}

// A frame's device time runs from its first timestamp to its last. In an overlapped frame, a pass
// starts at the timestamp that ends the one before, so the passes add up to the whole. Isolated
// passes have barriers between them that belong to no pass. No time is counted twice.
TEST_F(FrameLoopTest, SharesOutTheTimeOfTheDevice) {
    constexpr double kRounding = 1e-6;  // 1 ns: of sums in ms
    const auto passSum = [](const FrameRecord& frame) {
        double sum = 0.0;
        for (const PassTime& pass : frame.passes) sum += pass.milliseconds;
        return sum;
    };
    for (const FrameRecord& frame : play(Timing::overlapped, 4)) {
        EXPECT_GT(frame.device, 0.0);
        EXPECT_NEAR(passSum(frame), frame.device.value(), kRounding);
    }
    for (const FrameRecord& frame : play(Timing::isolated, 4)) {
        EXPECT_GT(frame.device, 0.0);
        EXPECT_LE(passSum(frame), frame.device.value() + kRounding);
    }
    for (const FrameRecord& frame : play(Timing::wall_clock, 2))
        EXPECT_NEAR(passSum(frame), frame.wall, kRounding);
}

// A frame's use includes its passes and the work between them.
TEST_F(FrameLoopTest, TellsWhatFramesAndPassesUseOfTheCpu) {
    double all = 0.0;
    for (const FrameRecord& frame : play(Timing::wall_clock, 5)) {
        double passes = 0.0;
        for (const PassTime& pass : frame.passes) {
            EXPECT_GE(pass.use.cpu, 0.0);
            passes += pass.use.cpu;
        }
        EXPECT_LE(passes, frame.use.cpu + 1e-3);
        all += passes;
    }
    // On a software device, filling 640 MiB uses CPU time.
    if (device().info().type == engine::DeviceType::cpu) {
        EXPECT_GT(all, 0.0);
    }
}

TEST_F(FrameLoopTest, GivesTheFramesSinceTheLastTime) {
    FrameLoop loop(device(), Timing::overlapped);
    loop.frame([&](Passes& passes) { record(passes); });
    EXPECT_EQ(loop.finish().size(), 1u);
    EXPECT_TRUE(loop.finish().empty());
    for (int i = 0; i < 3; ++i) loop.frame([&](Passes& passes) { record(passes); });
    EXPECT_EQ(loop.finish().size(), 3u);
}

// The queue runs isolated frames one after another, so none begins before the last one ended.
TEST_F(FrameLoopTest, TellsHowLongTheQueueHadNoWork) {
    if (!play(Timing::isolated, 1)[0].device) GTEST_SKIP() << "no timestamps";
    for (const Timing timing : {Timing::overlapped, Timing::isolated}) {
        const std::vector<FrameRecord> frames = play(timing, 4);
        ASSERT_EQ(frames.size(), 4u);
        EXPECT_FALSE(frames[0].gap.has_value());
        for (std::size_t i = 1; i < frames.size(); ++i) {
            ASSERT_TRUE(frames[i].gap.has_value());
            if (timing == Timing::isolated) {
                EXPECT_GE(*frames[i].gap, 0.0);
                // Both stamps are taken between the host's start of one frame and its end of the
                // other.
                EXPECT_LE(*frames[i].gap, frames[i - 1].interval + frames[i].interval);
            }
        }
    }
    for (const FrameRecord& frame : play(Timing::wall_clock, 2))
        EXPECT_FALSE(frame.gap.has_value());
}

// Batches of one loop are one series of frames.
TEST_F(FrameLoopTest, TellsTheGapBetweenTwoBatches) {
    if (!play(Timing::isolated, 1)[0].device) GTEST_SKIP() << "no timestamps";
    FrameLoop loop(device(), Timing::isolated);
    for (const bool is_first : {true, false}) {
        loop.frame([&](Passes& passes) { record(passes); });
        const std::vector<FrameRecord> frames = loop.finish();
        ASSERT_EQ(frames.size(), 1u);
        EXPECT_EQ(frames[0].gap.has_value(), !is_first);
    }
}

TEST_F(FrameLoopTest, CountsNothingForAGraphicsPassThatDrawsNothing) {
    if (!device().hasPipelineStatistics()) GTEST_SKIP() << "no pipeline statistics";
    const Target target(device(), {.width = 8, .height = 8, .msaa = 1, .ssaa = 1});
    FrameLoop loop(device(), Timing::statistics);
    loop.frame([&](Passes& passes) {
        passes.pass("empty", PassKind::graphics, [&](Commands& commands) {
            target.beginRendering(commands, Load::clear, {0.0f, 0.0f, 0.0f});
            target.endRendering(commands);
        });
    });
    const std::vector<FrameRecord> frames = loop.finish();
    ASSERT_EQ(frames.size(), 1u);
    ASSERT_EQ(frames[0].statistics.size(), 1u);
    EXPECT_EQ(frames[0].statistics[0].counts, StatisticCounts{});
}

}  // namespace
}  // namespace engine
