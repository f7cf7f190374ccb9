#pragma once

#include <string>
#include <vector>

#include "engine/instance.h"

namespace engine {

// What a Vulkan device is and whether hairbench can run on it.
struct DeviceInfo {
    VkPhysicalDevice handle{};
    std::string name;
    std::string type;            // "discrete", "integrated", "virtual", "cpu" or "other"
    std::string driver;          // e.g. "llvmpipe"
    std::string driver_version;  // as the driver writes it, e.g. "Mesa 22.3.6 (LLVM 15.0.6)"
    std::string api_version;     // e.g. "1.3.230"
    VkDriverId driver_id{};
    VkPhysicalDeviceLimits limits{};
    std::uint32_t queue_family = 0;         // graphics, compute and transfer
    std::uint32_t timestamp_valid_bits = 0;  // of that family
    std::vector<std::string> missing;       // required features it lacks; empty: suitable
};

// All devices of the instance, as the driver orders them.
std::vector<DeviceInfo> listDevices(const Instance& instance);

// The device that `wanted` names by index or part of its name (any case); with an empty `wanted`
// the first of the best suitable type (discrete, integrated, virtual, cpu). Throws NoDevice with
// the reasons when there is none.
DeviceInfo chooseDevice(const Instance& instance, const std::string& wanted);

// The features every device must have, chained for vkCreateDevice.
struct RequiredFeatures {
    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceVulkan13Features vulkan13{};

    RequiredFeatures();
    RequiredFeatures(const RequiredFeatures&) = delete;
    RequiredFeatures& operator=(const RequiredFeatures&) = delete;
};

// Switches on the optional features that the device has.
void enableOptionalFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures& features);

std::vector<const char*> requiredExtensions();

}  // namespace engine
