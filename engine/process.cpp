#include "engine/process.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <iostream>
#include <limits>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <linux/perf_event.h>
#include <semaphore.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "engine/error.h"

namespace engine {
namespace {

// Share of the time that a counter may miss: threads can switch counters between two reads of the
// clock.
constexpr double kMissedShare = 1e-3;

// Data of a counter with PERF_FORMAT_TOTAL_TIME_ENABLED and _RUNNING.
struct Reading {
    std::uint64_t count;
    std::uint64_t enabled;  // ns that the counter was enabled, over all threads
    std::uint64_t running;  // ns of these in which it counted
};

template <class Operation>
std::optional<double>
both(const std::optional<double>& a, const std::optional<double>& b, Operation operation) {
    if (!a || !b) return std::nullopt;
    return operation(*a, *b);
}

}  // namespace

// ---- Interrupts ---------------------------------------------------------------------------------

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// The interrupt state is global, because a signal handler can reach nothing else.
std::atomic<bool> interrupt_came = false;
sem_t interrupt_signal;  // posted by the handler, for watchInterrupts()

static_assert(std::atomic<bool>::is_always_lock_free);  // otherwise a handler must not touch it

// Who handles an interrupt: the first to claim it.
enum class Heeded { not_yet, by_work, by_end };
std::atomic<Heeded> heeded = Heeded::not_yet;

// Time for work to report that it ends itself.
constexpr auto kPatience = 1200ms;
// Time for a device to finish its submitted work.
constexpr auto kDevicePatience = 700ms;

extern "C" void onInterrupt(int signal) {
    interrupt_came = true;
    sem_post(&interrupt_signal);
    std::signal(signal, SIG_DFL);
}

// Last actions of endInterrupted(): files to remove and InterruptMessages to call.
struct Ending {
    std::mutex mutex;
    std::multiset<std::filesystem::path> leftovers;
    const InterruptMessage* last_words = nullptr;
    std::optional<Clock::time_point> came;  // first seen by a waiting thread
};

Ending& ending() {
    static Ending& all = *new Ending;  // never destroyed: threads may need it until the very end
    return all;
}

// Time limit of the current work.
constexpr Clock::rep kNoEnd = std::numeric_limits<Clock::rep>::max();
struct {
    std::atomic<Clock::rep> end = kNoEnd;  // on Clock
    std::string reason;  // guarded by the mutex of Ending
} time_limit;

void sayInterrupted() {
    forgetSteps();
    std::cerr << "interrupted\n";
}

[[noreturn]] void leave(int status) {
    std::multiset<std::filesystem::path> leftovers;
    {
        const std::lock_guard lock(ending().mutex);
        leftovers = ending().leftovers;
    }
    std::error_code ignored;
    for (const std::filesystem::path& each : leftovers) std::filesystem::remove_all(each, ignored);
    _exit(status);
}

// Runs on a thread of its own.
[[noreturn]] void watchInterrupts() {
    while (sem_wait(&interrupt_signal) != 0) {
    }
    std::this_thread::sleep_for(kPatience);
    Heeded now = Heeded::not_yet;
    if (heeded.compare_exchange_strong(now, Heeded::by_end)) {
        sayInterrupted();
        leave(kInterruptedStatus);
    }
    for (;;) pause();
}

}  // namespace

void catchInterrupts() {
    static std::once_flag once;
    std::call_once(once, [] {
        sem_init(&interrupt_signal, 0, 0);
        std::thread(watchInterrupts).detach();
    });
    std::signal(SIGINT, onInterrupt);
    std::signal(SIGTERM, onInterrupt);
    std::signal(SIGHUP, onInterrupt);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
    if (!interrupt_came) return false;
    Heeded now = Heeded::not_yet;
    heeded.compare_exchange_strong(now, Heeded::by_work);
    return true;
}

void checkInterrupted() {
    if (interrupted()) throw Interrupted();
    if (Clock::now().time_since_epoch().count() < time_limit.end) return;
    const std::lock_guard lock(ending().mutex);
    throw TimedOut{time_limit.reason};
}

TimeLimit::TimeLimit(double seconds, const std::string& name) {
    if (seconds <= 0.0) return;
    std::ostringstream reason;
    reason << "not finished after " << seconds << " s (" << name << ')';
    const auto time =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const std::lock_guard lock(ending().mutex);
    time_limit.reason = reason.str();
    time_limit.end = (Clock::now() + time).time_since_epoch().count();
}

