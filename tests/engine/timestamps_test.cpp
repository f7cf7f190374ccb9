#include "engine/queries.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "engine/transfer.h"
#include "tests/gpu_fixture.h"

namespace engine {
namespace {

TEST(TimestampTicks, MaskHasTheValidBits) {
    EXPECT_EQ(validMask(64), ~std::uint64_t{0});
    EXPECT_EQ(validMask(36), 0xF'FFFF'FFFFu);
    EXPECT_EQ(validMask(1), 1u);
}

TEST(TimestampTicks, CountAcrossTheWrapOfACounter) {
    EXPECT_EQ(ticksBetween(10, 25, validMask(64)), 15u);
    EXPECT_EQ(ticksBetween(0xFFFF'FFF0, 0x10, validMask(32)), 0x20u);
    // Bits above the valid ones are undefined and must not count.
    EXPECT_EQ(ticksBetween(0xA00'0000'0005, 0xC00'0000'0009, validMask(40)), 4u);
}

using TimestampsTest = GpuTest;

TEST_F(TimestampsTest, NeverRunBackwards) {
    Timestamps timestamps(device(), 4);
    runOnce(device(), [&](Commands& commands) {
        for (int i = 0; i < 4; ++i) timestamps.write(commands);
    });
    const std::span<const double> times = timestamps.read();
    ASSERT_EQ(times.size(), 4u);
    EXPECT_EQ(times[0], 0.0);
    for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GE(times[i], times[i - 1]);
}

TEST_F(TimestampsTest, RefuseOneMoreThanThereIsRoomFor) {
    Timestamps timestamps(device(), 2);
    runOnce(device(), [&](Commands& commands) {
        timestamps.write(commands);
        timestamps.write(commands);
        EXPECT_THROW(timestamps.write(commands), Error);
    });
}

TEST_F(TimestampsTest, AreGoneAfterReset) {
    Timestamps timestamps(device(), 2);
    runOnce(device(), [&](Commands& commands) { timestamps.write(commands); });
    EXPECT_EQ(timestamps.read().size(), 1u);
    timestamps.reset();
    EXPECT_EQ(timestamps.count(), 0u);
    EXPECT_TRUE(timestamps.read().empty());
}

// Frames with different numbers of timestamps follow each other. Each finds its queries reset,
// which the validation layer checks, and reads no timestamp of an earlier frame. Some drivers reset
// every query by a separate command, so only the written ones are reset.
TEST_F(TimestampsTest, AreResetByTheNumberWritten) {
    static std::vector<std::pair<std::uint32_t, std::uint32_t>> resets;  // first, count
    static PFN_vkResetQueryPool reset_pool = nullptr;
    resets.clear();
    Timestamps timestamps(device(), 1024);
    reset_pool = std::exchange(
        vkResetQueryPool,
        [](VkDevice device, VkQueryPool pool, std::uint32_t first, std::uint32_t count) {
            resets.emplace_back(first, count);
            reset_pool(device, pool, first, count);
        });
    for (const std::size_t count : {5u, 2u, 0u, 1024u, 3u, 5u}) {
        timestamps.reset();
        runOnce(device(), [&](Commands& commands) {
            for (std::size_t i = 0; i < count; ++i) timestamps.write(commands);
        });
        const std::span<const double> times = timestamps.read();
        EXPECT_EQ(times.size(), count);
        for (const double time : times) EXPECT_GE(time, 0.0);
    }
    vkResetQueryPool = reset_pool;
    using Reset = std::pair<std::uint32_t, std::uint32_t>;
    const std::vector<Reset> written{{0, 5}, {0, 2}, {0, 1024}, {0, 3}};
    EXPECT_EQ(resets, written);
}

// Two crystal clocks differ by less than 1e-3; a wrong tick length gives a much larger error.
TEST_F(TimestampsTest, RunAtTheRateThatTheirPeriodSays) {
    const std::optional<double> rate = timestampRate(device());
    if (!rate) GTEST_SKIP() << "device and host have no clock in common";
    EXPECT_NEAR(*rate, 1.0, 1e-3);
}

}  // namespace
}  // namespace engine
