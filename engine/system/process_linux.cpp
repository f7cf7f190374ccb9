#include "engine/system/process.h"

#include <csignal>
#include <ctime>
#include <mutex>
#include <thread>

#include <fcntl.h>
#include <linux/perf_event.h>
#include <semaphore.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace engine::system {

// ---- Start and end ------------------------------------------------------------------------------

void prepareStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0)
            open(stream == STDOUT_FILENO ? "/dev/full" : "/dev/null", O_RDWR);
}

namespace {

// Global, because a signal handler can reach nothing else.
void (*interrupt_came)() = nullptr;
sem_t interrupt_signal;  // posted by the handler

extern "C" void onInterrupt(int signal) {
    interrupt_came();
    sem_post(&interrupt_signal);
    std::signal(signal, SIG_DFL);
}

}  // namespace

void watchInterrupts(void (*came)(), void (*watch)()) {
    static std::once_flag once;
    std::call_once(once, [=] {
        interrupt_came = came;
        sem_init(&interrupt_signal, 0, 0);
        std::thread([watch] {
            while (sem_wait(&interrupt_signal) != 0) {
            }
            watch();
        }).detach();
    });
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    std::signal(SIGHUP, onInterrupt);
    std::signal(SIGXFSZ, SIG_IGN);
}

void endNow(int status) { _exit(status); }

// ---- The terminal -------------------------------------------------------------------------------

bool hasTerminal() { return isatty(STDERR_FILENO) != 0; }

std::size_t terminalWidth() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

// ---- Use of the processors ----------------------------------------------------------------------

namespace {

double millisecondsOf(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

// Share of the time that a counter may miss: threads can switch counters between two reads of the
// clock.
constexpr double kMissedShare = 1e-3;

// Data of a counter with PERF_FORMAT_TOTAL_TIME_ENABLED and _RUNNING.
struct Reading {
    std::uint64_t count;
    std::uint64_t enabled;  // ns that the counter was enabled, over all threads
    std::uint64_t running;  // ns of these in which it counted
};

}  // namespace

double threadTime() { return millisecondsOf(CLOCK_THREAD_CPUTIME_ID); }

double processTime() { return millisecondsOf(CLOCK_PROCESS_CPUTIME_ID); }

void lowerPriority() {
    // Linux sets it per thread. The thread gets about a third of a normal thread's share.
    constexpr int kNice = 5;
    const auto thread = static_cast<id_t>(syscall(SYS_gettid));
    setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kNice);
}

static_assert(
    kInstructions.type == PERF_TYPE_HARDWARE && kInstructions.config == PERF_COUNT_HW_INSTRUCTIONS);

PerfCounter::PerfCounter(Event event) {
    perf_event_attr attributes{};
    attributes.size = sizeof attributes;
    attributes.type = event.type;
    attributes.config = event.config;
    attributes.inherit = 1;
    attributes.exclude_kernel = 1;  // the most that kernel.perf_event_paranoid 2 allows
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

// ---- Limits -------------------------------------------------------------------------------------

std::optional<std::uint64_t> largestFile() {
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::nullopt;
    return limit.rlim_cur;
}

}  // namespace engine::system
