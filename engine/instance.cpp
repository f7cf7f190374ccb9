#include "engine/instance.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cstring>
#include <iterator>
#include <mutex>
#include <ranges>
#include <set>
#include <span>

#include <vulkan/vulkan_beta.h>

namespace engine {
namespace {

constexpr std::array kResultNames{
    std::pair{VK_NOT_READY, "VK_NOT_READY"},
    std::pair{VK_TIMEOUT, "VK_TIMEOUT"},
    std::pair{VK_INCOMPLETE, "VK_INCOMPLETE"},
    std::pair{VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
    std::pair{VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
    std::pair{VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
    std::pair{VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
    std::pair{VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED"},
    std::pair{VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT"},
    std::pair{VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
    std::pair{VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
    std::pair{VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER"},
    std::pair{VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
    std::pair{VK_ERROR_FORMAT_NOT_SUPPORTED, "VK_ERROR_FORMAT_NOT_SUPPORTED"},
    std::pair{VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN"},
    std::pair{VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY"},
    std::pair{VK_ERROR_FRAGMENTED_POOL, "VK_ERROR_FRAGMENTED_POOL"},
    std::pair{VK_ERROR_SURFACE_LOST_KHR, "VK_ERROR_SURFACE_LOST_KHR"},
    std::pair{VK_ERROR_OUT_OF_DATE_KHR, "VK_ERROR_OUT_OF_DATE_KHR"},
    std::pair{VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS, "VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS"},
};

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(
    VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
    const VkDebugUtilsMessengerCallbackDataEXT* data, void* log) {
    // Layers since 1.4 leave the identifier (VUID-..., SYNC-HAZARD-...) out of the text.
    const std::string id = data->pMessageIdName ? data->pMessageIdName : "";
    std::string text = data->pMessage;
    if (text.find(id) == std::string::npos) text = id + ": " + text;
    static_cast<MessageLog*>(log)->add(text);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(MessageLog& log) {
    return {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .pNext = nullptr,
        .flags = 0,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = onMessage,
        .pUserData = &log};
}

bool hasLayer(const char* name) {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "list the Vulkan layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "list the Vulkan layers");
    return std::ranges::any_of(
        layers, [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool hasExtension(const char* name) {
    std::uint32_t count = 0;
    vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data());
    return std::ranges::any_of(extensions, [&](const auto& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

// ---- Features -----------------------------------------------------------------------------------

template <class Struct>
struct RequiredFeature {
    const char* name;
    VkBool32 Struct::* member;
};

constexpr std::array kVulkan12Features{
    RequiredFeature{"bufferDeviceAddress", &VkPhysicalDeviceVulkan12Features::bufferDeviceAddress},
    RequiredFeature{"scalarBlockLayout", &VkPhysicalDeviceVulkan12Features::scalarBlockLayout},
    RequiredFeature{"timelineSemaphore", &VkPhysicalDeviceVulkan12Features::timelineSemaphore},
    RequiredFeature{"hostQueryReset", &VkPhysicalDeviceVulkan12Features::hostQueryReset},
};

constexpr std::array kVulkan13Features{
    RequiredFeature{"dynamicRendering", &VkPhysicalDeviceVulkan13Features::dynamicRendering},
    RequiredFeature{"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
    RequiredFeature{"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4},
};

// Source of a feature: a member of VkPhysicalDeviceFeatures, an extension, a format of colour
// attachments that can be blended, or a member of VkPhysicalDeviceVulkan12Features. A queue feature
// has no source, because it depends on the queue families. Neither does mesh_statistics, a member
// of an extension's struct.
struct FeatureRow {
    Feature feature;
    std::string_view name;
    VkBool32 VkPhysicalDeviceFeatures::* member;
    const char* extension;
    VkFormat blended = VK_FORMAT_UNDEFINED;
    VkBool32 VkPhysicalDeviceVulkan12Features::* member12 = nullptr;
};

constexpr std::array kFeatures{
    FeatureRow{
        Feature::tessellation, "tessellation stages with isolines",
        &VkPhysicalDeviceFeatures::tessellationShader, nullptr},
    FeatureRow{
        Feature::geometry, "geometry stages", &VkPhysicalDeviceFeatures::geometryShader, nullptr},
    FeatureRow{
        Feature::mesh_shader, "task and mesh stages", nullptr, VK_EXT_MESH_SHADER_EXTENSION_NAME},
    FeatureRow{Feature::ray_queries, "ray queries", nullptr, VK_KHR_RAY_QUERY_EXTENSION_NAME},
    FeatureRow{
        Feature::vertex_stores, "stores in vertex, tessellation and geometry stages",
        &VkPhysicalDeviceFeatures::vertexPipelineStoresAndAtomics, nullptr},
    FeatureRow{
        Feature::fragment_stores, "stores in fragment stages",
        &VkPhysicalDeviceFeatures::fragmentStoresAndAtomics, nullptr},
    FeatureRow{
        Feature::independent_blend, "independent blending",
        &VkPhysicalDeviceFeatures::independentBlend, nullptr},
    FeatureRow{
        Feature::float_blend, "blending of 32-bit floats", nullptr, nullptr,
        VK_FORMAT_R32G32B32A32_SFLOAT},
    FeatureRow{
        Feature::multi_draw, "several draws in one command",
        &VkPhysicalDeviceFeatures::multiDrawIndirect, nullptr},
    FeatureRow{
        Feature::long_integers, "64-bit integers in shaders",
        &VkPhysicalDeviceFeatures::shaderInt64, nullptr},
    FeatureRow{
        Feature::long_atomics, "atomics on 64-bit integers in buffers", nullptr, nullptr,
        VK_FORMAT_UNDEFINED, &VkPhysicalDeviceVulkan12Features::shaderBufferInt64Atomics},
    FeatureRow{
        Feature::pipeline_statistics, "pipeline statistics",
        &VkPhysicalDeviceFeatures::pipelineStatisticsQuery, nullptr},
    FeatureRow{Feature::mesh_statistics, "statistics of task and mesh stages", nullptr, nullptr},
    FeatureRow{
        Feature::sample_counts, "occlusion queries that count",
        &VkPhysicalDeviceFeatures::occlusionQueryPrecise, nullptr},
    FeatureRow{
        Feature::calibrated_timestamps, "calibrated timestamps", nullptr,
        VK_EXT_CALIBRATED_TIMESTAMPS_EXTENSION_NAME},
    FeatureRow{
        Feature::push_descriptors, "push descriptors", nullptr,
        VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME},
    FeatureRow{Feature::second_queue, "second queue that computes", nullptr, nullptr},
    FeatureRow{
        Feature::shader_figures, "figures of compiled shaders", nullptr,
        VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME},
    FeatureRow{
        Feature::memory_budget, "memory budget", nullptr, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME},
    FeatureRow{
        Feature::present_fences, "fences of presents", nullptr,
        VK_EXT_SWAPCHAIN_MAINTENANCE_1_EXTENSION_NAME},
};

// Other extensions that Feature::ray_queries needs.
constexpr std::array kAccelerationExtensions{
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};

// Instance extensions for Feature::present_fences.
constexpr std::array kPresentFenceExtensions{
    VK_KHR_GET_SURFACE_CAPABILITIES_2_EXTENSION_NAME, VK_EXT_SURFACE_MAINTENANCE_1_EXTENSION_NAME};

// Headers define it only with provisional extensions enabled. The number never changes.
constexpr auto kPortabilityFeaturesType = static_cast<VkStructureType>(1000163000);

template <class Struct, std::size_t Count>
void appendMissing(
    const Struct& available, const std::array<RequiredFeature<Struct>, Count>& wanted,
    std::vector<std::string>& missing) {
    for (const auto& feature : wanted) {
        if (!(available.*feature.member)) missing.push_back("feature " + std::string(feature.name));
    }
}

template <class Struct, std::size_t Count>
void enable(Struct& features, const std::array<RequiredFeature<Struct>, Count>& wanted) {
    for (const auto& feature : wanted) features.*feature.member = VK_TRUE;
}

// Chained structs of the features to query and enable.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 core{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceVulkan13Features vulkan13{};
    VkPhysicalDeviceSwapchainMaintenance1FeaturesEXT presents{};
    VkPhysicalDeviceMeshShaderFeaturesEXT meshes{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration{};
    VkPhysicalDeviceRayQueryFeaturesKHR rays{};
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR executables{};
    VkPhysicalDevicePortabilitySubsetFeaturesKHR portability{};

    // Adds an extension's struct only if the device has the extension.
    FeatureChain(
        bool is_portability, bool has_present_fences, bool has_mesh_shaders, bool has_ray_queries,
        bool has_shader_figures) {
        core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        core.pNext = &vulkan12;
        vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
        vulkan12.pNext = &vulkan13;
        vulkan13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        presents.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SWAPCHAIN_MAINTENANCE_1_FEATURES_EXT;
        meshes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_FEATURES_EXT;
        acceleration.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
        acceleration.pNext = &rays;
        rays.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
        executables.sType =
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
        portability.sType = kPortabilityFeaturesType;
        void** next = &vulkan13.pNext;
        if (has_present_fences) {
            *next = &presents;
            next = &presents.pNext;
        }
        if (has_mesh_shaders) {
            *next = &meshes;
            next = &meshes.pNext;
        }
        if (has_ray_queries) {
            *next = &acceleration;
            next = &rays.pNext;
        }
        if (has_shader_figures) {
            *next = &executables;
            next = &executables.pNext;
        }
        if (is_portability) *next = &portability;
    }
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

std::set<std::string> extensionsOf(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    check(
        vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
        "list the device's extensions");
    std::vector<VkExtensionProperties> available(count);
    check(
        vkEnumerateDeviceExtensionProperties(device, nullptr, &count, available.data()),
        "list the device's extensions");
    std::set<std::string> names;
    for (const VkExtensionProperties& extension : available) names.insert(extension.extensionName);
    return names;
}

bool canBlend(VkPhysicalDevice device, VkFormat format) {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(device, format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0;
}

bool hasRayQueries(const std::set<std::string>& extensions) {
    return extensions.contains(VK_KHR_RAY_QUERY_EXTENSION_NAME) &&
           std::ranges::all_of(kAccelerationExtensions, [&](const char* each) {
               return extensions.contains(each);
           });
}

void findFeatures(DeviceInfo& info) {
    const std::set<std::string> extensions = extensionsOf(info.handle);
    info.is_portability = extensions.contains(VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME);
    FeatureChain available(
        info.is_portability, extensions.contains(VK_EXT_SWAPCHAIN_MAINTENANCE_1_EXTENSION_NAME),
        extensions.contains(VK_EXT_MESH_SHADER_EXTENSION_NAME), hasRayQueries(extensions),
        extensions.contains(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME));
    vkGetPhysicalDeviceFeatures2(info.handle, &available.core);
    appendMissing(available.vulkan12, kVulkan12Features, info.missing);
    appendMissing(available.vulkan13, kVulkan13Features, info.missing);
    for (const FeatureRow& row : kFeatures) {
        const bool there = row.member      ? available.core.features.*row.member == VK_TRUE
                           : row.member12  ? available.vulkan12.*row.member12 == VK_TRUE
                           : row.extension ? extensions.contains(row.extension)
                           : row.blended   ? canBlend(info.handle, row.blended)
                                           : false;
        if (there) info.features.insert(row.feature);
    }
    if (info.is_portability && !available.portability.tessellationIsolines)
        info.features.erase(Feature::tessellation);
    if (!available.presents.swapchainMaintenance1) info.features.erase(Feature::present_fences);
    if (!available.meshes.taskShader || !available.meshes.meshShader)
        info.features.erase(Feature::mesh_shader);
    else if (available.meshes.meshShaderQueries)
        info.features.insert(Feature::mesh_statistics);
    if (!available.acceleration.accelerationStructure || !available.rays.rayQuery)
        info.features.erase(Feature::ray_queries);
}

VkPhysicalDeviceMeshShaderPropertiesEXT meshLimits(VkPhysicalDevice device) {
    VkPhysicalDeviceMeshShaderPropertiesEXT meshes{};
    meshes.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_PROPERTIES_EXT;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &meshes;
    vkGetPhysicalDeviceProperties2(device, &properties);
    meshes.pNext = nullptr;
    return meshes;
}

// ---- Devices ------------------------------------------------------------------------------------

DeviceType typeOf(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return DeviceType::discrete;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return DeviceType::integrated;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return DeviceType::virtual_gpu;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return DeviceType::cpu;
    default:
        return DeviceType::other;
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

    const auto other = [&](VkQueueFlags without) {
        return std::ranges::find_if(families, [&](const VkQueueFamilyProperties& each) {
            const bool same = &each == &*family;
            return (each.queueFlags & VK_QUEUE_COMPUTE_BIT) && !(each.queueFlags & without) &&
                   each.queueCount > (same ? 1u : 0u);
        });
    };
    auto second = other(VK_QUEUE_GRAPHICS_BIT);
    if (second == families.end()) second = other(0);
    info.compute_family = second == families.end()
                              ? info.queue_family
                              : static_cast<std::uint32_t>(second - families.begin());
    if (second != families.end()) info.features.insert(Feature::second_queue);
}

std::uint64_t largestLocalHeap(VkPhysicalDevice device) {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);
    std::uint64_t largest = 0;
    for (const VkMemoryHeap& heap : std::span(memory.memoryHeaps, memory.memoryHeapCount)) {
        if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            largest = std::max(largest, std::uint64_t{heap.size});
    }
    return largest;
}

DeviceInfo inspect(VkPhysicalDevice device) {
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    driver.pNext = &subgroup;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    const VkPhysicalDeviceProperties& core = properties.properties;

    DeviceInfo info;
    info.handle = device;
    info.name = core.deviceName;
    info.type = typeOf(core.deviceType);
    info.driver = driver.driverName;
    info.driver_version = driver.driverInfo;
    info.driver_id = driver.driverID;
    info.api_version = versionText(core.apiVersion);
    info.limits = core.limits;
    info.subgroup_size = subgroup.subgroupSize;
    info.local_bytes = largestLocalHeap(device);
    if (core.apiVersion < VK_API_VERSION_1_3) {
        info.missing.push_back("Vulkan 1.3 (it has " + info.api_version + ")");
        return info;
    }

    findFeatures(info);
    if (info.features.contains(Feature::mesh_shader)) info.mesh_limits = meshLimits(device);
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

// ---- Results of calls ---------------------------------------------------------------------------

std::string resultName(VkResult result) {
    for (const auto& [value, name] : kResultNames) {
        if (value == result) return name;
    }
    return "VkResult " + std::to_string(static_cast<int>(result));
}

namespace {

// Devices that were given up. They are never destroyed, so no other device gets their handle.
struct GivenUp {
    std::atomic<bool> any = false;
    std::mutex mutex;
    std::set<VkDevice> devices;
};

GivenUp& givenUp() {
    static GivenUp& all = *new GivenUp;  // never destroyed, because devices may be static too
    return all;
}

}  // namespace

Fence::Fence(VkDevice device) : device_(device) {
    const VkFenceCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, .pNext = nullptr, .flags = 0};
    VkFence fence{};
    check(vkCreateFence(device, &create, nullptr, &fence), "create a fence");
    fence_ = {device, fence};
}

VkFence Fence::ready() const {
    const VkFence fence = get();
    if (fence) check(vkResetFences(device_, 1, &fence), "reset a fence");
    return fence;
}

bool isGivenUp(VkDevice device) {
    if (!givenUp().any) return false;
    const std::lock_guard lock(givenUp().mutex);
    return givenUp().devices.contains(device);
}

void giveUp(VkDevice device) {
    const std::lock_guard lock(givenUp().mutex);
    givenUp().devices.insert(device);
    givenUp().any = true;
}

void check(VkResult result, const char* what) {
    if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(what, resultName(result));
    if (result == VK_ERROR_SURFACE_LOST_KHR) throw SurfaceLost(what, resultName(result));
    if (result < VK_SUCCESS) throw Error(what, resultName(result));
}

// ---- The instance and its messages --------------------------------------------------------------

void MessageLog::add(std::string message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
}

std::vector<std::string> MessageLog::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

Instance::Instance(Validation validation, const std::vector<std::string>& window_extensions)
    : messages_(std::make_unique<MessageLog>()) {
    if (volkInitialize() != VK_SUCCESS) {
        throw NoDevice("no Vulkan loader found (libvulkan.so.1): install libvulkan1 and a driver");
    }
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3) {
        throw NoDevice("the Vulkan loader is older than 1.3");
    }

    const VkApplicationInfo application{
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .pNext = nullptr,
        .pApplicationName = "hairbench",
        .applicationVersion = 0,
        .pEngineName = "hairbench",
        .engineVersion = 0,
        .apiVersion = VK_API_VERSION_1_3};

    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    for (const std::string& extension : window_extensions) extensions.push_back(extension.c_str());
    allows_present_fences_ =
        !window_extensions.empty() && std::ranges::all_of(kPresentFenceExtensions, hasExtension);
    if (allows_present_fences_)
        std::ranges::copy(kPresentFenceExtensions, std::back_inserter(extensions));
    if (hasExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME)) {
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }

    const bool portability = hasExtension(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (portability) extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);

    std::vector enabled{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    if (validation == Validation::gpu_assisted) {
        enabled.push_back(VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT);
        enabled.push_back(VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_RESERVE_BINDING_SLOT_EXT);
    }
    const bool validates = validation != Validation::off;
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messengerInfo(*messages_);
    const VkValidationFeaturesEXT features{
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext = &messenger,
        .enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size()),
        .pEnabledValidationFeatures = enabled.data(),
        .disabledValidationFeatureCount = 0,
        .pDisabledValidationFeatures = nullptr};
    if (validates) {
        if (!hasLayer(kValidationLayer)) {
            throw Error("validation was requested, but the layer is not installed "
                        "(package vulkan-validationlayers)");
        }
        layers.push_back(kValidationLayer);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }

    const VkInstanceCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = validates ? &features : nullptr,
        .flags = portability
                     ? VkInstanceCreateFlags{VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR}
                     : VkInstanceCreateFlags{0},
        .pApplicationInfo = &application,
        .enabledLayerCount = static_cast<std::uint32_t>(layers.size()),
        .ppEnabledLayerNames = layers.data(),
        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data()};
    if (const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
        result != VK_SUCCESS) {
        throw NoDevice("no Vulkan 1.3 instance: " + resultName(result));
    }
    volkLoadInstance(instance_);
    if (validates) {
        const VkResult result =
            vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_);
        if (result != VK_SUCCESS) vkDestroyInstance(instance_, nullptr);
        check(result, "create the validation messenger");
    }
}

void Instance::abandon() {
    static_cast<void>(messages_.release());
    messages_ = std::make_unique<MessageLog>();
    messenger_ = {};
    instance_ = {};
}

Instance::~Instance() {
    if (!instance_) return;
    if (messenger_) vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "list the Vulkan devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()), "list the Vulkan devices");
    return devices;
}

// ---- Devices and their features -----------------------------------------------------------------

std::string_view featureName(Feature feature) {
    return std::ranges::find(kFeatures, feature, &FeatureRow::feature)->name;
}

std::vector<Feature> allFeatures() {
    const auto features = kFeatures | std::views::transform(&FeatureRow::feature);
    return {features.begin(), features.end()};
}

VkDevice createDevice(const DeviceInfo& info, std::vector<const char*> extensions) {
    const bool has_present_fences = info.features.contains(Feature::present_fences);
    const bool has_mesh_shaders = info.features.contains(Feature::mesh_shader);
    const bool has_ray_queries = info.features.contains(Feature::ray_queries);
    const bool has_shader_figures = info.features.contains(Feature::shader_figures);
    FeatureChain features(
        info.is_portability, has_present_fences, has_mesh_shaders, has_ray_queries,
        has_shader_figures);
    features.acceleration.accelerationStructure = has_ray_queries ? VK_TRUE : VK_FALSE;
    features.rays.rayQuery = has_ray_queries ? VK_TRUE : VK_FALSE;
    if (has_ray_queries)
        extensions.insert(
            extensions.end(), kAccelerationExtensions.begin(), kAccelerationExtensions.end());
    features.executables.pipelineExecutableInfo = has_shader_figures ? VK_TRUE : VK_FALSE;
    features.presents.swapchainMaintenance1 = has_present_fences ? VK_TRUE : VK_FALSE;
    features.meshes.taskShader = features.meshes.meshShader = has_mesh_shaders ? VK_TRUE : VK_FALSE;
    features.meshes.meshShaderQueries =
        info.features.contains(Feature::mesh_statistics) ? VK_TRUE : VK_FALSE;
    enable(features.vulkan12, kVulkan12Features);
    enable(features.vulkan13, kVulkan13Features);
    for (const FeatureRow& row : kFeatures) {
        if (!info.features.contains(row.feature)) continue;
        if (row.member)
            features.core.features.*row.member = VK_TRUE;
        else if (row.member12)
            features.vulkan12.*row.member12 = VK_TRUE;
        else if (row.extension)
            extensions.push_back(row.extension);
    }
    if (info.is_portability) {
        extensions.push_back(VK_KHR_PORTABILITY_SUBSET_EXTENSION_NAME);
        features.portability.tessellationIsolines =
            info.features.contains(Feature::tessellation) ? VK_TRUE : VK_FALSE;
    }

    constexpr std::array priorities{1.0f, 1.0f};
    const auto queues = [&](std::uint32_t family, std::uint32_t count) {
        return VkDeviceQueueCreateInfo{
            .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
            .pNext = nullptr,
            .flags = 0,
            .queueFamilyIndex = family,
            .queueCount = count,
            .pQueuePriorities = priorities.data()};
    };
    std::vector<VkDeviceQueueCreateInfo> families{queues(info.queue_family, 1)};
    if (info.features.contains(Feature::second_queue)) {
        if (info.compute_family == info.queue_family)
            families.front().queueCount = 2;
        else
            families.push_back(queues(info.compute_family, 1));
    }
    const VkDeviceCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &features.core,
        .flags = 0,
        .queueCreateInfoCount = static_cast<std::uint32_t>(families.size()),
        .pQueueCreateInfos = families.data(),
        .enabledLayerCount = 0,
        .ppEnabledLayerNames = nullptr,
        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data(),
        .pEnabledFeatures = nullptr};
    VkDevice device{};
    check(vkCreateDevice(info.handle, &create, nullptr, &device), "create the Vulkan device");
    return device;
}

const char* deviceTypeName(DeviceType type) {
    constexpr std::array kNames{"discrete", "integrated", "virtual", "cpu", "other"};
    return kNames[static_cast<std::size_t>(type)];
}

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
    const DeviceInfo* best = nullptr;
    for (const DeviceInfo& device : devices)
        if (device.missing.empty() && (!best || device.type < best->type)) best = &device;
    if (best) return *best;
    throw NoDevice("no Vulkan device can run hairbench" + all);
}

}  // namespace engine
