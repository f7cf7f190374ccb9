#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <volk.h>

#include "engine/error.h"

// Vulkan up to the device: results of calls, owned handles, the instance with its validation
// messages, and the choice of a physical device.
namespace engine {

// Returns the specification's name of a result, such as "VK_ERROR_DEVICE_LOST".
std::string resultName(VkResult result);

// The device was lost (VK_ERROR_DEVICE_LOST), and with it everything made from it.
class DeviceLost : public Error {
public:
    using Error::Error;
};

// The window's surface was lost (VK_ERROR_SURFACE_LOST_KHR); the window itself may still exist.
class SurfaceLost : public Error {
public:
    using Error::Error;
};

// The device did not respond for longer than DeviceOptions::patience and was given up (giveUp()).
// Its objects are not destroyed.
class DeviceSilent : public DeviceLost {
public:
    using DeviceLost::DeviceLost;
};

// Throws Error "<what>: <result name>" unless the call succeeded; DeviceLost or SurfaceLost for
// their results.
void check(VkResult result, const char* what);

// Whether giveUp() was called for the device.
bool isGivenUp(VkDevice device);
// Marks a device that never answered and may still use its objects. From now on neither its objects
// nor the device are destroyed.
void giveUp(VkDevice device);

// Owns one Vulkan object of a device. `Destroy` is the address of volk's function pointer, e.g.
// Handle<VkSampler, &vkDestroySampler>.
template <class Object, auto Destroy>
class Handle {
public:
    Handle() = default;
    Handle(VkDevice device, Object object) : device_(device), object_(object) {}
    Handle(Handle&& other) noexcept
        : device_(other.device_), object_(std::exchange(other.object_, Object{})) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~Handle() {
        if (object_ && !isGivenUp(device_)) (*Destroy)(device_, object_, nullptr);
    }

    Object get() const { return object_; }
    // Address of the handle, valid while this object lives and nothing is moved into it.
    const Object* place() const { return &object_; }

private:
    VkDevice device_{};
    Object object_{};
};

// A fence that submissions use in turn.
class Fence {
public:
    Fence() = default;
    explicit Fence(VkDevice device);

    // Null for a default-constructed object.
    VkFence get() const { return fence_.get(); }
    // Returns the fence, unsignalled, for the next submission. A fence that is reset after its wait
    // would stay signalled if the reset failed, and the next wait would end at once.
    VkFence ready() const;

private:
    VkDevice device_{};
    Handle<VkFence, &vkDestroyFence> fence_;
};

enum class Validation {
    off,
    on,  // the Khronos layer with synchronisation validation; an Error if it is not installed
    gpu_assisted,  // also with checks inserted into shaders: of addresses, indices and more
};

// Warnings and errors of the validation layer, in order of arrival. Thread-safe.
class MessageLog {
public:
    void add(std::string message);
    std::vector<std::string> take();

private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

// The Vulkan loader and instance. Throws NoDevice if no loader or no Vulkan 1.3 instance exists.
class Instance {
public:
    // `window_extensions`: Window::instanceExtensions() if windows are opened.
    explicit Instance(
        Validation validation, const std::vector<std::string>& window_extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance get() const { return instance_; }
    // Whether the instance has the extensions that Feature::present_fences needs. Only if windows
    // are opened.
    bool allowsPresentFences() const { return allows_present_fences_; }
    MessageLog& messages() const { return *messages_; }
    std::vector<VkPhysicalDevice> physicalDevices() const;
    // Leaves the instance and its message log alive, because one of its devices was given up.
    void abandon();

private:
    std::unique_ptr<MessageLog> messages_;
    bool allows_present_fences_ = false;
    VkInstance instance_{};
    VkDebugUtilsMessengerEXT messenger_{};
};

// No Vulkan, or no device that can run hairbench.
class NoDevice : public Error {
public:
    using Error::Error;
};

// Optional device features. A feature is enabled if the device has it. A case that needs a missing
// feature is skipped.
enum class Feature {
    tessellation,  // control and evaluation stages, with isolines
    geometry,
    mesh_shader,  // task and mesh stages
    ray_queries,  // rays that compute traces in acceleration structures
    vertex_stores,  // stores in vertex, tessellation and geometry stages
    fragment_stores,
    independent_blend,  // different blending for the attachments of one pipeline
    float_blend,  // blending of 32-bit floats
    multi_draw,  // several indirect draws in one command
    long_integers,  // 64-bit integers in shaders
    long_atomics,  // on 64-bit integers in buffers
    pipeline_statistics,
    mesh_statistics,  // for task and mesh stages
    sample_counts,  // precise occlusion queries
    calibrated_timestamps,  // device and host clocks read at the same moment
    push_descriptors,  // without them Commands uses descriptor sets
    second_queue,  // for compute beside the first queue
    shader_figures,  // the driver's compiler tells figures of the code that it made
    memory_budget,  // reports free memory; without it, estimated from the heap size
    // Fences that signal when a present is done. Only for devices made with window extensions.
    // Without them Swapchain relies on images that come back.
    present_fences,
};

// Returns the name in the plural, for "the device has no ...".
std::string_view featureName(Feature feature);

// Returns all features in the order above.
std::vector<Feature> allFeatures();

// The best type for measurements comes first.
enum class DeviceType { discrete, integrated, virtual_gpu, cpu, other };

// "discrete", "integrated", "virtual", "cpu" or "other".
const char* deviceTypeName(DeviceType type);

// A Vulkan device, and whether it can run hairbench.
struct DeviceInfo {
    VkPhysicalDevice handle{};
    std::string name;
    DeviceType type = DeviceType::other;
    std::string driver;  // e.g. "llvmpipe"
    std::string driver_version;  // as the driver writes it, e.g. "Mesa 22.3.6 (LLVM 15.0.6)"
    std::string api_version;  // e.g. "1.3.230"
    VkDriverId driver_id{};
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMeshShaderPropertiesEXT mesh_limits{};  // with Feature::mesh_shader
    std::uint32_t subgroup_size = 1;  // invocations
    std::uint64_t local_bytes = 0;  // of the largest device-local memory heap
    std::uint32_t queue_family = 0;  // graphics, compute and transfer
    // Family of the second queue: another family with compute, preferably without graphics, or the
    // first queue's family if it has several queues. Without a second queue, it is the first
    // queue's family.
    std::uint32_t compute_family = 0;
    std::uint32_t timestamp_valid_bits = 0;  // of the queue family
    std::vector<std::string> missing;  // required features that are missing; empty: suitable
    std::set<Feature> features;
    bool is_portability = false;  // supports a subset of Vulkan (VK_KHR_portability_subset)
};

// Returns all devices of the instance in the driver's order.
std::vector<DeviceInfo> listDevices(const Instance& instance);

// Returns the device that `wanted` names by index or part of its name (any case). With an empty
// `wanted`, returns the first of the best suitable type (discrete, integrated, virtual, cpu).
// Throws NoDevice with the reasons if there is none.
DeviceInfo chooseDevice(const Instance& instance, const std::string& wanted);

// Creates the logical device with its first queue, the second queue if the features include it, the
// required features, the features of `info`, and `extensions` besides those that the features need.
VkDevice createDevice(const DeviceInfo& info, std::vector<const char*> extensions);

}  // namespace engine
