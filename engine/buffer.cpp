#include "engine/buffer.h"

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

}  // namespace

Buffer::Buffer(const Device& device, const BufferDescription& description)
    : allocator_(device.allocator()), size_(description.size) {
    VkBufferCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    create.size = description.size;
    create.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                   VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                   VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    create.sharingMode = VK_SHARING_MODE_EXCLUSIVE;

    VmaAllocationCreateInfo allocate{};
    allocate.flags = allocationFlags(description.usage);
    allocate.usage = VMA_MEMORY_USAGE_AUTO;
    // Coherent memory: no flushes to forget.
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
    line_ = device.memoryLine(allocation_, description.name);
    mapped_ = allocated.pMappedData;
    const VkBufferDeviceAddressInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO, .pNext = nullptr, .buffer = buffer_};
    address_ = vkGetBufferDeviceAddress(device.get(), &info);
    device.setName(
        VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), description.name);
}

Buffer::~Buffer() {
    if (buffer_) vmaDestroyBuffer(allocator_, buffer_, allocation_);
}

void Buffer::swap(Buffer& other) noexcept {
    std::swap(allocator_, other.allocator_);
    std::swap(allocation_, other.allocation_);
    std::swap(buffer_, other.buffer_);
    std::swap(address_, other.address_);
    std::swap(size_, other.size_);
    std::swap(mapped_, other.mapped_);
    std::swap(line_, other.line_);
}

}  // namespace engine
