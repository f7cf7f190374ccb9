#pragma once

#include <cstdint>
#include <optional>

namespace engine {

// One of the kernel's counters, of the thread that makes it and of every thread that starts under
// it from then on (perf_event_open(2) with `inherit`): what they do in user mode. Threads that run
// already when it is made are not counted.
class PerfCounter {
public:
    // PERF_TYPE_* and PERF_COUNT_* of <linux/perf_event.h>. A kernel, a container or a machine that
    // has no such counter for us is no error: read() is empty then.
    PerfCounter(std::uint32_t type, std::uint64_t config);
    ~PerfCounter();
    PerfCounter(const PerfCounter&) = delete;
    PerfCounter& operator=(const PerfCounter&) = delete;

    // Events so far, those of threads that still run and of threads that have ended. Empty too
    // where the counter had to share the processor's with others, so that the kernel missed some.
    std::optional<double> read() const;

private:
    int file_;  // -1: none
};

}  // namespace engine
