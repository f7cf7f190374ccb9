#include "benchmarks/device_record.h"

#include <cstdio>
#include <limits>

namespace benchmarks {

namespace {

template <class Number>
struct Limit {
    const char* name;
    Number VkPhysicalDeviceLimits::* member;
};

// What decides which cases run here, and how their draws, groups and buffers are cut.
constexpr Limit<std::uint32_t> kCounts[] = {
    {"maxTessellationGenerationLevel", &VkPhysicalDeviceLimits::maxTessellationGenerationLevel},
    {"maxTessellationPatchSize", &VkPhysicalDeviceLimits::maxTessellationPatchSize},
    {"maxGeometryOutputVertices", &VkPhysicalDeviceLimits::maxGeometryOutputVertices},
    {"maxComputeWorkGroupInvocations", &VkPhysicalDeviceLimits::maxComputeWorkGroupInvocations},
    {"maxComputeSharedMemorySize", &VkPhysicalDeviceLimits::maxComputeSharedMemorySize},
    {"maxPushConstantsSize", &VkPhysicalDeviceLimits::maxPushConstantsSize},
    {"maxStorageBufferRange", &VkPhysicalDeviceLimits::maxStorageBufferRange},
    {"maxImageDimension2D", &VkPhysicalDeviceLimits::maxImageDimension2D},
    {"maxMemoryAllocationCount", &VkPhysicalDeviceLimits::maxMemoryAllocationCount},
    {"framebufferColorSampleCounts", &VkPhysicalDeviceLimits::framebufferColorSampleCounts},
    {"framebufferDepthSampleCounts", &VkPhysicalDeviceLimits::framebufferDepthSampleCounts},
};

// "10de:2336", as the PCI registry writes it; vendors without a PCI number are above 10000.
std::string idOf(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    char text[32];
    std::snprintf(text, sizeof text, "%04x:%04x", properties.vendorID, properties.deviceID);
    return text;
}

}  // namespace

DeviceRecord describeDevice(const engine::Device& of) {
    const engine::DeviceInfo& device = of.info();
    DeviceRecord record{
        .name = device.name,
        .type = device.type,
        .driver = device.driver,
        .driver_version = device.driver_version,
        .api_version = device.api_version,
        .timestamp_period_ns = double{device.limits.timestampPeriod},
        .id = idOf(device.handle),
        .timestamp_valid_bits = device.timestamp_valid_bits,
        .limits = {}};
    for (const auto& [name, member] : kCounts)
        record.limits.emplace_back(name, device.limits.*member);
    if (of.maxTessellatedVertices() != std::numeric_limits<std::uint32_t>::max())
        record.limits.emplace_back("maxTessellatedVertices", of.maxTessellatedVertices());
    return record;
}

}  // namespace benchmarks
