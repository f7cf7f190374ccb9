#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace benchmarks {

// What all processors did since the machine started, in ticks (of 10 ms on most machines), by the
// first line of Linux's /proc/stat (proc_stat(5)).
struct ProcessorTicks {
    std::uint64_t busy = 0;   // in processes and in the kernel
    std::uint64_t steal = 0;  // that a hypervisor gave to others
    std::uint64_t total = 0;  // with what was idle
};

// Absent where there is no such file or it is not understood.
std::optional<ProcessorTicks> readProcessorTicks(const std::filesystem::path& path = "/proc/stat");

// Shares of all processors' time.
struct ProcessorLoad {
    double steal = 0.0;
    double others = 0.0;  // what other processes used; ticks are coarse, so it is cut off at 0
};

// Between two readings, in which this process used `own` ms of processor time. Absent where no tick
// passed.
std::optional<ProcessorLoad>
loadBetween(const ProcessorTicks& before, const ProcessorTicks& after, double own);

}  // namespace benchmarks
