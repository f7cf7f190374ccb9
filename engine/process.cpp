#include "engine/process.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

#include "engine/system/files.h"
#include "engine/system/process.h"

namespace engine {
namespace {

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

static_assert(std::atomic<bool>::is_always_lock_free);  // otherwise a handler must not touch it

// Who handles an interrupt: the first to claim it.
enum class Heeded { not_yet, by_work, by_end };
std::atomic<Heeded> heeded = Heeded::not_yet;
thread_local bool ends_program = false;  // this thread, in endInterrupted()

// Time for work to report that it ends itself.
constexpr auto kPatience = 1200ms;
// Time for a device to finish its submitted work.
constexpr auto kDevicePatience = 700ms;

// Last actions of endInterrupted(): files to remove and InterruptMessages to call.
struct Ending {
    std::mutex mutex;
    std::recursive_mutex speaking;  // held by HeldMessages, and by who ends the program
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

[[noreturn]] void leave(int status) {
    std::multiset<std::filesystem::path> leftovers;
    {
        const std::lock_guard lock(ending().mutex);
        leftovers = ending().leftovers;
    }
    std::error_code ignored;
    for (const std::filesystem::path& each : leftovers) std::filesystem::remove_all(each, ignored);
    system::endNow(status);
}

[[noreturn]] void waitForEver() {
    for (;;) std::this_thread::sleep_for(1h);
}

// The caller has claimed the end. Other threads work on until they ask or change results.
[[noreturn]] void endWithLastWords() {
    ends_program = true;
    const HeldMessages held;
    int status = kInterruptedStatus;
    forgetSteps();
    try {
        const InterruptMessage* words = ending().last_words;
        if (!words) std::cerr << "interrupted\n";
        for (; words; words = words->before()) words->speak();
    } catch (const std::exception& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        status = 1;
    }
    std::cout.flush();
    std::fflush(stdout);
    leave(status);
}

// Runs on a thread of its own after an interrupt.
void endUnheeded() {
    std::this_thread::sleep_for(kPatience);
    Heeded now = Heeded::not_yet;
    if (heeded.compare_exchange_strong(now, Heeded::by_end)) endWithLastWords();
}

// The work ends the program from here on, except if another thread already does.
void claimEnd() {
    Heeded now = Heeded::not_yet;
    heeded.compare_exchange_strong(now, Heeded::by_work);
    if (now == Heeded::by_end) waitForEver();
}

}  // namespace

void catchInterrupts() {
    system::watchInterrupts([] { interrupt_came = true; }, endUnheeded);
}

bool interrupted() {
    if (!interrupt_came || ends_program) return false;
    claimEnd();
    return true;
}

void finishInAnyCase() { claimEnd(); }

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
    const HeldMessages held;
    before_ = std::exchange(ending().last_words, this);
}

InterruptMessage::~InterruptMessage() {
    const HeldMessages held;
    ending().last_words = before_;
}

HeldMessages::HeldMessages() { ending().speaking.lock(); }

HeldMessages::~HeldMessages() { ending().speaking.unlock(); }

void endInterrupted() {
    if (heeded.exchange(Heeded::by_end) == Heeded::by_end)
        waitForEver();  // another thread ends the program
    endWithLastWords();
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

ScratchFolder::ScratchFolder() : path_(system::makeTemporaryFolder()) { leftover_.emplace(path_); }

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

// ---- Use of the CPU -----------------------------------------------------------------------------

ProcessUse operator-(const ProcessUse& to, const ProcessUse& from) {
    return {to.cpu - from.cpu, both(to.instructions, from.instructions, std::minus<>())};
}

ProcessUse operator+(const ProcessUse& a, const ProcessUse& b) {
    return {a.cpu + b.cpu, both(a.instructions, b.instructions, std::plus<>())};
}

double threadTime() { return system::threadTime(); }

ProcessUse processUse() {
    static const system::PerfCounter instructions(system::kInstructions);
    return {system::processTime(), instructions.read()};
}

void lowerPriority() { system::lowerPriority(); }

}  // namespace engine
