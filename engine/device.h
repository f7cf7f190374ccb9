#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/barriers.h"
#include "engine/hazards.h"
#include "engine/instance.h"
#include "engine/process.h"

struct VmaAllocation_T;
struct VmaAllocator_T;

// A logical device with its queues and allocator, its memory ledger and its pipelines.
namespace engine {

class ShaderLibrary;

// A VkPipelineCache kept on disk between runs, in one file per device and driver build under
// $XDG_CACHE_HOME/hairbench (or ~/.cache/hairbench). A file that is unreadable or of another driver
// is ignored. Failure to write one is no error: the cache only saves time.
class PipelineCache {
public:
    PipelineCache(VkDevice device, const DeviceInfo& info);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    VkPipelineCache get() const { return cache_; }

private:
    VkDevice device_;
    std::filesystem::path file_;  // empty: no home folder for it
    std::vector<char> loaded_;
    VkPipelineCache cache_{};
};

// Code that a driver's compiler made of stages of a pipeline, and its figures. A driver may make
// one program of several stages, or several of one.
struct ShaderProgram {
    struct Figure {
        std::string name;  // the driver's: "VGPRs", "Instruction count"
        double value = 0.0;
    };

    std::string name;  // the driver's
    std::vector<std::string> shaders;  // paths of its stages; empty if the driver does not tell
    std::uint32_t subgroup_size = 0;  // invocations
    std::vector<Figure> figures;
};

struct PipelineObjects {
    Handle<VkDescriptorSetLayout, &vkDestroyDescriptorSetLayout> images;
    Handle<VkPipelineLayout, &vkDestroyPipelineLayout> layout;
    Handle<VkPipeline, &vkDestroyPipeline> pipeline;
    VkShaderStageFlags push_stages = 0;  // stages that have the push constants
    std::vector<ShaderProgram> programs{};  // if Device::tellsShaderFigures()
};

// LRU cache of the device's pipelines. Its key consists of all parts of a pipeline: stage code,
// constants and state. Equal pipelines are made once, because a driver would compile each of them
// again, sometimes only at its first draw. Thread-safe.
class PipelineStore {
public:
    using Objects = std::shared_ptr<const PipelineObjects>;

    Objects get(const std::string& key, const std::function<PipelineObjects()>& make);

    // Returns the programs of all pipelines that get() returned since the last call.
    std::vector<ShaderProgram> takePrograms();

private:
    static constexpr std::size_t kMost = 256;

    std::vector<ShaderProgram> programs_;

    std::mutex mutex_;
    std::list<std::pair<std::string, Objects>> lru_;
};

// Whether the driver's compiler is asked for figures of each pipeline. Asking changes no code, but
// may keep the driver's cache of pipelines from being used (VkPipelineCreateFlagBits).
enum class ShaderFigures { unasked, where_told, required };

struct DeviceOptions {
    std::string wanted;  // index or part of the name; empty: the best
    Validation validation = Validation::off;
    bool keeps_uses = false;  // makes a hazard log without validation, too
    // Window::instanceExtensions() to show pictures in a window; empty: no window.
    std::vector<std::string> window_extensions{};
    // Removes features from the device's description before the device is made. Only the remaining
    // features are enabled and known. Tests use this to imitate devices with fewer features.
    std::function<void(DeviceInfo&)> mask{};
    // Longest wait for one submission. Absent: ten minutes, or an hour for a software device, which
    // may need many minutes for a large frame.
    std::optional<std::chrono::duration<double>> patience{};
    // If required, the device throws Unsupported without Feature::shader_figures.
    ShaderFigures shader_figures = ShaderFigures::unasked;
};

// One logical device with its queues, its memory allocator and pipeline cache. Everything else
// borrows it. Only one thread at a time may use a device and what was made from it. Another thread
// may use another device meanwhile, which has its own instance and driver queue. No other thread
// may use a device while one is made. The device that shows pictures in a window is made last,
// because functions are looked up for the instance made last.
class Device {
public:
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance() const { return instance_.get(); }
    VkDevice get() const { return device_.get(); }
    VkQueue queue() const { return queue_; }
    // The second queue, or the first if there is no second (Feature::second_queue).
    VkQueue computeQueue() const { return compute_queue_; }
    // The families of both queues. Resources that both queues may touch are shared among them.
    std::vector<std::uint32_t> queueFamilies() const;
    VmaAllocator_T* allocator() const { return allocator_.get(); }
    VkPipelineCache pipelineCache() const { return cache_->get(); }
    const DeviceInfo& info() const { return info_; }
    MessageLog& messages() const { return instance_.messages(); }
    // Its buffers and images, and the barriers of commands for each kind of queue.
    TrackedResources& resources() const { return *resources_; }
    BarrierPlan& barriers(QueueKind queue) const {
        return *barriers_[static_cast<std::size_t>(queue)];
    }
    // The hazard log; null without validation and DeviceOptions::keeps_uses.
    HazardLog* hazards() const { return hazards_.get(); }

