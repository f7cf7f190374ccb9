#include "engine/image.h"

#include <utility>

#include "engine/memory.h"

namespace engine {

Image::Image(const Device& device, const ImageDescription& description)
    : allocator_(device.allocator()), format_(description.format),
      extent_{description.width, description.height},
      aspect_(
          description.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                     : VK_IMAGE_ASPECT_COLOR_BIT) {
    VkImageCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = format_;
    create.extent = {extent_.width, extent_.height, 1};
    create.mipLevels = description.levels;
    create.arrayLayers = 1;
    create.samples = static_cast<VkSampleCountFlagBits>(description.samples);
    create.tiling = VK_IMAGE_TILING_OPTIMAL;
    create.usage = description.usage;
    create.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    create.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    VmaAllocationCreateInfo allocate{};
    allocate.usage = VMA_MEMORY_USAGE_AUTO;
    if (const VkResult result =
            vmaCreateImage(allocator_, &create, &allocate, &image_, &allocation_, nullptr);
        result != VK_SUCCESS) {
        throw Error(
            "image '" + description.name + "' of " + std::to_string(extent_.width) + " x " +
                std::to_string(extent_.height) + " px, " + std::to_string(description.samples) +
                " samples",
            resultName(result));
    }

    line_ = device.memoryLine(allocation_, description.name);

    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = image_;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_;
    view.subresourceRange = {aspect_, 0, description.levels, 0, 1};
    VkImageView handle{};
    check(vkCreateImageView(device.get(), &view, nullptr, &handle), "create an image view");
    view_ = {device.get(), handle};
    device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image_), description.name);
}

Image::Image(Image&& other) noexcept
    : allocator_(other.allocator_), allocation_(std::exchange(other.allocation_, nullptr)),
      format_(other.format_), extent_(other.extent_), aspect_(other.aspect_),
      image_(std::exchange(other.image_, VkImage{})), view_(std::move(other.view_)),
      line_(std::move(other.line_)) {}

Image::~Image() {
    view_ = {};
    if (image_) vmaDestroyImage(allocator_, image_, allocation_);
}

}  // namespace engine
