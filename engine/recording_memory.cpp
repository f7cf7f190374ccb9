#include "engine/recording_memory.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

namespace engine {

namespace {

constexpr std::size_t kSlabBytes = 1 << 16;

}  // namespace

void* RecordingMemory::allocate(
    void* self, std::size_t size, std::size_t alignment, VkSystemAllocationScope) {
    auto& memory = *static_cast<RecordingMemory*>(self);
    const std::size_t units = (sizeof(Header) + size + kUnit - 1) / kUnit;
    const auto kind = static_cast<std::size_t>(std::bit_width(units - 1));
    if (kind >= kKinds || alignment > alignof(Header)) return allocateAlone(size, alignment);
    if (!memory.free_[kind] && !memory.addBlocks(kind)) return nullptr;
    Header* const block = memory.free_[kind];
    memory.free_[kind] = static_cast<Header*>(block->place);
    block->size = size;
    return block + 1;
}

void* RecordingMemory::allocateAlone(std::size_t size, std::size_t alignment) {
    std::size_t space = size + alignment;
    auto* const place = static_cast<std::byte*>(std::malloc(sizeof(Header) + space));
    if (!place) return nullptr;
    void* given = place + sizeof(Header);
    std::align(alignment, size, given, space);
    new (&headerOf(given)) Header{place, size, kKinds};
    return given;
}

bool RecordingMemory::addBlocks(std::size_t kind) {
    try {
        slabs_.push_back(std::make_unique<std::byte[]>(kSlabBytes));
    } catch (const std::bad_alloc&) {
        return false;
    }
    const std::size_t step = kUnit << kind;
    for (std::size_t end = kSlabBytes; end > 0; end -= step)
        free_[kind] = new (slabs_.back().get() + end - step) Header{free_[kind], 0, kind};
    return true;
}

void* RecordingMemory::reallocate(
    void* self, void* given, std::size_t size, std::size_t alignment,
    VkSystemAllocationScope scope) {
    if (size == 0) {
        release(self, given);
        return nullptr;
    }
    void* const made = allocate(self, size, alignment, scope);
    if (given && made) {
        std::memcpy(made, given, std::min(size, headerOf(given).size));
        release(self, given);
    }
    return made;
}

void RecordingMemory::release(void* self, void* given) {
    if (!given) return;
    Header& header = headerOf(given);
    if (header.kind == kKinds) return std::free(header.place);
    Header*& first = static_cast<RecordingMemory*>(self)->free_[header.kind];
    header.place = std::exchange(first, &header);
}

}  // namespace engine
