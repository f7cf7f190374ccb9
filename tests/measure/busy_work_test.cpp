#include "benchmarks/measure/stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/frame_loop.h"
#include "engine/transfer.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"
#include "tests/required.h"

namespace benchmarks::measure {
namespace {

using engine::PassKind;
using engine::Timing;

constexpr std::uint32_t kGroupSize = 64;
constexpr std::uint32_t kRounds = 16;

// The result of a work group's invocations after some steps, computed one number at a time.
std::uint32_t numberOf(std::uint32_t group, std::uint32_t steps) {
    std::uint32_t all = 0;
    for (std::uint32_t i = 0; i < kGroupSize; ++i) {
        std::uint64_t number = group * kGroupSize + i;
        for (std::uint32_t made = 0; made < steps * kRounds; ++made) {
            number = (1664525 * number + 1013904223) % 0x100000000;
            number = number ^ (number / 0x10000);
        }
        all ^= static_cast<std::uint32_t>(number);
    }
    return all;
}

class BusyWorkTest : public GpuTest {
protected:
    static BusyWork::Done doneOf(std::uint32_t steps) {
        const BusyWork work(device(), steps);
        runOnce(device(), [&](engine::Commands& commands) { work.record(commands); });
        return work.done();
    }
};

TEST_F(BusyWorkTest, DoesAsManyStepsAsAsked) {
    for (const std::uint32_t steps : {0u, 1u, 7u, 4096u, 4097u, 100000u})
        EXPECT_EQ(doneOf(steps).steps, steps);
}

// Four steps more than there are groups: the first four groups do two.
TEST_F(BusyWorkTest, DoesTheWorkOfEveryStep) {
    const std::uint32_t groups = BusyWork(device(), 0).groups();
    ASSERT_GT(groups, 5u);
    const std::vector<std::uint32_t> numbers = doneOf(groups + 4).numbers;
    ASSERT_EQ(numbers.size(), groups);
    for (const std::uint32_t group : {0u, 3u, 4u, 5u, groups - 1})
        EXPECT_EQ(numbers[group], numberOf(group, group < 4 ? 2 : 1)) << "group " << group;
    const std::vector<std::uint32_t> few = doneOf(3).numbers;
    EXPECT_EQ(few[2], numberOf(2, 1));
    EXPECT_EQ(few[3], 0u);
}

class BusyPassesTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (!isOver())
            buffer_.emplace(
                device(),
                engine::BufferDescription{.size = 64, .name = "busy", .purpose = "tests"});
    }
    void TearDown() override {
        buffer_.reset();
        GpuTest::TearDown();
    }

    void play(BusyPass& busy, engine::Timing timing) {
        engine::FrameLoop loop(
            device(), timing, {.timestamps = engine::TimestampPlacement::passes});
        for (int i = 0; i < 3; ++i)
            loop.frame([&](engine::Passes& passes) {
                BusyPasses slowed(passes, busy);
                EXPECT_EQ(slowed.slot(), passes.slot());
                for (const char* name : {"wind", "strands", "wind"})
                    slowed.pass(name, engine::PassKind::compute, [&](engine::Commands& commands) {
                        commands.fill(*buffer_, 1);
                    });
            });
        frames_ = loop.finish();
    }

    std::optional<engine::Buffer> buffer_;
    std::vector<engine::FrameRecord> frames_;
};

// Three frames; "wind" is recorded twice in each.
TEST_F(BusyPassesTest, AddsWorkWhereverThePassIs) {
    for (const engine::Timing timing :
         {engine::Timing::overlapped, engine::Timing::isolated, engine::Timing::wall_clock}) {
        BusyPass wind(device(), "wind", 10);
        play(wind, timing);
        EXPECT_EQ(wind.work().done().steps, 60u);
        BusyPass strands(device(), "strands", 10);
        play(strands, timing);
        EXPECT_EQ(strands.work().done().steps, 30u);
        ASSERT_EQ(frames_.size(), 3u);
        ASSERT_EQ(frames_[0].passes.size(), 2u);
        EXPECT_EQ(frames_[0].passes[0].name, "wind");
        EXPECT_EQ(frames_[0].passes[1].name, "strands");
    }
}

TEST_F(BusyPassesTest, KnowWhichPassesThereAre) {
    BusyPass known(device(), "strands", 0);
    play(known, engine::Timing::isolated);
    EXPECT_EQ(errorText([&] { known.checkThatItRan(); }), "no error");
    BusyPass unknown(device(), "strand", 5);
    play(unknown, engine::Timing::isolated);
    EXPECT_EQ(unknown.work().done().steps, 0u);
    EXPECT_EQ(
        errorText([&] { unknown.checkThatItRan(); }),
        "/run/busy_pass: unknown pass 'strand'; known: wind, strands");
}

}  // namespace
}  // namespace benchmarks::measure
