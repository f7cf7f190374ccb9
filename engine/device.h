#pragma once

#include <functional>
#include <string>

#include "engine/handle.h"
#include "engine/physical_device.h"
#include "engine/pipeline_cache.h"

struct VmaAllocator_T;

namespace engine {

class Commands;

struct DeviceOptions {
    std::string wanted;  // index or part of the name; empty: the best
    Validation validation = Validation::off;
};

// One logical device with one queue, its memory allocator and pipeline cache. Everything else
// borrows it.
class Device {
public:
    explicit Device(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkDevice get() const { return device_; }
    VkQueue queue() const { return queue_; }
    VmaAllocator_T* allocator() const { return allocator_; }
    VkPipelineCache pipelineCache() const { return cache_->get(); }
    const DeviceInfo& info() const { return info_; }
    MessageLog& messages() const { return instance_.messages(); }

    // Largest number of vertices that one tessellated draw (one instance of it) can make and still
    // be right. lavapipe's tessellator has 16-bit indices and fails silently above.
    std::uint32_t maxTessellatedVertices() const;

    bool supportsSamples(std::uint32_t samples) const;
    // lavapipe before Mesa 23 counts about twenty times too many fragments.
    bool fragmentCountsAreApproximate() const;
    bool hasPipelineStatistics() const { return pipeline_statistics_; }

    // Bytes of memory that live allocations hold.
    std::uint64_t allocatedBytes() const;

    // Names an object for debuggers and validation messages.
    void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;

    // Records with `record`, submits, and returns when the work is done. For set-up and read-back.
    void runOnce(const std::function<void(Commands&)>& record) const;

private:
    Instance instance_;
    DeviceInfo info_;
    bool pipeline_statistics_ = false;
    VkDevice device_{};
    VkQueue queue_{};
    VmaAllocator_T* allocator_{};
    std::unique_ptr<PipelineCache> cache_;
    Handle<VkCommandPool, &vkDestroyCommandPool> pool_;
    Handle<VkFence, &vkDestroyFence> fence_;
};

}  // namespace engine