TimeLimit::~TimeLimit() { time_limit.end = kNoEnd; }

InterruptMessage::InterruptMessage(std::function<void()> speak) : speak_(std::move(speak)) {
    const std::lock_guard lock(ending().mutex);
    before_ = std::exchange(ending().last_words, this);
}

InterruptMessage::~InterruptMessage() {
    const std::lock_guard lock(ending().mutex);
    ending().last_words = before_;
}

void endInterrupted() {
    if (heeded.exchange(Heeded::by_end) == Heeded::by_end)
        for (;;) pause();  // another thread ends the program
    const InterruptMessage* words{};
    {
        const std::lock_guard lock(ending().mutex);
        words = ending().last_words;
    }
    int status = kInterruptedStatus;
    forgetSteps();
    try {
        if (!words) sayInterrupted();
        for (; words; words = words->before()) words->speak();
    } catch (const std::exception& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        status = 1;
    }
    std::cout.flush();
    std::fflush(stdout);
    leave(status);
}

void endIfLongInterrupted() {
    if (!interrupt_came) return;
    {
        const std::lock_guard lock(ending().mutex);
        std::optional<Clock::time_point>& came = ending().came;
        if (!came) came = Clock::now();
        if (Clock::now() < *came + kDevicePatience) return;
    }
    endInterrupted();
}

Leftover::Leftover(std::filesystem::path path) : path_(std::move(path)) {
    const std::lock_guard lock(ending().mutex);
    ending().leftovers.insert(path_);
}

Leftover::~Leftover() {
    const std::lock_guard lock(ending().mutex);
    ending().leftovers.erase(ending().leftovers.find(path_));
}

// ---- Progress -----------------------------------------------------------------------------------

namespace {

// Steps belong to the process, like its interrupts.
struct Steps {
    std::mutex mutex;
    std::vector<const Step*> under_way;  // in the order of their start
    std::function<void()> ended;
    bool forgotten = false;
};

Steps& steps() {
    static Steps& all = *new Steps;  // never destroyed: threads may need it until the very end
    return all;
}

void begin(const Step& step) {
    const std::lock_guard lock(steps().mutex);
    steps().under_way.push_back(&step);
}

}  // namespace

Step::Step(std::string name, std::uint64_t parts)
    : name_(std::move(name)), parts_(parts), start_(Clock::now()) {
    begin(*this);
}

Step::Step(std::function<std::string()> words) : words_(std::move(words)), start_(Clock::now()) {
    begin(*this);
}

Step::~Step() {
    std::function<void()> ended;
    {
        const std::lock_guard lock(steps().mutex);
        std::erase(steps().under_way, this);
        if (steps().under_way.empty()) ended = steps().ended;
    }
    if (ended) ended();  // outside the lock: observers of the steps may wait for this call
}

void Step::advance(std::uint64_t parts) {
    done_.fetch_add(parts, std::memory_order_relaxed);
    checkInterrupted();
}

std::string Step::text() const {
    if (words_) return words_();
    if (parts_ == 0) return name_;
    return name_ + ", " + std::to_string(std::min(done_.load(), parts_)) + " of " +
           std::to_string(parts_);
}

StepsUnderWay stepsUnderWay() {
    const std::lock_guard lock(steps().mutex);
    StepsUnderWay all{};
    if (steps().forgotten) return all;
    for (const Step* each : steps().under_way) {
        if (all.text.empty())
            all.start = each->start();
        else
            all.text += "  ";
        all.text += each->text();
    }
    return all;
}

void forgetSteps() {
    std::function<void()> ended;
    {
        const std::lock_guard lock(steps().mutex);
        steps().forgotten = true;
        ended = steps().ended;
    }
    if (ended) ended();
}

void onceStepsEnd(std::function<void()> ended) {
    const std::lock_guard lock(steps().mutex);
    steps().ended = std::move(ended);
}

// ---- Scratch folders ----------------------------------------------------------------------------

ScratchFolder::ScratchFolder() {
    std::string path = (std::filesystem::temp_directory_path() / "hairbench-XXXXXX").string();
    if (!mkdtemp(path.data())) throw engine::Error(path, "can't be made");
    path_ = path;
    leftover_.emplace(path_);
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

void lowerPriority() {
    // Linux sets it per thread. The thread gets about a third of a normal thread's share.
    constexpr int kNice = 5;
    const auto thread = static_cast<id_t>(syscall(SYS_gettid));
    setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + kNice);
}

}  // namespace engine
