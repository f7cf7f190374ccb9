#include "engine/perf_counter.h"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace engine {

namespace {

// Share of the time that may be missing from a count: threads take turns with counters between two
// reads of the clock.
constexpr double kMissedShare = 1e-3;

// With PERF_FORMAT_TOTAL_TIME_ENABLED and _RUNNING.
struct Reading {
    std::uint64_t count;
    std::uint64_t enabled;  // ns that the counter was wanted, over all threads
    std::uint64_t running;  // ns of it that it counted
};

}  // namespace

PerfCounter::PerfCounter(std::uint32_t type, std::uint64_t config) {
    perf_event_attr attributes{};
    attributes.size = sizeof attributes;
    attributes.type = type;
    attributes.config = config;
    attributes.inherit = 1;
    attributes.exclude_kernel = 1;  // all that is allowed by kernel.perf_event_paranoid 2
    attributes.exclude_hv = 1;
    attributes.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    file_ = static_cast<int>(
        syscall(SYS_perf_event_open, &attributes, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

PerfCounter::~PerfCounter() {
    if (file_ >= 0) close(file_);
}

std::optional<double> PerfCounter::read() const {
    Reading reading{};
    if (file_ < 0 || ::read(file_, &reading, sizeof reading) != sizeof reading) return std::nullopt;
    const auto wanted = static_cast<double>(reading.enabled);
    if (static_cast<double>(reading.running) < (1.0 - kMissedShare) * wanted) return std::nullopt;
    return static_cast<double>(reading.count);
}

}  // namespace engine
