#include "engine/pipeline_cache.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include <unistd.h>

namespace engine {

namespace {

std::filesystem::path cacheFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) {
        return std::filesystem::path(cache) / "hairbench";
    }
    if (const char* home = std::getenv("HOME"); home && *home) {
        return std::filesystem::path(home) / ".cache" / "hairbench";
    }
    return {};
}

std::filesystem::path cacheFile(const VkPhysicalDeviceProperties& properties) {
    const std::filesystem::path folder = cacheFolder();
    if (folder.empty()) return {};
    constexpr char kDigits[] = "0123456789abcdef";
    std::string name = "pipelines-";
    for (std::uint8_t byte : properties.pipelineCacheUUID) {
        name += kDigits[byte >> 4];
        name += kDigits[byte & 15];
    }
    return folder / (name + "-" + std::to_string(properties.driverVersion) + ".bin");
}

std::vector<char> readFile(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// The driver is asked to check too, but not every driver does.
bool belongsTo(const std::vector<char>& data, const VkPhysicalDeviceProperties& properties) {
    VkPipelineCacheHeaderVersionOne header{};
    if (data.size() < sizeof header) return false;
    std::memcpy(&header, data.data(), sizeof header);
    return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
           std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

}  // namespace

PipelineCache::PipelineCache(VkDevice device, const DeviceInfo& info) : device_(device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(info.handle, &properties);
    file_ = cacheFile(properties);
    if (!file_.empty()) loaded_ = readFile(file_);
    if (!belongsTo(loaded_, properties)) loaded_.clear();

    const VkPipelineCacheCreateInfo create{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .initialDataSize = loaded_.size(),
        .pInitialData = loaded_.data()};
    check(vkCreatePipelineCache(device_, &create, nullptr, &cache_), "create the pipeline cache");
}

PipelineCache::~PipelineCache() {
    std::size_t size = 0;
    std::vector<char> data;
    if (vkGetPipelineCacheData(device_, cache_, &size, nullptr) == VK_SUCCESS) {
        data.resize(size);
        if (vkGetPipelineCacheData(device_, cache_, &size, data.data()) != VK_SUCCESS) size = 0;
        data.resize(size);
    }
    vkDestroyPipelineCache(device_, cache_, nullptr);
    if (file_.empty() || data.empty() || data == loaded_) return;

    // Written beside and renamed, so that a second process never reads half a file.
    std::error_code ignored;
    std::filesystem::create_directories(file_.parent_path(), ignored);
    const std::filesystem::path part = file_.string() + "." + std::to_string(getpid());
    {
        std::ofstream stream(part, std::ios::binary);
        stream.write(data.data(), static_cast<std::streamsize>(data.size()));
        if (!stream) return;
    }
    std::filesystem::rename(part, file_, ignored);
}

}  // namespace engine
