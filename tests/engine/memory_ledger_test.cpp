#include "engine/device.h"

#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "tests/gpu_fixture.h"

namespace engine {
namespace {

const MemoryLedger::Entry kPositions{.heap = 0, .device_local = true, .name = "positions"};
const MemoryLedger::Entry kStaging{.heap = 1, .device_local = false, .name = "staging"};

std::uint64_t bytesOf(const MemoryLedger& ledger, const MemoryLedger::Entry& entry) {
    const auto found = ledger.bytes().find(entry);
    return found == ledger.bytes().end() ? 0 : found->second;
}

std::uint64_t bytesNamed(const MemoryLedger& ledger, const std::string& name) {
    std::uint64_t sum = 0;
    for (const auto& [entry, bytes] : ledger.bytes())
        if (entry.name == name) sum += bytes;
    return sum;
}

TEST(MemoryLedger, HoldsALineWhileItsOwnerLives) {
    MemoryLedger ledger;
    {
        const MemoryLedger::Line line(ledger, kPositions, 100);
        EXPECT_EQ(bytesOf(ledger, kPositions), 100u);
    }
    EXPECT_TRUE(ledger.bytes().empty());
}

TEST(MemoryLedger, AddsUpLinesOfOneNameAndKeepsOthersApart) {
    MemoryLedger ledger;
    std::optional<MemoryLedger::Line> first(std::in_place, ledger, kPositions, 100);
    const MemoryLedger::Line second(ledger, kPositions, 20);
    const MemoryLedger::Line third(ledger, kStaging, 3);
    EXPECT_EQ(bytesOf(ledger, kPositions), 120u);
    EXPECT_EQ(bytesOf(ledger, kStaging), 3u);
    first.reset();
    EXPECT_EQ(bytesOf(ledger, kPositions), 20u);
}

TEST(MemoryLedger, CountsALineOnceHoweverItMoves) {
    MemoryLedger ledger;
    MemoryLedger::Line line(ledger, kPositions, 100);
    MemoryLedger::Line moved(std::move(line));
    EXPECT_EQ(bytesOf(ledger, kPositions), 100u);
    {
        MemoryLedger::Line other(ledger, kStaging, 3);
        other = std::move(moved);
        EXPECT_EQ(bytesOf(ledger, kPositions), 100u);
    }
    EXPECT_EQ(bytesOf(ledger, kPositions), 0u);
}

using DeviceMemoryTest = GpuTest;

TEST_F(DeviceMemoryTest, OfABufferEntersAndLeavesTheLedger) {
    const std::uint64_t before = device().allocatedBytes();
    {
        Buffer buffer(device(), {.size = 5000, .name = "ledger test"});
        EXPECT_GE(bytesNamed(device().memory(), "ledger test"), 5000u);
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
        const Buffer moved(std::move(buffer));
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
        const Buffer host(device(), {.size = 64, .usage = Usage::upload, .name = "ledger test"});
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
    }
    EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), 0u);
    EXPECT_EQ(device().allocatedBytes(), before);
}

TEST_F(DeviceMemoryTest, OfAnImageEntersAndLeavesTheLedger) {
    const std::uint64_t before = device().allocatedBytes();
    {
        const Image image(
            device(), {.format = VK_FORMAT_R8G8B8A8_UNORM,
                       .width = 64,
                       .height = 32,
                       .usage = VK_IMAGE_USAGE_SAMPLED_BIT,
                       .name = "ledger test"});
        EXPECT_GE(bytesNamed(device().memory(), "ledger test"), 64u * 32u * 4u);
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
    }
    EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), 0u);
}

}  // namespace
}  // namespace engine