    // Largest number of vertices that one instance of a tessellated draw can correctly make.
    // lavapipe's tessellator has 16-bit indices and fails silently above that.
    std::uint32_t maxTessellatedVertices() const;

    bool supportsSamples(std::uint32_t samples) const;
    // lavapipe before Mesa 23 counts about twenty times too many fragments.
    bool fragmentCountsAreApproximate() const;
    bool has(Feature feature) const { return info_.features.contains(feature); }
    bool hasPipelineStatistics() const { return has(Feature::pipeline_statistics); }
    // Throws Unsupported "<context>: the device has no <feature>" if the feature is missing.
    void require(Feature feature, const std::string& context) const;

    // Returns the bytes of memory in live allocations.
    std::uint64_t allocatedBytes() const;

    // Returns the bytes that can still be allocated from the largest device-local heap: the
    // driver's figure (VK_EXT_memory_budget), or else four fifths of the heap less the allocated
    // bytes.
    std::uint64_t freeBytes() const;

    // The memory of all buffers and images.
    MemoryLedger memory() const { return resources_->memory(); }
    // The shader code of pipelines made from now on.
    ShaderLibrary& shaders() const { return *shaders_; }
    // The pipelines made from that code.
    PipelineStore& pipelines() const { return *pipelines_; }
    // Whether pipelines come with figures: asked for, and told.
    bool tellsShaderFigures() const { return shader_figures_; }
    // Registers an allocation's buffer or image, which keeps the entry. Finds its heap and size.
    TrackedResources::Entry
    track(VmaAllocation_T* allocation, TrackedResources::Resource resource) const;

    // Names an object for debuggers and validation messages.
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;

    // Hands `record` a new command buffer, submits it, and waits until the work is done. runOnce()
    void submitOnce(const std::function<void(VkCommandBuffer)>& record) const;

    // Waits for the device. `wait` gets the longest time to wait (ns) and returns the result of the
    // Vulkan function that waits. A wait that fails for lack of memory is retried. Throws
    // DeviceLost. Throws DeviceSilent, at once if the device was given up before. An interrupt ends
    // the program as in waitInterruptibly(). `what`: for example "wait for a frame".
    template <class Wait>
    void await(const char* what, Wait&& wait) const {
        const auto start = beginWait(what);
        waitInterruptibly(
            [&](std::uint64_t nanoseconds) { return isOver(what, wait(nanoseconds), start); });
    }

private:
    std::chrono::steady_clock::time_point beginWait(const char* what) const;
    bool
    isOver(const char* what, VkResult result, std::chrono::steady_clock::time_point start) const;

    struct DestroyDevice {
        void operator()(VkDevice device) const;
    };
    struct DestroyAllocator {
        void operator()(VmaAllocator_T* allocator) const;
    };

    Instance instance_;
    DeviceInfo info_;
    std::unique_ptr<VkDevice_T, DestroyDevice> device_;
    std::chrono::duration<double> patience_;
    bool shader_figures_ = false;
    VkQueue queue_{};
    VkQueue compute_queue_{};
    std::unique_ptr<VmaAllocator_T, DestroyAllocator> allocator_;
    std::unique_ptr<TrackedResources> resources_ = std::make_unique<TrackedResources>();
    std::array<std::unique_ptr<BarrierPlan>, 2> barriers_{
        std::make_unique<BarrierPlan>(*resources_, QueueKind::all),
        std::make_unique<BarrierPlan>(*resources_, QueueKind::compute)};
    std::unique_ptr<HazardLog> hazards_;
    std::unique_ptr<ShaderLibrary> shaders_;
    std::unique_ptr<PipelineCache> cache_;
    std::unique_ptr<PipelineStore> pipelines_;
    Handle<VkCommandPool, &vkDestroyCommandPool> pool_;
    Fence fence_;
};

}  // namespace engine
