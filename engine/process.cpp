#include "engine/process.h"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <system_error>

#include <linux/perf_event.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "engine/error.h"

namespace engine {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;  // a signal handler can reach nothing but a global

extern "C" void onInterrupt(int signal) {
    interrupt_count = 1;
    std::signal(signal, SIG_DFL);
}

// Share of the time that may be missing from a count: threads take turns with counters between two
// reads of the clock.
constexpr double kMissedShare = 1e-3;

// What is read of a counter with PERF_FORMAT_TOTAL_TIME_ENABLED and _RUNNING.
struct Reading {
    std::uint64_t count;
    std::uint64_t enabled;  // ns that the counter was wanted, over all threads
    std::uint64_t running;  // ns of it that it counted
};

template <class Operation>
std::optional<double>
both(const std::optional<double>& a, const std::optional<double>& b, Operation operation) {
    if (!a || !b) return std::nullopt;
    return operation(*a, *b);
}

}  // namespace

// ---- Interrupts ---------------------------------------------------------------------------------

void catchInterrupts() {
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    std::signal(SIGHUP, onInterrupt);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return interrupt_count != 0; }

void checkInterrupted() {
    if (interrupted()) throw Interrupted();
}

// ---- Scratch folders ----------------------------------------------------------------------------

ScratchFolder::ScratchFolder() {
    std::string path = (std::filesystem::temp_directory_path() / "hairbench-XXXXXX").string();
    if (!mkdtemp(path.data())) throw engine::Error(path, "can't be made");
    path_ = path;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

// ---- Counters of the kernel ---------------------------------------------------------------------

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

// ---- Use of the CPU -----------------------------------------------------------------------------

namespace {

double millisecondsOf(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

}  // namespace

ProcessUse operator-(const ProcessUse& to, const ProcessUse& from) {
    return {to.cpu - from.cpu, both(to.instructions, from.instructions, std::minus<>())};
}

ProcessUse operator+(const ProcessUse& a, const ProcessUse& b) {
    return {a.cpu + b.cpu, both(a.instructions, b.instructions, std::plus<>())};
}

double threadTime() { return millisecondsOf(CLOCK_THREAD_CPUTIME_ID); }

ProcessUse processUse() {
    static const PerfCounter instructions(PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS);
    return {millisecondsOf(CLOCK_PROCESS_CPUTIME_ID), instructions.read()};
}

void giveWay() {
    // Of a thread, on Linux. About a third of the share of a thread that does not.
    constexpr int kNice = 5;
    const auto thread = static_cast<id_t>(syscall(SYS_gettid));
    setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kNice);
}

}  // namespace engine
