#include "engine/device.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

#include <zlib.h>

#include "engine/files.h"
#include "engine/system/process.h"
#include "engine/memory.h"
#include "engine/shaders.h"

namespace engine {
namespace {

std::filesystem::path cacheFile(const VkPhysicalDeviceProperties& properties) {
    const std::filesystem::path folder = userCacheFolder();
    if (folder.empty()) return {};
    constexpr char kDigits[] = "0123456789abcdef";
    std::string name = "pipelines-";
    for (std::uint8_t byte : properties.pipelineCacheUUID) {
        name += kDigits[byte >> 4];
        name += kDigits[byte & 15];
    }
    return folder / (name + "-" + std::to_string(properties.driverVersion) + ".bin");
}

constexpr std::uintmax_t kMostCacheBytes = std::uintmax_t{256} << 20;  // of all files together

// The trailer follows a driver's data in its file: a format version and a checksum of the data,
// because not every driver verifies its data.
std::string trailerOf(const std::vector<char>& data) {
    const auto* const bytes = reinterpret_cast<const Bytef*>(data.data());
    const std::string sum = std::to_string(crc32_z(0, bytes, data.size()));
    return "hairbench 1 " + std::string(10 - sum.size(), '0') + sum;
}

// Returns a driver's data as written; empty if the file is damaged or missing.
std::vector<char> checkedData(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t size =
        std::filesystem::is_regular_file(file, error) ? std::filesystem::file_size(file, error) : 0;
    const std::size_t trailer_size = trailerOf({}).size();
    if (error || size < trailer_size || size > kMostCacheBytes) return {};
    std::vector<char> data(size);
    std::ifstream(file, std::ios::binary).read(data.data(), static_cast<std::streamsize>(size));
    const std::string trailer(data.end() - static_cast<std::ptrdiff_t>(trailer_size), data.end());
    data.resize(size - trailer_size);
    if (trailer != trailerOf(data)) return {};
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
    return data;
}

// Whether the data belongs to this device's driver. Drivers must check this too, but not all do.
bool belongsTo(const std::vector<char>& data, const VkPhysicalDeviceProperties& properties) {
    VkPipelineCacheHeaderVersionOne header{};
    if (data.size() < sizeof header) return false;
    std::memcpy(&header, data.data(), sizeof header);
    return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
           header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
           std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

// Live devices. They share volk's one set of function pointers.
std::atomic<int> devices_alive = 0;

// Calls through volk's pointer at `kPlace` as it is at the time of the call.
template <auto* kPlace, class Function = std::remove_pointer_t<decltype(kPlace)>>
struct ByVolk;
template <auto* kPlace, class Result, class... Arguments>
struct ByVolk<kPlace, Result (*)(Arguments...)> {
    static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
        return (*kPlace)(arguments...);
    }
};

// Returns the most bytes that each heap may take, if a limit on the size of files also limits
// device memory. Lavapipe of Mesa 23 and later keeps all of it in one file and ignores that the
// file cannot grow, so memory past that limit ends the process by SIGBUS. Half of the limit is
// left for the gaps between blocks and for what the driver takes itself. Throws Error if the rest
// is too little.
std::optional<VkDeviceSize> fileMemoryLimit(const DeviceInfo& info) {
    if (info.driver_id != VK_DRIVER_ID_MESA_LLVMPIPE || info.driver_version.starts_with("Mesa 22"))
        return std::nullopt;
    const std::optional<std::uint64_t> limit = system::largestFile();
    if (!limit) return std::nullopt;
    constexpr std::uint64_t kKibibyte = 1024;  // as ulimit counts
    constexpr std::uint64_t kLeast = 256 * 1024 * kKibibyte;
    if (*limit < kLeast)
        throw Error(
            info.name, "this driver keeps its memory in a file, but files may have at most " +
                           std::to_string(*limit / kKibibyte) +
                           " KiB here: raise the limit to 256 MiB or more (ulimit -f " +
                           std::to_string(kLeast / kKibibyte) + ")");
    return *limit / 2;
}

VmaAllocator createAllocator(VkInstance instance, const DeviceInfo& info, VkDevice device) {
    VmaVulkanFunctions functions{};
    functions.vkGetInstanceProcAddr = vkGetInstanceProcAddr;
    functions.vkGetDeviceProcAddr = vkGetDeviceProcAddr;
    // Memory functions are called through volk too, so that tests can make them fail.
    functions.vkAllocateMemory = ByVolk<&vkAllocateMemory>::call;
    functions.vkFreeMemory = ByVolk<&vkFreeMemory>::call;
    functions.vkMapMemory = ByVolk<&vkMapMemory>::call;
    functions.vkBindBufferMemory = ByVolk<&vkBindBufferMemory>::call;
    functions.vkBindImageMemory = ByVolk<&vkBindImageMemory>::call;
    functions.vkCreateBuffer = ByVolk<&vkCreateBuffer>::call;
    functions.vkDestroyBuffer = ByVolk<&vkDestroyBuffer>::call;
    functions.vkCreateImage = ByVolk<&vkCreateImage>::call;
    functions.vkDestroyImage = ByVolk<&vkDestroyImage>::call;
    VmaAllocatorCreateInfo create{};
    create.flags = VMA_ALLOCATOR_CREATE_BUFFER_DEVICE_ADDRESS_BIT;
    if (info.features.contains(Feature::memory_budget))
        create.flags |= VMA_ALLOCATOR_CREATE_EXT_MEMORY_BUDGET_BIT;
    create.physicalDevice = info.handle;
    create.device = device;
    create.instance = instance;
    create.vulkanApiVersion = VK_API_VERSION_1_3;
    create.pVulkanFunctions = &functions;
    std::array<VkDeviceSize, VK_MAX_MEMORY_HEAPS> limits{};
    if (const auto limit = fileMemoryLimit(info)) {
        limits.fill(*limit);
        create.pHeapSizeLimit = limits.data();
    }
    VmaAllocator allocator{};
    check(vmaCreateAllocator(&create, &allocator), "create the memory allocator");
    return allocator;
}

}  // namespace

// ---- The pipeline cache on disk -----------------------------------------------------------------

PipelineCache::PipelineCache(VkDevice device, const DeviceInfo& info) : device_(device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(info.handle, &properties);
    file_ = cacheFile(properties);
    if (!file_.empty()) loaded_ = checkedData(file_);
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
    if (isGivenUp(device_)) return;
    std::size_t size = 0;
    std::vector<char> data;
    if (vkGetPipelineCacheData(device_, cache_, &size, nullptr) == VK_SUCCESS) {
        data.resize(size);
        if (vkGetPipelineCacheData(device_, cache_, &size, data.data()) != VK_SUCCESS) size = 0;
        data.resize(size);
    }
    vkDestroyPipelineCache(device_, cache_, nullptr);
    if (file_.empty() || data.empty() || data == loaded_ || data.size() > kMostCacheBytes / 4)
        return;

    try {
        replaceFile(file_, [&](std::ostream& stream) {
            stream.write(data.data(), static_cast<std::streamsize>(data.size())) << trailerOf(data);
        });
    } catch (const Error&) {  // the next start compiles them again
    }
    // The drivers of the oldest files may be gone.
    trimCache(file_.parent_path(), kMostCacheBytes, [](std::string_view name) {
        return name.starts_with("pipelines-");
    });
}

// ---- The store of pipelines ---------------------------------------------------------------------

PipelineStore::Objects
PipelineStore::get(const std::string& key, const std::function<PipelineObjects()>& make) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(lru_, key, &decltype(lru_)::value_type::first);
    if (found != lru_.end())
        lru_.splice(lru_.begin(), lru_, found);
    else
        lru_.emplace_front(key, std::make_shared<const PipelineObjects>(make()));
    if (lru_.size() > kMost) lru_.pop_back();
    const Objects& objects = lru_.front().second;
    programs_.insert(programs_.end(), objects->programs.begin(), objects->programs.end());
    return objects;
}

