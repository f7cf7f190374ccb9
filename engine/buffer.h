#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/device.h"

struct VmaAllocation_T;

namespace engine {

enum class Usage {
    storage,   // device-local; shaders read and write it by address
    upload,    // host-visible, mapped; written by the CPU, read by the device
    readback,  // host-visible and cached, mapped; written by the device, read by the CPU
};

struct BufferDescription {
    std::size_t size = 0;  // B
    Usage usage = Usage::storage;
    std::string name;
};

// A buffer with its memory. Its contents start undefined.
class Buffer {
public:
    Buffer() = default;
    Buffer(const Device& device, const BufferDescription& description);
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        swap(other);
        return *this;
    }
    ~Buffer();

    VkBuffer get() const { return buffer_; }
    VkDeviceAddress address() const { return address_; }
    std::size_t size() const { return size_; }

    // The mapped bytes of an upload or readback buffer.
    std::span<std::byte> mapped() const { return {static_cast<std::byte*>(mapped_), size_}; }

    template <class Value>
    void write(const Value& value) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::memcpy(mapped_, &value, sizeof value);
    }

private:
    void swap(Buffer& other) noexcept;

    VmaAllocator_T* allocator_{};
    VmaAllocation_T* allocation_{};
    VkBuffer buffer_{};
    VkDeviceAddress address_ = 0;
    std::size_t size_ = 0;
    void* mapped_ = nullptr;
    MemoryLedger::Line line_;
};

}  // namespace engine
