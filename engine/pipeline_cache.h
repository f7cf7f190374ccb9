#pragma once

#include <filesystem>
#include <vector>

#include "engine/physical_device.h"

namespace engine {

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

}  // namespace engine
