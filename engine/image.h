#pragma once

#include <string>

#include "engine/device.h"

struct VmaAllocation_T;

namespace engine {

struct ImageDescription {
    VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    std::uint32_t width = 1;   // px
    std::uint32_t height = 1;  // px
    std::uint32_t samples = 1;
    std::uint32_t levels = 1;  // each half as large as the one before
    VkImageUsageFlags usage = 0;
    std::string name;
};

// A 2D image with its memory and a view of all of it.
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

private:
    VmaAllocator_T* allocator_;
    VmaAllocation_T* allocation_{};
    VkFormat format_;
    VkExtent2D extent_;
    VkImageAspectFlags aspect_;
    VkImage image_{};
    Handle<VkImageView, &vkDestroyImageView> view_;
    MemoryLedger::Line line_;
};

}  // namespace engine
