#include "engine/buffer_image.h"

#include <stdexcept>
#include <utility>

#include "engine/memory.h"

namespace engine {
namespace {

VmaAllocationCreateFlags allocationFlags(Usage usage) {
    if (usage == Usage::storage) return 0;
    return VMA_ALLOCATION_CREATE_MAPPED_BIT |
           (usage == Usage::upload ? VMA_ALLOCATION_CREATE_HOST_ACCESS_SEQUENTIAL_WRITE_BIT
                                   : VMA_ALLOCATION_CREATE_HOST_ACCESS_RANDOM_BIT);
}

// Returns whether the device that owns the allocator was given up.
bool ownerIsGivenUp(VmaAllocator allocator) {
    VmaAllocatorInfo info{};
    vmaGetAllocatorInfo(allocator, &info);
    return isGivenUp(info.device);
}

}  // namespace

// ---- Buffers ------------------------------------------------------------------------------------

Buffer::Buffer(const Device& device, const BufferDescription& description) : Buffer() {
    allocator_ = device.allocator();
    size_ = description.size;
    VkBufferCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    create.size = description.size;
    create.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                   VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                   VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    if (device.has(Feature::ray_queries))
        create.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                        VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    const std::vector<std::uint32_t> families = device.queueFamilies();
    create.sharingMode =
        families.size() > 1 ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE;
    create.queueFamilyIndexCount = static_cast<std::uint32_t>(families.size());
    create.pQueueFamilyIndices = families.data();

    VmaAllocationCreateInfo allocate{};
    allocate.flags = allocationFlags(description.usage);
    allocate.usage = VMA_MEMORY_USAGE_AUTO;
    // Coherent memory needs no flushes.
    if (description.usage != Usage::storage) {
        allocate.requiredFlags =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    }

    VmaAllocationInfo allocated{};
    const VkResult result =
        vmaCreateBuffer(allocator_, &create, &allocate, &buffer_, &allocation_, &allocated);
    if (result != VK_SUCCESS) {
        throw Error(
            "buffer '" + description.name + "' of " + std::to_string(description.size) + " B",
            resultName(result));
    }
    mapped_ = allocated.pMappedData;
    const VkBufferDeviceAddressInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .pNext = nullptr, .buffer = buffer_};
    address_ = vkGetBufferDeviceAddress(device.get(), &info);
    device.setName(
        VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), description.name);
    tracked_ = device.track(
        allocation_, {.memory = {.name = description.name, .purpose = description.purpose},
                      .bytes = size_,
                      .address = address_,
                      .mapped = mapped_ ? mapped() : std::span<std::byte>{}});
    hazards_ = device.hazards();
}

Buffer::~Buffer() {
    if (buffer_ && !ownerIsGivenUp(allocator_)) vmaDestroyBuffer(allocator_, buffer_, allocation_);
}

void Buffer::swap(Buffer& other) noexcept {
    std::swap(allocator_, other.allocator_);
    std::swap(allocation_, other.allocation_);
    std::swap(buffer_, other.buffer_);
    std::swap(address_, other.address_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    std::swap(tracked_, other.tracked_);
    std::swap(hazards_, other.hazards_);
}

TexelView::TexelView(const Device& device, const Buffer& buffer, VkFormat format) {
    const VkBufferViewCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .buffer = buffer.get(),
        .format = format,
        .offset = 0,
        .range = VK_WHOLE_SIZE};
    VkBufferView view{};
    check(vkCreateBufferView(device.get(), &create, nullptr, &view), "create a buffer's view");
    view_ = {device.get(), view};
}

// ---- Rows ---------------------------------------------------------------------------------------

namespace {

std::uint64_t texelBytes(VkFormat format) {
    switch (format) {
    case VK_FORMAT_R16_SFLOAT:
        return 2;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
        return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
        return 16;
    default:  // D32, and colours of 8 bits
        return 4;
    }
}

}  // namespace

std::uint64_t imageBytes(const ImageDescription& description) {
    std::uint64_t texels = 0;
    for (std::uint32_t level = 0; level < description.levels; ++level)
        texels += std::uint64_t{std::max(description.width >> level, 1u)} *
                  std::max(description.height >> level, 1u);
    return texels * description.samples * texelBytes(description.format);
}

const MemoryRows::Row& MemoryRows::at(std::string_view name) const {
    const auto row = std::ranges::find(
        rows_, name, [](const Row& each) -> std::string_view { return each.of.name; });
    if (row == rows_.end()) throw std::out_of_range("no row is named '" + std::string(name) + "'");
    return *row;
}

BufferDescription MemoryRows::operator[](std::string_view name) const {
    const auto& [row, purpose] = at(name);
    return {.size = row.size, .usage = row.usage, .name = row.name, .purpose = purpose};
}

std::uint64_t MemoryRows::bytes() const {
    std::uint64_t sum = 0;
    for (const auto& [row, purpose] : rows_) sum += std::uint64_t{row.copies} * row.size;
    return sum;
}

// ---- Images -------------------------------------------------------------------------------------

// Sets the members that need no Vulkan call.
Image::Image(VmaAllocator_T* allocator, const ImageDescription& description)
    : allocator_(allocator), format_(description.format),
      extent_{description.width, description.height},
      aspect_(
          description.format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                     : VK_IMAGE_ASPECT_COLOR_BIT) {}

Image::Image(const Device& device, const ImageDescription& description)
    : Image(device.allocator(), description) {
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
    tracked_ = device.track(
        allocation_, {.memory = {.name = description.name, .purpose = description.purpose},
                      .bytes = imageBytes(description)});
}

Image::Image(Image&& other) noexcept
    : allocator_(other.allocator_), allocation_(std::exchange(other.allocation_, nullptr)),
      format_(other.format_), extent_(other.extent_), aspect_(other.aspect_),
      image_(std::exchange(other.image_, VkImage{})), view_(std::move(other.view_)),
      tracked_(std::move(other.tracked_)) {}

Image::~Image() {
    view_ = {};
    if (image_ && !ownerIsGivenUp(allocator_)) vmaDestroyImage(allocator_, image_, allocation_);
}

// ---- Samplers -----------------------------------------------------------------------------------

Sampler::Sampler(const Device& device, const SamplerDescription& description) {
    VkSamplerCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    create.magFilter = create.minFilter = description.filter;
    create.mipmapMode = description.filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                               : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    create.addressModeU = description.horizontal;
    create.addressModeV = description.vertical;
    create.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    create.maxLod = VK_LOD_CLAMP_NONE;
    VkSampler sampler{};
    check(vkCreateSampler(device.get(), &create, nullptr, &sampler), "create a sampler");
    sampler_ = {device.get(), sampler};
}

}  // namespace engine
