#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "engine/instance.h"

namespace engine {

// Host memory for a command pool's driver. Some, lavapipe among them, take memory for each command
// recorded and give it all back when the buffer is recorded anew, for which malloc() isn't made.
// Blocks of powers of two are kept for the next frame; larger ones come from malloc(). Not
// thread-safe, as drivers call these only within commands on the pool, on the thread of the
// command, and of such commands there is one at a time: Vulkan specification, Host Memory.
class RecordingMemory {
public:
    RecordingMemory() = default;
    RecordingMemory(const RecordingMemory&) = delete;
    RecordingMemory& operator=(const RecordingMemory&) = delete;

    // Valid as long as this is. Null where there is no memory, as Vulkan asks.
    const VkAllocationCallbacks* callbacks() const { return &callbacks_; }

private:
    static constexpr std::size_t kUnit = 64;  // bytes, of the smallest blocks
    static constexpr std::size_t kKinds = 8;  // of blocks: 64 bytes to 8 KiB

    // What is before the bytes that are given.
    struct alignas(std::max_align_t) Header {
        void* place;  // of the next block that is free, or what malloc() gave
        std::size_t size;  // of the bytes given
        std::size_t kind;  // of the block; kKinds: it is malloc()'s
    };

    static VKAPI_ATTR void* VKAPI_CALL
    allocate(void* self, std::size_t size, std::size_t alignment, VkSystemAllocationScope scope);
    static VKAPI_ATTR void* VKAPI_CALL reallocate(
        void* self, void* given, std::size_t size, std::size_t alignment,
        VkSystemAllocationScope scope);
    static VKAPI_ATTR void VKAPI_CALL release(void* self, void* given);
    static Header& headerOf(void* given) { return *(static_cast<Header*>(given) - 1); }
    static void* allocateAlone(std::size_t size, std::size_t alignment);
    bool addBlocks(std::size_t kind);

    std::array<Header*, kKinds> free_{};
    std::vector<std::unique_ptr<std::byte[]>> slabs_;
    VkAllocationCallbacks callbacks_{this, &allocate, &reallocate, &release, nullptr, nullptr};
};

}  // namespace engine
