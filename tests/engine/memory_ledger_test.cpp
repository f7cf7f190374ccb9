#include "engine/device.h"

#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "tests/gpu_fixture.h"

namespace engine {
namespace {

const MemoryEntry kPositions{
    .heap = 0, .device_local = true, .name = "positions", .purpose = "tests"};
const MemoryEntry kStaging{.heap = 1, .device_local = false, .name = "staging", .purpose = "tests"};

std::uint64_t bytesOf(const TrackedResources& resources, const MemoryEntry& entry) {
    const MemoryLedger ledger = resources.memory();
    const auto found = ledger.find(entry);
    return found == ledger.end() ? 0 : found->second;
}

std::uint64_t bytesNamed(const MemoryLedger& ledger, const std::string& name) {
    std::uint64_t sum = 0;
    for (const auto& [entry, bytes] : ledger)
        if (entry.name == name) sum += bytes;
    return sum;
}

TEST(MemoryLedger, HoldsAResourceWhileItsOwnerLives) {
    TrackedResources resources;
    {
        const auto entry = resources.add({.memory = kPositions, .allocated = 100});
        EXPECT_EQ(bytesOf(resources, kPositions), 100u);
    }
    EXPECT_TRUE(resources.memory().empty());
}

TEST(MemoryLedger, AddsUpResourcesOfOneNameAndKeepsOthersApart) {
    TrackedResources resources;
    std::optional first = resources.add({.memory = kPositions, .allocated = 100});
    const auto second = resources.add({.memory = kPositions, .allocated = 20});
    const auto third = resources.add({.memory = kStaging, .allocated = 3});
    EXPECT_EQ(bytesOf(resources, kPositions), 120u);
    EXPECT_EQ(bytesOf(resources, kStaging), 3u);
    first.reset();
    EXPECT_EQ(bytesOf(resources, kPositions), 20u);
}

TEST(MemoryLedger, CountsAResourceOnceHoweverItMoves) {
    TrackedResources resources;
    auto entry = resources.add({.memory = kPositions, .allocated = 100});
    auto moved(std::move(entry));
    EXPECT_EQ(bytesOf(resources, kPositions), 100u);
    {
        auto other = resources.add({.memory = kStaging, .allocated = 3});
        other = std::move(moved);
        EXPECT_EQ(bytesOf(resources, kPositions), 100u);
    }
    EXPECT_EQ(bytesOf(resources, kPositions), 0u);
}

using DeviceMemoryTest = GpuTest;

TEST_F(DeviceMemoryTest, OfABufferEntersAndLeavesTheLedger) {
    const std::uint64_t before = device().allocatedBytes();
    {
        Buffer buffer(device(), {.size = 5000, .name = "ledger test", .purpose = "tests"});
        EXPECT_GE(bytesNamed(device().memory(), "ledger test"), 5000u);
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
        const Buffer moved(std::move(buffer));
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
        const Buffer host(
            device(),
            {.size = 64, .usage = Usage::upload, .name = "ledger test", .purpose = "tests"});
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
                       .name = "ledger test",
                       .purpose = "tests"});
        EXPECT_GE(bytesNamed(device().memory(), "ledger test"), 64u * 32u * 4u);
        EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), device().allocatedBytes() - before);
    }
    EXPECT_EQ(bytesNamed(device().memory(), "ledger test"), 0u);
}

}  // namespace
}  // namespace engine
