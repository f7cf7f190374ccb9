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

// The specification's name of a result, such as "VK_ERROR_DEVICE_LOST".
std::string resultName(VkResult result);

// Throws Error "<what>: <result name>" unless the call succeeded.
void check(VkResult result, const char* what);

// Whether giveUp() was called for the device.
bool isGivenUp(VkDevice device);
// From now on nothing that the device made is destroyed, nor the device itself: it never answered,
// and may still be at work on all of it.
void giveUp(VkDevice device);

// Owns one Vulkan object that a device made. `Destroy` is the address of volk's function pointer,
// e.g. Handle<VkSampler, &vkDestroySampler>.
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
    // Where it is, as long as this lives and nothing is moved into it.
    const Object* place() const { return &object_; }

private:
    VkDevice device_{};
    Object object_{};
};

enum class Validation {
    off,
    on,  // the Khronos layer with synchronisation validation; an Error if it is not installed
    gpu_assisted,  // and with checks that it writes into shaders: of addresses, indices and more
};

// Warnings and errors of the validation layer, in the order they came. Thread-safe.
class MessageLog {
public:
    void add(std::string message);
    std::vector<std::string> take();

private:
    std::mutex mutex_;
    std::vector<std::string> messages_;
};

// The Vulkan loader and instance. Throws NoDevice where no loader or no Vulkan 1.3 instance exists.
class Instance {
public:
    // `window_extensions`: Window::instanceExtensions() where windows are opened.
    explicit Instance(
        Validation validation, const std::vector<std::string>& window_extensions = {});
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance get() const { return instance_; }
    // Whether it has what Feature::present_fences needs of instances. Only where windows are
    // opened.
    bool allowsPresentFences() const { return allows_present_fences_; }
    MessageLog& messages() const { return *messages_; }
    std::vector<VkPhysicalDevice> physicalDevices() const;
    // Leaves it, and the log that it writes to, where they are: a device of it was given up.
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

// What a device may lack. Features are switched on where they are there; a case that needs one that
// is not is skipped.
enum class Feature {
    tessellation,  // control and evaluation stages, with isolines
    geometry,
    mesh_shader,  // task and mesh stages
    vertex_stores,  // of vertex, tessellation and geometry stages
    fragment_stores,
    independent_blend,  // attachments of one pipeline that are blended in different ways
    float_blend,  // of 32-bit floats
    multi_draw,  // several draws by one command, their arguments in a buffer
    long_integers,  // of 64 bits, in shaders
    long_atomics,  // on such integers in buffers
    pipeline_statistics,
    mesh_statistics,  // of task and mesh stages
    sample_counts,  // occlusion queries that count
    calibrated_timestamps,  // a moment by the clocks of device and host at once
    push_descriptors,  // Commands does with descriptor sets where they are missing
    second_queue,  // that computes beside the first one
    memory_budget,  // how much of its memory is free; guessed by its heap where it is missing
    // Fences that say when a picture in a window is done with; of devices that were made with
    // extensions of windows. Swapchain does with images that come back where they are missing.
    present_fences,
};

// In the plural, for "the device has no ...".
std::string_view featureName(Feature feature);

// All of them, in the order above.
std::vector<Feature> allFeatures();

// What a Vulkan device is and whether hairbench can run on it.
struct DeviceInfo {
    VkPhysicalDevice handle{};
    std::string name;
    std::string type;  // "discrete", "integrated", "virtual", "cpu" or "other"
    std::string driver;  // e.g. "llvmpipe"
    std::string driver_version;  // as the driver writes it, e.g. "Mesa 22.3.6 (LLVM 15.0.6)"
    std::string api_version;  // e.g. "1.3.230"
    VkDriverId driver_id{};
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMeshShaderPropertiesEXT mesh_limits{};  // with Feature::mesh_shader
    std::uint64_t local_bytes = 0;  // of the largest memory heap that is the device's own
    std::uint32_t queue_family = 0;  // graphics, compute and transfer
    // Of the second queue: another family with compute, best one without graphics, or the same one
    // where that has several queues. That of the first where there is no second.
    std::uint32_t compute_family = 0;
    std::uint32_t timestamp_valid_bits = 0;  // of the queue family
    std::vector<std::string> missing;  // required features it lacks; empty: suitable
    std::set<Feature> features;
    bool is_portability = false;  // it has a subset of Vulkan (VK_KHR_portability_subset)
};

// All devices of the instance, as the driver orders them.
std::vector<DeviceInfo> listDevices(const Instance& instance);

// The device that `wanted` names by index or part of its name (any case); with an empty `wanted`
// the first of the best suitable type (discrete, integrated, virtual, cpu). Throws NoDevice with
// the reasons when there is none.
DeviceInfo chooseDevice(const Instance& instance, const std::string& wanted);

// Creates the logical device with its first queue, the second one where the features have it, the
// features that every device must have and those of
// `info`, and these extensions beside those that the features need.
VkDevice createDevice(const DeviceInfo& info, std::vector<const char*> extensions);

}  // namespace engine
