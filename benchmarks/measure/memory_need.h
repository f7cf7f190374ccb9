#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "engine/device.h"
#include "hair/settings.h"

// What memory a case needs, known before it is made, and how much there is.
namespace benchmarks::measure {

class HairCache;

// What the case takes at most while it is made and measured: by its settings, the counts of its
// groom and the sizes of the files that it names. Of a groom or a mesh that `cache` has the counts
// are exact; what compressed files hold is guessed from their sizes. Device memory is at most three
// times what live allocations hold then, where pictures and strands, not some small buffers, are
// what takes it. The host's is that of the program with the case, without the device's memory.
// Throws engine::Unsupported where the device can't draw the case.
report::MemoryNeed memoryNeed(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, HairCache* cache = nullptr);

// How much memory there is for a case. `source` is who says so: "--max-memory".
struct MemoryRoom {
    enum class Of { device, host, both };
    Of of = Of::both;
    std::uint64_t bytes = 0;
    std::string source;
};

// What the limit of the process's control group of memory leaves: limit less what is in use and
// can't be given back. The least of its groups' up to the root; absent where none has a limit.
// `root` is the root of the file system.
std::optional<std::uint64_t> freeInControlGroup(const std::filesystem::path& root = "/");
// What the kernel says that a program could take without swapping; absent where it doesn't.
std::optional<std::uint64_t> availableMemory(const std::filesystem::path& root = "/");

// What there is now: of the device its budget, of the host its control group and what is available,
// which on a software device is the device's too, and `most`, B, of either where it is there.
std::vector<MemoryRoom>
memoryRooms(const engine::Device& device, std::optional<std::uint64_t> most);

// Why a case does not fit: "needs about 3.10 GB of device memory; 2.15 GB are free (--max-memory)".
// Empty where it does.
std::string whyItDoesNotFit(const report::MemoryNeed& need, const std::vector<MemoryRoom>& rooms);

// "500M", "2G", "1.5GiB": a number with K, M, G or T for powers of 1024, or KB, MB, GB or TB for
// those of 1000; bytes without. Throws engine::Error.
std::uint64_t parseMemorySize(const std::string& text);

}  // namespace benchmarks::measure
