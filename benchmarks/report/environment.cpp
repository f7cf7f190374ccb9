#include "benchmarks/report/environment.h"

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <thread>
#include <utility>

#include "build_info.h"
#include "engine/system/machine.h"

namespace benchmarks::report {
namespace {

// ---- Device -------------------------------------------------------------------------------------

template <class Number>
struct Limit {
    const char* name;
    Number VkPhysicalDeviceLimits::* member;
};

// Limits that decide which cases run on this device, and how draws, work groups and buffers are
// split.
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

// "10de:2336", as in the PCI registry. Vendors without a PCI number have ids above 10000 (hex).
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
        .timestamp_valid_bits = device.timestamp_valid_bits};
    for (const auto& [name, member] : kCounts)
        record.limits.emplace_back(name, device.limits.*member);
    if (of.maxTessellatedVertices() != std::numeric_limits<std::uint32_t>::max())
        record.limits.emplace_back("maxTessellatedVertices", of.maxTessellatedVertices());
    return record;
}

namespace {

// ---- Host, build, command -----------------------------------------------------------------------

std::string utcNow() {
    using namespace std::chrono;
    const auto now = floor<seconds>(system_clock::now());
    const auto today = floor<days>(now);
    const year_month_day date(today);
    const hh_mm_ss time(now - today);
    char text[64];
    std::snprintf(
        text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02dZ", static_cast<int>(date.year()),
        static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
        static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
        static_cast<int>(time.seconds().count()));
    return text;
}

HostRecord describeHost() {
    return {
        .system = engine::system::systemName(),
        .processor = engine::system::processorName(),
        .processor_count = std::thread::hardware_concurrency(),
        .memory_bytes = engine::system::memoryBytes()};
}

}  // namespace

BuildRecord describeBuild() {
    BuildRecord build{
        .version = kBuildVersion,
        .commit = kBuildCommit,
        .compiler = kBuildCompiler,
        .type = kBuildType,
        .flags = kBuildFlags};
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

namespace {

constexpr std::size_t kShaBlock = 64;  // B
using ShaState = std::array<std::uint32_t, 8>;

// Returns the first 32 fractional bits of a root of each of the first primes.
template <std::size_t count>
std::array<std::uint32_t, count> primeRoots(double exponent) {
    std::array<std::uint32_t, count> roots{};
    std::size_t found = 0;
    for (std::uint32_t number = 2; found < count; ++number) {
        bool prime = true;
        for (std::uint32_t i = 2; i * i <= number; ++i) prime = prime && number % i != 0;
        if (!prime) continue;
        // A double has 53 bits. The whole part takes at most 3 and the result 32, so rounding does
        // no harm.
        const double root = std::pow(static_cast<double>(number), exponent);
        roots[found++] =
            static_cast<std::uint32_t>(std::floor((root - std::floor(root)) * 4294967296.0));
    }
    return roots;
}

void addShaBlock(ShaState& state, const unsigned char* block) {
    static const auto constants = primeRoots<64>(1.0 / 3.0);
    std::array<std::uint32_t, 64> words{};
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t byte = 0; byte < 4; ++byte) words[i] = words[i] << 8 | block[4 * i + byte];
    for (std::size_t i = 16; i < words.size(); ++i) {
        const std::uint32_t a = words[i - 15], b = words[i - 2];
        words[i] = words[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + words[i - 7] +
                   (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
    }
    auto [a, b, c, d, e, f, g, h] = state;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                    ((e & f) ^ (~e & g)) + constants[i] + words[i];
        const std::uint32_t second =
            (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
        h = std::exchange(g, std::exchange(f, std::exchange(e, d + first)));
        d = std::exchange(c, std::exchange(b, std::exchange(a, first + second)));
    }
    const ShaState mixed{a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += mixed[i];
}

}  // namespace

std::string sha256(std::string_view text) {
    std::string padded(text);
    padded += '\x80';
    padded.resize((padded.size() + 8 + kShaBlock - 1) / kShaBlock * kShaBlock - 8);
    const std::uint64_t bits = std::uint64_t{text.size()} * 8;
    for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>(bits >> shift);
    ShaState state = primeRoots<8>(0.5);
    for (std::size_t i = 0; i < padded.size(); i += kShaBlock)
        addShaBlock(state, reinterpret_cast<const unsigned char*>(padded.data()) + i);
    std::string digits;
    for (const std::uint32_t word : state)
        for (int shift = 28; shift >= 0; shift -= 4)
            digits += "0123456789abcdef"[word >> shift & 0xf];
    return digits;
}

}  // namespace benchmarks::report
