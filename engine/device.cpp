#include "engine/device.h"

#include <array>
#include <limits>

#include "engine/commands.h"
#include "engine/memory.h"
#include "engine/shader_library.h"

namespace engine {

namespace {

VmaAllocator createAllocator(VkInstance instance, const DeviceInfo& info, VkDevice device) {
    VmaVulkanFunctions functions{};
    functions.vkGetInstanceProcAddr = vkGetInstanceProcAddr;
    functions.vkGetDeviceProcAddr = vkGetDeviceProcAddr;
    VmaAllocatorCreateInfo create{};
    create.flags = VMA_ALLOCATOR_CREATE_BUFFER_DEVICE_ADDRESS_BIT;
    create.physicalDevice = info.handle;
    create.device = device;
    create.instance = instance;
    create.vulkanApiVersion = VK_API_VERSION_1_3;
    create.pVulkanFunctions = &functions;
    VmaAllocator allocator{};
    check(vmaCreateAllocator(&create, &allocator), "create the memory allocator");
    return allocator;
}

}  // namespace

Device::Device(const DeviceOptions& options)
    : instance_(options.validation, options.window_extensions),
      info_(chooseDevice(instance_, options.wanted)) {
    RequiredFeatures features;
    enableOptionalFeatures(info_.handle, features.core.features);
    features_ = features.core.features;

    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue{
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .queueFamilyIndex = info_.queue_family,
        .queueCount = 1,
        .pQueuePriorities = &priority};
    std::vector<const char*> extensions = requiredExtensions();
    if (!options.window_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    const VkDeviceCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &features.core,
        .flags = 0,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .enabledLayerCount = 0,
        .ppEnabledLayerNames = nullptr,
        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data(),
        .pEnabledFeatures = nullptr};
    check(vkCreateDevice(info_.handle, &create, nullptr, &device_), "create the Vulkan device");
    volkLoadDevice(device_);
    vkGetDeviceQueue(device_, info_.queue_family, 0, &queue_);
    allocator_ = createAllocator(instance_.get(), info_, device_);
    memory_ = std::make_unique<MemoryLedger>();
    shaders_ = std::make_unique<ShaderLibrary>();
    cache_ = std::make_unique<PipelineCache>(device_, info_);

    const VkCommandPoolCreateInfo pool{
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .pNext = nullptr,
        .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
        .queueFamilyIndex = info_.queue_family};
    VkCommandPool handle{};
    check(vkCreateCommandPool(device_, &pool, nullptr, &handle), "create a command pool");
    pool_ = {device_, handle};
    const VkFenceCreateInfo fence{
        .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .pNext = nullptr, .flags = 0};
    VkFence fence_handle{};
    check(vkCreateFence(device_, &fence, nullptr, &fence_handle), "create a fence");
    fence_ = {device_, fence_handle};
}

Device::~Device() {
    vkDeviceWaitIdle(device_);
    pool_ = {};
    fence_ = {};
    cache_.reset();
    vmaDestroyAllocator(allocator_);
    vkDestroyDevice(device_, nullptr);
}

std::uint32_t Device::maxTessellatedVertices() const {
    return info_.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE
               ? 65536
               : std::numeric_limits<std::uint32_t>::max();
}

bool Device::supportsSamples(std::uint32_t samples) const {
    return (info_.limits.framebufferColorSampleCounts & info_.limits.framebufferDepthSampleCounts &
            samples) != 0;
}

bool Device::supportsBlending(VkFormat format) const {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(info_.handle, format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

bool Device::fragmentCountsAreApproximate() const {
    return info_.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE &&
           info_.driver_version.starts_with("Mesa 22");
}

std::uint64_t Device::allocatedBytes() const {
    VmaTotalStatistics statistics{};
    vmaCalculateStatistics(allocator_, &statistics);
    return statistics.total.statistics.allocationBytes;
}

MemoryLedger::Line Device::memoryLine(VmaAllocation_T* allocation, const std::string& name) const {
    VmaAllocationInfo info{};
    vmaGetAllocationInfo(allocator_, allocation, &info);
    const VkPhysicalDeviceMemoryProperties* memory{};
    vmaGetMemoryProperties(allocator_, &memory);
    const VkMemoryType& type = memory->memoryTypes[info.memoryType];
    const bool device_local = (type.propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
    return {*memory_, {type.heapIndex, device_local, name}, info.size};
}

void Device::setName(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!vkSetDebugUtilsObjectNameEXT) return;
    const VkDebugUtilsObjectNameInfoEXT info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .pNext = nullptr,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name.c_str()};
    vkSetDebugUtilsObjectNameEXT(device_, &info);
}

void Device::runOnce(const std::function<void(Commands&)>& record) const {
    const VkCommandBufferAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .pNext = nullptr,
        .commandPool = pool_.get(),
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    VkCommandBuffer buffer{};
    check(vkAllocateCommandBuffers(device_, &allocate, &buffer), "allocate a command buffer");
    Commands commands(buffer);
    commands.begin();
    record(commands);
    commands.end();

    const VkCommandBufferSubmitInfo submitted{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .pNext = nullptr,
        .commandBuffer = buffer,
        .deviceMask = 0};
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &submitted;
    const VkFence fence = fence_.get();
    check(vkQueueSubmit2(queue_, 1, &submit, fence), "submit");
    check(
        vkWaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
        "wait for the device");
    check(vkResetFences(device_, 1, &fence), "reset a fence");
    vkFreeCommandBuffers(device_, pool_.get(), 1, &buffer);
}

}  // namespace engine
