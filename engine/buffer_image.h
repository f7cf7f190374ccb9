#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/device.h"
#include "engine/hazards.h"

struct VmaAllocation_T;

// Device buffers, images and samplers.
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

    // Mapped bytes of an upload or readback buffer.
    std::span<std::byte> mapped() const { return {static_cast<std::byte*>(mapped_), size_}; }

    // Writes to the start of the mapped bytes. No frame in flight may still read them.
    template <class Value>
    void write(const Value& value) const {
        static_assert(std::is_trivially_copyable_v<Value>);
        write(std::as_bytes(std::span(&value, 1)));
    }
    void write(std::span<const std::byte> bytes) const {
        known_.hostWrites();
        std::memcpy(mapped_, bytes.data(), bytes.size());
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
    TrackedResources::Entry tracked_;
    HazardLog::Entry known_;
};

// A uniform texel buffer view. The buffer must outlive it.
class TexelView {
public:
    TexelView() = default;
    TexelView(const Device& device, const Buffer& buffer, VkFormat format);

    VkBufferView get() const { return view_.get(); }
    // Address of the handle itself, for Commands::images().
    const VkBufferView* place() const { return view_.place(); }

private:
    Handle<VkBufferView, &vkDestroyBufferView> view_;
};

struct ImageDescription {
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    std::uint32_t width = 1;   // px
    std::uint32_t height = 1;  // px
    std::uint32_t samples = 1;
    std::uint32_t levels = 1;  // each half as large as the one before
    VkImageUsageFlags usage = 0;
    std::string name;
};

// Returns the bytes of an image's texels, over all samples and levels, without driver overhead.
std::uint64_t imageBytes(const ImageDescription& description);

// A 2D image with its memory and a view of the whole image.
class Image {
public:
    Image(const Device& device, const ImageDescription& description);
    Image(Image&& other) noexcept;
    Image& operator=(Image&&) = delete;
    ~Image();

    VkImage get() const { return image_; }
    VkImageView view() const { return view_.get(); }
    VkFormat format() const { return format_; }
    VkExtent2D extent() const { return extent_; }
    VkImageAspectFlags aspect() const { return aspect_; }
    TrackedResources::Id tracked() const { return tracked_.id(); }

private:
    Image(VmaAllocator_T* allocator, const ImageDescription& description);

    VmaAllocator_T* allocator_;
    VmaAllocation_T* allocation_{};
    VkFormat format_;
    VkExtent2D extent_;
    VkImageAspectFlags aspect_;
    VkImage image_{};
    Handle<VkImageView, &vkDestroyImageView> view_;
    MemoryLedger::Line line_;
    TrackedResources::Entry tracked_;
    HazardLog::Entry known_;
};

struct SamplerDescription {
    VkFilter filter = VK_FILTER_LINEAR;  // within a level and between levels
    VkSamplerAddressMode horizontal = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    VkSamplerAddressMode vertical = VK_SAMPLER_ADDRESS_MODE_REPEAT;
};

// How fragment shaders sample an image.
class Sampler {
public:
    Sampler(const Device& device, const SamplerDescription& description);

    VkSampler get() const { return sampler_.get(); }

private:
    Handle<VkSampler, &vkDestroySampler> sampler_;
};

}  // namespace engine
