#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "engine/hazards.h"
#include "engine/instance.h"
#include "engine/process.h"

struct VmaAllocation_T;
struct VmaAllocator_T;

// The device: a logical device with its queues and allocator, the ledger of who holds its memory,
// and its pipeline cache.
namespace engine {

class Commands;
class PipelineStore;
class ShaderLibrary;

// The device stopped working (VK_ERROR_DEVICE_LOST), and so did everything made from it.
class DeviceLost : public Error {
public:
    using Error::Error;
};

// The window's surface is gone (VK_ERROR_SURFACE_LOST_KHR), though the window may be there.
class SurfaceLost : public Error {
public:
    using Error::Error;
};

// The device had nothing to say for longer than DeviceOptions::patience and was given up
// (giveUp()). What it made is left where it is.
class DeviceSilent : public DeviceLost {
public:
    using DeviceLost::DeviceLost;
};

// Bytes of device memory by the names of the buffers and images that hold them and by the memory
// heap that they lie in. Live allocations only.
class MemoryLedger {
public:
    struct Entry {
        std::uint32_t heap = 0;  // of VkPhysicalDeviceMemoryProperties
        bool device_local = false;
        std::string name;  // of the buffer or image

        auto operator<=>(const Entry&) const = default;
    };

    const std::map<Entry, std::uint64_t>& bytes() const { return bytes_; }

    // An entry that is on the ledger for as long as its owner keeps this; move-only.
    class Line {
    public:
        Line() = default;
        Line(MemoryLedger& ledger, Entry entry, std::uint64_t bytes)
            : ledger_(&ledger), entry_(std::move(entry)), bytes_(bytes) {
            ledger_->enter(entry_, bytes_);
        }
        Line(Line&& other) noexcept { swap(other); }
        Line& operator=(Line&& other) noexcept {
            swap(other);
            return *this;
        }
        ~Line() {
            if (ledger_) ledger_->leave(entry_, bytes_);
        }

    private:
        void swap(Line& other) noexcept {
            std::swap(ledger_, other.ledger_);
            std::swap(entry_, other.entry_);
            std::swap(bytes_, other.bytes_);
        }

        MemoryLedger* ledger_ = nullptr;
        Entry entry_;
        std::uint64_t bytes_ = 0;
    };

private:
    void enter(const Entry& entry, std::uint64_t bytes) { bytes_[entry] += bytes; }
    void leave(const Entry& entry, std::uint64_t bytes);

    std::map<Entry, std::uint64_t> bytes_;
};

// A VkPipelineCache kept on disk between runs, in a file of its own per device and driver build
// under $XDG_CACHE_HOME/hairbench (or ~/.cache/hairbench). A file that is unreadable or of another
// driver is ignored, one that can't be written is not an error: the cache only saves time.
class PipelineCache {
public:
    PipelineCache(VkDevice device, const DeviceInfo& info);
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    VkPipelineCache get() const { return cache_; }

private:
    VkDevice device_;
    std::filesystem::path file_;  // empty: no home to keep it in
    std::vector<char> loaded_;
    VkPipelineCache cache_{};
};

struct DeviceOptions {
    std::string wanted;  // index or part of the name; empty: the best
    Validation validation = Validation::off;
    // Window::instanceExtensions() where pictures are shown in one; empty: none are.
    std::vector<std::string> window_extensions{};
    // Takes away from what the device says of itself before it is made: what is left is all that
    // is switched on and known. Tests make lesser devices by it.
    std::function<void(DeviceInfo&)> mask{};
    // For what is submitted at a time; absent: ten minutes, an hour of a software device, which may
    // need many minutes for a large frame.
    std::optional<std::chrono::duration<double>> patience{};
};

// One logical device with its queues, its memory allocator and pipeline cache. Everything else
// borrows it. A device and what was made of it are one thread's at a time; another device, which
// has an instance and a driver's queue of its own, may be another thread's meanwhile. Devices are
// made while no other thread uses one, and the one that shows pictures in a window is made last:
// functions are looked up for the last instance that was made.
class Device {
public:
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkInstance instance() const { return instance_.get(); }
    VkDevice get() const { return device_.get(); }
    VkQueue queue() const { return queue_; }
    // The second queue, or the first where there is no other (Feature::second_queue).
    VkQueue computeQueue() const { return compute_queue_; }
    // The families of both queues: what both may touch is shared among them.
    std::vector<std::uint32_t> queueFamilies() const;
    VmaAllocator_T* allocator() const { return allocator_.get(); }
    VkPipelineCache pipelineCache() const { return cache_->get(); }
    const DeviceInfo& info() const { return info_; }
    MessageLog& messages() const { return instance_.messages(); }
    // Who looks for missing barriers; null where validation is off.
    HazardLog* hazards() const { return hazards_.get(); }

    // Largest number of vertices that one tessellated draw (one instance of it) can make and still
    // be right. lavapipe's tessellator has 16-bit indices and fails silently above.
    std::uint32_t maxTessellatedVertices() const;

    bool supportsSamples(std::uint32_t samples) const;
    // lavapipe before Mesa 23 counts about twenty times too many fragments.
    bool fragmentCountsAreApproximate() const;
    bool has(Feature feature) const { return info_.features.contains(feature); }
    bool hasPipelineStatistics() const { return has(Feature::pipeline_statistics); }
    // Throws Unsupported "<context>: the device has no <feature>" where it has not.
    void require(Feature feature, const std::string& context) const;

    // Bytes of memory that live allocations hold.
    std::uint64_t allocatedBytes() const;

    // Bytes that may still be allocated of the largest heap that is the device's own, as its driver
    // has it (VK_EXT_memory_budget) or else four fifths of the heap less what is allocated.
    std::uint64_t freeBytes() const;

    // Who holds what of the device's memory: buffers and images enter and leave themselves.
    const MemoryLedger& memory() const { return *memory_; }
    // The code that pipelines are made of from now on.
    ShaderLibrary& shaders() const { return *shaders_; }
    // The pipelines that were made of it.
    PipelineStore& pipelines() const { return *pipelines_; }
    // What an allocation's owner keeps for as long as it lives.
    MemoryLedger::Line memoryLine(VmaAllocation_T* allocation, const std::string& name) const;

    // Names an object for debuggers and validation messages.
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;

    // Records with `record`, submits, and returns when the work is done. For set-up and read-back.
    void runOnce(const std::function<void(Commands&)>& record) const;

    // Waits for the device: `wait` is called with the ns that it may take, and returns the result
    // of the Vulkan function that waits. What lacks memory for it is tried again. Throws
    // DeviceLost, and DeviceSilent: at once for a device that was given up. Where an interrupt came
    // the program ends as waitHeeding() has it. `what`: "wait for a frame".
    template <class Wait>
    void await(const char* what, Wait&& wait) const {
        const auto start = beginWait(what);
        waitHeeding(
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
    VkQueue queue_{};
    VkQueue compute_queue_{};
    std::unique_ptr<VmaAllocator_T, DestroyAllocator> allocator_;
    std::unique_ptr<HazardLog> hazards_;
    std::unique_ptr<MemoryLedger> memory_;
    std::unique_ptr<ShaderLibrary> shaders_;
    std::unique_ptr<PipelineCache> cache_;
    std::unique_ptr<PipelineStore> pipelines_;
    Handle<VkCommandPool, &vkDestroyCommandPool> pool_;
    Handle<VkFence, &vkDestroyFence> fence_;
};

}  // namespace engine
