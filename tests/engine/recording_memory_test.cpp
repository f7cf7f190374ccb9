#include "engine/frame_loop.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace engine {
namespace {

constexpr VkSystemAllocationScope kCommand = VK_SYSTEM_ALLOCATION_SCOPE_OBJECT;

void* take(RecordingMemory& memory, std::size_t size, std::size_t alignment = 8) {
    const VkAllocationCallbacks& calls = *memory.callbacks();
    return calls.pfnAllocation(calls.pUserData, size, alignment, kCommand);
}

void* resize(RecordingMemory& memory, void* given, std::size_t size, std::size_t alignment = 8) {
    const VkAllocationCallbacks& calls = *memory.callbacks();
    return calls.pfnReallocation(calls.pUserData, given, size, alignment, kCommand);
}

void giveBack(RecordingMemory& memory, void* given) {
    const VkAllocationCallbacks& calls = *memory.callbacks();
    calls.pfnFree(calls.pUserData, given);
}

TEST(RecordingMemory, GivesWhatIsAskedForAlignedAndToOneAtATime) {
    RecordingMemory memory;
    std::mt19937 random(7);
    std::map<std::byte*, std::pair<std::size_t, std::byte>> taken;
    for (int turn = 0; turn < 20000; ++turn) {
        if (taken.size() > 200 || (!taken.empty() && random() % 3 == 0)) {
            const auto one =
                std::next(taken.begin(), static_cast<std::ptrdiff_t>(random() % taken.size()));
            const auto [size, value] = one->second;
            ASSERT_EQ(std::ranges::count(std::span(one->first, size), value), size);
            giveBack(memory, one->first);
            taken.erase(one);
            continue;
        }
        // Every block size and larger: 1 byte to 32 KiB, aligned to 1 to 256.
        const std::size_t size = 1 + random() % (std::size_t{1} << (random() % 16));
        const std::size_t alignment = std::size_t{1} << (random() % 9);
        auto* const given = static_cast<std::byte*>(take(memory, size, alignment));
        ASSERT_NE(given, nullptr);
        ASSERT_EQ(reinterpret_cast<std::uintptr_t>(given) % alignment, 0u);
        const auto value = static_cast<std::byte>(turn);
        std::fill_n(given, size, value);
        taken[given] = {size, value};
    }
    for (const auto& [given, rest] : taken) giveBack(memory, given);
}

TEST(RecordingMemory, HandsTheSameBlockOutAgain) {
    RecordingMemory memory;
    void* const first = take(memory, 100);
    giveBack(memory, first);
    EXPECT_EQ(take(memory, 150), first);  // rounds up to the same power of two
}

TEST(RecordingMemory, KeepsBytesWhereTheirNumberChanges) {
    RecordingMemory memory;
    auto* bytes = static_cast<std::uint8_t*>(resize(memory, nullptr, 10));
    for (std::uint8_t i = 0; i < 10; ++i) bytes[i] = i;
    for (const std::size_t size : {300, 100000, 200000, 20, 10}) {
        bytes = static_cast<std::uint8_t*>(resize(memory, bytes, size, size > 1000 ? 64 : 8));
        ASSERT_NE(bytes, nullptr);
        for (std::uint8_t i = 0; i < 10; ++i) ASSERT_EQ(bytes[i], i) << size;
    }
    EXPECT_EQ(resize(memory, bytes, 0), nullptr);
}

TEST(RecordingMemory, MindsNothingGivenBack) {
    RecordingMemory memory;
    giveBack(memory, nullptr);
    EXPECT_NE(take(memory, 0), nullptr);  // may be given out and returned
}

}  // namespace
}  // namespace engine
