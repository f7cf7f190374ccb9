#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "engine/buffer_image.h"
#include "engine/device.h"
#include "hair/settings.h"

// The memory that a case needs, known before it is made, and the memory that is available.
namespace benchmarks::measure {

class HairCache;

struct CaseMemory {
    report::MemoryNeed need{};
    // The buffers and images of the case, once it is made, without pictures and further meshes.
    engine::MemoryRows rows;
};

// Upper bound of the memory of a case while it is made and measured, from its settings, the counts
// of its groom and the sizes of its files. The counts are exact for a groom or a mesh in `cache`;
// the content of compressed files is estimated from their sizes. If pictures and strands dominate,
// and not some small buffers, the bound for device memory is at most three times the peak of live
// allocations. The host's memory is that of the program with the case, without device memory.
// Throws engine::Unsupported if the device can't draw the case.
CaseMemory caseMemory(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, HairCache* cache = nullptr);

// Memory available to a case. `source` is the origin of the limit, like "--max-memory".
struct MemoryRoom {
    enum class Of { device, host, both };
    Of of = Of::both;
    std::uint64_t bytes = 0;
    std::string source;
};

// Memory left by the limit of the process's memory control group: the limit less the memory in use
// that cannot be reclaimed. The minimum over its groups up to the root; absent if none has a limit.
// `root` is the root of the file system.
std::optional<std::uint64_t> freeInControlGroup(const std::filesystem::path& root = "/");
// The kernel's estimate of the memory available without swapping; absent if it has none.
std::optional<std::uint64_t> availableMemory(const std::filesystem::path& root = "/");

// The memory available now. For the device it is its budget; for the host it is the limit of its
// control group and the available memory. The host's limits also apply to a software device.
// `most`, B, also limits each of them if given.
std::vector<MemoryRoom>
memoryRooms(const engine::Device& device, std::optional<std::uint64_t> most);

// Returns why a case does not fit: "needs about 3.10 GB of device memory; 2.15 GB are free
// (--max-memory)". Empty if it fits.
std::string whyItDoesNotFit(const report::MemoryNeed& need, const std::vector<MemoryRoom>& rooms);

// Parses "500M", "2G", "1.5GiB": a number with K, M, G or T for powers of 1024, with KB, MB, GB or
// TB for powers of 1000, or plain bytes. Throws engine::Error.
std::uint64_t parseMemorySize(const std::string& text);

}  // namespace benchmarks::measure
