#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "engine/instance.h"

namespace engine {

// Host memory for a command pool's driver. Some drivers, such as lavapipe, allocate for each
// recorded command and free everything when the buffer is recorded again; malloc() isn't made for
// that. Power-of-two blocks are kept for the next frame; larger ones come from malloc(). Not
// thread-safe: drivers call these only within commands on the pool, on the command's thread, and
// one command at a time (Vulkan specification, Host Memory).
class RecordingMemory {
public:
    RecordingMemory() = default;
    RecordingMemory(const RecordingMemory&) = delete;
    RecordingMemory& operator=(const RecordingMemory&) = delete;

    // Valid during this object's lifetime. Allocation returns null without memory, as Vulkan
    // requires.
    const VkAllocationCallbacks* callbacks() const { return &callbacks_; }

private:
    static constexpr std::size_t kUnit = 64;  // bytes of the smallest blocks
    static constexpr std::size_t kKinds = 8;  // block sizes, 64 bytes to 8 KiB

    // Precedes the bytes handed out.
    struct alignas(std::max_align_t) Header {
        void* place;  // next free block, or malloc()'s pointer
        std::size_t size;  // bytes handed out
        std::size_t kind;  // size class of the block; kKinds: from malloc()
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
