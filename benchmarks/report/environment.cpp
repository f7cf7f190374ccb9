#include "benchmarks/report/environment.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <thread>
#include <utility>

#include <sys/utsname.h>
#include <unistd.h>

#include "build_info.h"

namespace benchmarks::report {
namespace {

// ---- Device -------------------------------------------------------------------------------------

template <class Number>
struct Limit {
    const char* name;
    Number VkPhysicalDeviceLimits::* member;
};

// What decides which cases run here, and how their draws, groups and buffers are cut.
constexpr Limit<std::uint32_t> kCounts[] = {
    {"maxTessellationGenerationLevel", &VkPhysicalDeviceLimits::maxTessellationGenerationLevel},
    {"maxTessellationPatchSize", &VkPhysicalDeviceLimits::maxTessellationPatchSize},
    {"maxGeometryOutputVertices", &VkPhysicalDeviceLimits::maxGeometryOutputVertices},
    {"maxComputeWorkGroupInvocations", &VkPhysicalDeviceLimits::maxComputeWorkGroupInvocations},
    {"maxComputeSharedMemorySize", &VkPhysicalDeviceLimits::maxComputeSharedMemorySize},
    {"maxPushConstantsSize", &VkPhysicalDeviceLimits::maxPushConstantsSize},
    {"maxStorageBufferRange", &VkPhysicalDeviceLimits::maxStorageBufferRange},
    {"maxImageDimension2D", &VkPhysicalDeviceLimits::maxImageDimension2D},
    {"maxMemoryAllocationCount", &VkPhysicalDeviceLimits::maxMemoryAllocationCount},
    {"framebufferColorSampleCounts", &VkPhysicalDeviceLimits::framebufferColorSampleCounts},
    {"framebufferDepthSampleCounts", &VkPhysicalDeviceLimits::framebufferDepthSampleCounts},
};

// "10de:2336", as the PCI registry writes it; vendors without a PCI number are above 10000.
std::string idOf(VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    char text[32];
    std::snprintf(text, sizeof text, "%04x:%04x", properties.vendorID, properties.deviceID);
    return text;
}

}  // namespace

DeviceRecord describeDevice(const engine::Device& of) {
    const engine::DeviceInfo& device = of.info();
    DeviceRecord record{
        .name = device.name,
        .type = device.type,
        .driver = device.driver,
        .driver_version = device.driver_version,
        .api_version = device.api_version,
        .timestamp_period_ns = double{device.limits.timestampPeriod},
        .id = idOf(device.handle),
        .timestamp_valid_bits = device.timestamp_valid_bits,
        .limits = {}};
    for (const auto& [name, member] : kCounts)
        record.limits.emplace_back(name, device.limits.*member);
    if (of.maxTessellatedVertices() != std::numeric_limits<std::uint32_t>::max())
        record.limits.emplace_back("maxTessellatedVertices", of.maxTessellatedVertices());
    return record;
}

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(':');
        if (line.starts_with("model name") && colon + 2 < line.size())
            return line.substr(colon + 2);
    }
    return {};
}

namespace {

// ---- Host, build, command -----------------------------------------------------------------------

std::string systemName() {
    std::string name;
    std::ifstream file("/etc/os-release");
    for (std::string line; std::getline(file, line);) {
        constexpr std::string_view kKey = "PRETTY_NAME=\"";
        if (line.starts_with(kKey)) name = line.substr(kKey.size(), line.size() - kKey.size() - 1);
    }
    utsname system{};
    if (uname(&system) == 0) {
        const std::string kernel = std::string(system.sysname) + " " + system.release;
        name += name.empty() ? kernel : ", " + kernel;
    }
    return name;
}

std::string utcNow() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

HostRecord describeHost() {
    HostRecord host{
        .system = systemName(),
        .processor = processorName(),
        .processor_count = std::thread::hardware_concurrency(),
        .memory_bytes = std::nullopt};
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_size = sysconf(_SC_PAGE_SIZE);
    if (pages > 0 && page_size > 0) {
        host.memory_bytes =
            static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size);
    }
    return host;
}

}  // namespace

BuildRecord describeBuild() {
    BuildRecord build{
        .version = kBuildVersion,
        .commit = kBuildCommit,
        .compiler = kBuildCompiler,
        .type = kBuildType,
        .flags = kBuildFlags,
        .dirty = std::nullopt};
    if (!build.commit.empty()) build.dirty = kBuildDirty;
    return build;
}

std::string versionText() {
    const std::string commit = kBuildCommit;
    return "hairbench " + std::string(kBuildVersion) + (commit.empty() ? "" : " (" + commit + ")");
}

std::string versionOnDevice(const engine::Device& device) {
    const engine::DeviceInfo& info = device.info();
    return versionText() + " on " + info.name + " (" + info.driver + ' ' + info.driver_version +
           ')';
}

Environment describeEnvironment(
    const engine::Device& device, std::vector<std::string> command, std::uint64_t seed,
    engine::Validation validation) {
    return {
        .device = describeDevice(device),
        .host = describeHost(),
        .build = describeBuild(),
        .command = std::move(command),
        .started = utcNow(),
        .seed = seed,
        .validation = validation != engine::Validation::off};
}

// ---- Hashes -------------------------------------------------------------------------------------

std::string hashBytes(std::span<const std::byte> bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;  // offset basis
    for (const std::byte byte : bytes) {
        hash ^= static_cast<std::uint64_t>(byte);
        hash *= 0x00000100000001b3u;  // prime
    }
    std::string digits(16, '0');
    for (std::size_t i = digits.size(); i-- > 0; hash >>= 4)
        digits[i] = "0123456789abcdef"[hash & 0xf];
    return digits;
}

std::string hashText(std::string_view text) { return hashBytes(std::as_bytes(std::span(text))); }

}  // namespace benchmarks::report
