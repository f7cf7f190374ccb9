#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
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
    Purpose purpose;
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
    TrackedResources::Id tracked() const { return tracked_.id(); }
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
        if (hazards_) hazards_->hostWrites(tracked_.id());
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
    TrackedResources::Entry tracked_;
    HazardLog* hazards_ = nullptr;
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
    Purpose purpose;
};

// Returns the bytes of an image's texels, over all samples and levels, without driver overhead.
std::uint64_t imageBytes(const ImageDescription& description);

// Returns the bytes of `count` values, or of one if there are none, because a buffer has a size.
template <class Value>
constexpr std::size_t bytesOf(std::uint64_t count) {
    return static_cast<std::size_t>(std::max<std::uint64_t>(count, 1)) * sizeof(Value);
}

// A buffer of a part of a case, before it is made.
struct BufferRow {
    std::string name;
    std::size_t size = 0;  // B
    std::uint32_t copies = 1;  // equal buffers
    Usage usage = Usage::storage;
    bool at_most = false;  // the contents decide, which are not known before
};

// All buffers and images of a part of a case. They are made from these rows, and the memory that a
// case needs is the sum of the same rows.
class MemoryRows {
public:
    MemoryRows() = default;
    MemoryRows(Purpose purpose, std::initializer_list<BufferRow> rows) { add(purpose, rows); }

    void add(Purpose purpose, std::initializer_list<BufferRow> rows) {
        for (const BufferRow& row : rows) rows_.push_back({row, purpose});
    }
    void add(const ImageDescription& image) {
        rows_.push_back({{image.name, static_cast<std::size_t>(imageBytes(image))}, image.purpose});
    }
    void add(const MemoryRows& part) {
        rows_.insert(rows_.end(), part.rows_.begin(), part.rows_.end());
    }

    struct Row {
        BufferRow of;
        Purpose purpose;
    };
    const std::vector<Row>& all() const { return rows_; }
    // Returns the row of this name, and the buffer that it describes. These throw std::out_of_range
    // if there is none.
    const Row& at(std::string_view name) const;
    BufferDescription operator[](std::string_view name) const;

    // Returns the sum of all rows.
    std::uint64_t bytes() const;

private:
    std::vector<Row> rows_;
};

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
    TrackedResources::Entry tracked_;
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
