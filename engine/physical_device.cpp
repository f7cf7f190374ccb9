#include "engine/physical_device.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>

namespace engine {

namespace {

template <class Struct>
struct Feature {
    const char* name;
    VkBool32 Struct::* member;
};

constexpr std::array kCoreFeatures{
    Feature{"tessellationShader", &VkPhysicalDeviceFeatures::tessellationShader},
    Feature{"geometryShader", &VkPhysicalDeviceFeatures::geometryShader},
    Feature{"shaderInt64", &VkPhysicalDeviceFeatures::shaderInt64},
};

// Taken where the device has them.
constexpr std::array kOptionalCoreFeatures{
    Feature{"pipelineStatisticsQuery", &VkPhysicalDeviceFeatures::pipelineStatisticsQuery},
    Feature{"independentBlend", &VkPhysicalDeviceFeatures::independentBlend},
    Feature{"fragmentStoresAndAtomics", &VkPhysicalDeviceFeatures::fragmentStoresAndAtomics},
    Feature{
        "vertexPipelineStoresAndAtomics",
        &VkPhysicalDeviceFeatures::vertexPipelineStoresAndAtomics},
    Feature{"occlusionQueryPrecise", &VkPhysicalDeviceFeatures::occlusionQueryPrecise},
};

constexpr std::array kVulkan12Features{
    Feature{"bufferDeviceAddress", &VkPhysicalDeviceVulkan12Features::bufferDeviceAddress},
    Feature{"scalarBlockLayout", &VkPhysicalDeviceVulkan12Features::scalarBlockLayout},
    Feature{"timelineSemaphore", &VkPhysicalDeviceVulkan12Features::timelineSemaphore},
    Feature{"hostQueryReset", &VkPhysicalDeviceVulkan12Features::hostQueryReset},
};

constexpr std::array kVulkan13Features{
    Feature{"dynamicRendering", &VkPhysicalDeviceVulkan13Features::dynamicRendering},
    Feature{"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
    Feature{"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4},
};

constexpr std::array kExtensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};

template <class Struct, std::size_t Count>
void appendMissing(
    const Struct& available, const std::array<Feature<Struct>, Count>& wanted,
    std::vector<std::string>& missing) {
    for (const auto& feature : wanted) {
        if (!(available.*feature.member)) missing.push_back("feature " + std::string(feature.name));
    }
}

template <class Struct, std::size_t Count>
void enable(Struct& features, const std::array<Feature<Struct>, Count>& wanted) {
    for (const auto& feature : wanted) features.*feature.member = VK_TRUE;
}

void appendMissingExtensions(VkPhysicalDevice device, std::vector<std::string>& missing) {
    std::uint32_t count = 0;
    check(
        vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
        "list the device's extensions");
    std::vector<VkExtensionProperties> available(count);
    check(
        vkEnumerateDeviceExtensionProperties(device, nullptr, &count, available.data()),
        "list the device's extensions");
    for (const char* wanted : kExtensions) {
        const bool found = std::ranges::any_of(available, [&](const auto& extension) {
            return std::strcmp(extension.extensionName, wanted) == 0;
        });
        if (!found) missing.push_back("extension " + std::string(wanted));
    }
}

std::string typeName(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "cpu";
    default:
        return "other";
    }
}

std::string versionText(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

void findQueueFamily(DeviceInfo& info) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(info.handle, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(info.handle, &count, families.data());
    constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::ranges::find_if(
        families, [](const auto& each) { return (each.queueFlags & kWanted) == kWanted; });
    if (family == families.end()) {
        info.missing.emplace_back("queue with graphics and compute");
        return;
    }
    info.queue_family = static_cast<std::uint32_t>(family - families.begin());
    info.timestamp_valid_bits = family->timestampValidBits;
}

DeviceInfo inspect(VkPhysicalDevice device) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    const VkPhysicalDeviceProperties& core = properties.properties;

    DeviceInfo info;
    info.handle = device;
    info.name = core.deviceName;
    info.type = typeName(core.deviceType);
    info.driver = driver.driverName;
    info.driver_version = driver.driverInfo;
    info.driver_id = driver.driverID;
    info.api_version = versionText(core.apiVersion);
    info.limits = core.limits;
    if (core.apiVersion < VK_API_VERSION_1_3) {
        info.missing.push_back("Vulkan 1.3 (it has " + info.api_version + ")");
        return info;
    }

    VkPhysicalDeviceVulkan13Features vulkan13{};
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    VkPhysicalDeviceVulkan12Features vulkan12{};
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.pNext = &vulkan13;
    VkPhysicalDeviceFeatures2 available{};
    available.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    available.pNext = &vulkan12;
    vkGetPhysicalDeviceFeatures2(device, &available);
    appendMissing(available.features, kCoreFeatures, info.missing);
    appendMissing(vulkan12, kVulkan12Features, info.missing);
    appendMissing(vulkan13, kVulkan13Features, info.missing);
    appendMissingExtensions(device, info.missing);
    findQueueFamily(info);
    return info;
}

std::string lowerCase(std::string text) {
    std::ranges::transform(
        text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string describe(const std::vector<DeviceInfo>& devices) {
    std::string text;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        text += (i ? "; " : "") + std::to_string(i) + ": " + devices[i].name;
        for (const std::string& missing : devices[i].missing) text += ", lacks " + missing;
    }
    return text.empty() ? "none" : text;
}

}  // namespace

RequiredFeatures::RequiredFeatures() {
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    core.pNext = &vulkan12;
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.pNext = &vulkan13;
    vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    enable(core.features, kCoreFeatures);
    enable(vulkan12, kVulkan12Features);
    enable(vulkan13, kVulkan13Features);
}

void enableOptionalFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures& features) {
    VkPhysicalDeviceFeatures available{};
    vkGetPhysicalDeviceFeatures(device, &available);
    for (const auto& feature : kOptionalCoreFeatures) {
        features.*feature.member = available.*feature.member;
    }
}

std::vector<const char*> requiredExtensions() { return {kExtensions.begin(), kExtensions.end()}; }

std::vector<DeviceInfo> listDevices(const Instance& instance) {
    std::vector<DeviceInfo> devices;
    for (VkPhysicalDevice device : instance.physicalDevices()) devices.push_back(inspect(device));
    return devices;
}

DeviceInfo chooseDevice(const Instance& instance, const std::string& wanted) {
    const std::vector<DeviceInfo> devices = listDevices(instance);
    const std::string all = "; devices: " + describe(devices);
    if (!wanted.empty()) {
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const bool named =
                wanted == std::to_string(i) ||
                lowerCase(devices[i].name).find(lowerCase(wanted)) != std::string::npos;
            if (!named) continue;
            if (devices[i].missing.empty()) return devices[i];
            throw NoDevice("device '" + wanted + "' can't run hairbench" + all);
        }
        throw NoDevice("no device is named '" + wanted + "'" + all);
    }
    for (const char* type : {"discrete", "integrated", "virtual", "cpu", "other"}) {
        for (const DeviceInfo& device : devices) {
            if (device.type == type && device.missing.empty()) return device;
        }
    }
    throw NoDevice("no Vulkan device can run hairbench" + all);
}

}  // namespace engine