std::vector<ShaderProgram> PipelineStore::takePrograms() {
    const std::lock_guard lock(mutex_);
    return std::exchange(programs_, {});
}

// ---- The logical device -------------------------------------------------------------------------

Device::Device(const DeviceOptions& options)
    : instance_(options.validation, options.window_extensions),
      info_(chooseDevice(instance_, options.wanted)),
      patience_(options.patience.value_or(
          info_.type == DeviceType::cpu ? std::chrono::hours(1) : std::chrono::minutes(10))) {
    if (!instance_.allowsPresentFences()) info_.features.erase(Feature::present_fences);
    if (options.mask) options.mask(info_);
    if (!has(Feature::mesh_shader)) info_.features.erase(Feature::mesh_statistics);
    std::vector<const char*> extensions;
    if (!options.window_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    fileMemoryLimit(info_);  // before the driver takes any memory
    device_.reset(createDevice(info_, extensions));
    // With one device, its functions can be called directly, without the loader. With several
    // devices, calls must go through the loader, which dispatches by handle; Instance has just
    // loaded those functions.
    if (devices_alive++ == 0) volkLoadDevice(get());
    vkGetDeviceQueue(get(), info_.queue_family, 0, &queue_);
    compute_queue_ = queue_;
    if (has(Feature::second_queue))
        vkGetDeviceQueue(
            get(), info_.compute_family, info_.compute_family == info_.queue_family ? 1 : 0,
            &compute_queue_);
    allocator_.reset(createAllocator(instance_.get(), info_, get()));
    if (options.validation != Validation::off || options.keeps_uses)
        hazards_ = std::make_unique<HazardLog>(instance_.messages(), *resources_);
    shaders_ = std::make_unique<ShaderLibrary>();
    cache_ = std::make_unique<PipelineCache>(get(), info_);
    pipelines_ = std::make_unique<PipelineStore>();
    if (options.shader_figures == ShaderFigures::required)
        require(Feature::shader_figures, info_.name);
    shader_figures_ =
        options.shader_figures != ShaderFigures::unasked && has(Feature::shader_figures);

    const VkCommandPoolCreateInfo pool{
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .pNext = nullptr,
        .flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT,
        .queueFamilyIndex = info_.queue_family};
    VkCommandPool handle{};
    check(vkCreateCommandPool(get(), &pool, nullptr, &handle), "create a command pool");
    pool_ = {get(), handle};
    fence_ = Fence(get());
}

Device::~Device() {
    if (isGivenUp(get()))
        instance_.abandon();
    else
        vkDeviceWaitIdle(get());
}

void Device::DestroyDevice::operator()(VkDevice device) const {
    if (!isGivenUp(device)) vkDestroyDevice(device, nullptr);
    --devices_alive;
}

void Device::DestroyAllocator::operator()(VmaAllocator_T* allocator) const {
    VmaAllocatorInfo info{};
    vmaGetAllocatorInfo(allocator, &info);
    if (!isGivenUp(info.device)) vmaDestroyAllocator(allocator);
}

std::vector<std::uint32_t> Device::queueFamilies() const {
    if (!has(Feature::second_queue) || info_.compute_family == info_.queue_family)
        return {info_.queue_family};
    return {info_.queue_family, info_.compute_family};
}

void Device::require(Feature feature, const std::string& context) const {
    if (!has(feature))
        throw Unsupported(context, "the device has no " + std::string(featureName(feature)));
}

std::uint32_t Device::maxTessellatedVertices() const {
    return info_.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE
               ? 65536
               : std::numeric_limits<std::uint32_t>::max();
}

bool Device::supportsSamples(std::uint32_t samples) const {
    return (info_.limits.framebufferColorSampleCounts & info_.limits.framebufferDepthSampleCounts &
            samples) != 0;
}

bool Device::fragmentCountsAreApproximate() const {
    return info_.driver_id == VK_DRIVER_ID_MESA_LLVMPIPE &&
           info_.driver_version.starts_with("Mesa 22");
}

std::uint64_t Device::allocatedBytes() const {
    VmaTotalStatistics statistics{};
    vmaCalculateStatistics(allocator(), &statistics);
    return statistics.total.statistics.allocationBytes;
}

std::uint64_t Device::freeBytes() const {
    const VkPhysicalDeviceMemoryProperties* memory{};
    vmaGetMemoryProperties(allocator(), &memory);
    std::vector<VmaBudget> budgets(memory->memoryHeapCount);
    vmaGetHeapBudgets(allocator(), budgets.data());
    std::uint64_t largest = 0;
    std::uint64_t free = 0;
    for (std::uint32_t i = 0; i < memory->memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memory->memoryHeaps[i];
        if (!(heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) || heap.size <= largest) continue;
        largest = heap.size;
        free = budgets[i].budget - std::min(budgets[i].budget, budgets[i].usage);
    }
    return free;
}

TrackedResources::Entry
Device::track(VmaAllocation_T* allocation, TrackedResources::Resource resource) const {
    VmaAllocationInfo info{};
    vmaGetAllocationInfo(allocator(), allocation, &info);
    const VkPhysicalDeviceMemoryProperties* memory{};
    vmaGetMemoryProperties(allocator(), &memory);
    const VkMemoryType& type = memory->memoryTypes[info.memoryType];
    resource.memory.heap = type.heapIndex;
    resource.memory.device_local = (type.propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
    resource.allocated = info.size;
    return resources_->add(std::move(resource));
}

void Device::setName(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!vkSetDebugUtilsObjectNameEXT) return;
    const VkDebugUtilsObjectNameInfoEXT info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .pNext = nullptr,
        .objectType = type,
        .objectHandle = handle,
        .pObjectName = name.c_str()};
    vkSetDebugUtilsObjectNameEXT(get(), &info);
}

void Device::submitOnce(const std::function<void(VkCommandBuffer)>& record) const {
    const VkCommandBufferAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .pNext = nullptr,
        .commandPool = pool_.get(),
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    VkCommandBuffer buffer{};
    check(vkAllocateCommandBuffers(get(), &allocate, &buffer), "allocate a command buffer");
    const auto free = [this](VkCommandBuffer each) {
        if (!isGivenUp(get())) vkFreeCommandBuffers(get(), pool_.get(), 1, &each);
    };
    const std::unique_ptr<VkCommandBuffer_T, decltype(free)> owned(buffer, free);
    record(buffer);

    const VkCommandBufferSubmitInfo submitted{
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .pNext = nullptr,
        .commandBuffer = buffer,
        .deviceMask = 0};
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &submitted;
    const VkFence fence = fence_.ready();
    check(vkQueueSubmit2(queue_, 1, &submit, fence), "submit");
    await("wait for the device", [&](std::uint64_t nanoseconds) {
        return vkWaitForFences(get(), 1, &fence, VK_TRUE, nanoseconds);
    });
    if (hazards_) hazards_->finish(hazards_->submissions());
}

std::chrono::steady_clock::time_point Device::beginWait(const char* what) const {
    if (isGivenUp(get())) throw DeviceSilent(what, "the device was given up");
    return std::chrono::steady_clock::now();
}

bool Device::isOver(
    const char* what, VkResult result, std::chrono::steady_clock::time_point start) const {
    const bool lacks_memory =
        result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (result != VK_TIMEOUT && !lacks_memory) {
        check(result, what);
        return true;
    }
    if (std::chrono::steady_clock::now() - start > patience_) {
        giveUp(get());
        std::ostringstream seconds;
        seconds << patience_.count();
        const std::string reason = "the device did not answer for " + seconds.str() + " s";
        throw DeviceSilent(what, lacks_memory ? reason + ": " + resultName(result) : reason);
    }
    if (lacks_memory) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return false;
}

}  // namespace engine
