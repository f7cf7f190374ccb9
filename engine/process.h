#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

// This process: interrupts, progress, scratch folders, and CPU use.
namespace engine {

// ---- Interrupts ---------------------------------------------------------------------------------

// From here on, Ctrl-C, termination and a closed terminal set a flag instead of ending the program,
// which must react within two seconds. A second interrupt ends the program at once. Exceeding the
// limit on file size becomes an error of the writer.
//
// There are three reactions, each with the exit status kInterruptedStatus:
// - work that calls interrupted() or checkInterrupted() ends itself;
// - a wait for a device (waitInterruptibly()) that isn't done 0.7 s after the interrupt ends the
//   program at once, by endInterrupted(), because a driver's work can't be cancelled;
// - if nothing asks for 1.2 s (kPatience), as within a library, another thread ends the program by
//   endInterrupted().
// A thread that asks, or changes what an InterruptMessage reads, while another thread ends the
// program, stops there for ever.
void catchInterrupts();

// Whether an interrupt came since catchInterrupts(). A caller that gets true must end its work:
// nobody else does. Returns false within an InterruptMessage: that is finished in any case.
bool interrupted();

// From here on the program's work is over and its results are written: an interrupt no longer ends
// the program before it ends by itself. A second interrupt does.
void finishInAnyCase();

// Thrown to end interrupted work.
class Interrupted {};

// Throws Interrupted after an interrupt, TimedOut after the end of a TimeLimit.
void checkInterrupted();

// Thrown to end work that exceeded its time limit.
struct TimedOut {
    std::string reason;  // "not finished after 60 s (/run/case_timeout)"
};

// Limits the time of work begun during this object's lifetime. Only one exists at a time. Work that
// never checks for interrupts ignores it.
class TimeLimit {
public:
    // `seconds`: 0 is no limit. `name`: the setting behind the limit.
    TimeLimit(double seconds, const std::string& name);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;
};

inline constexpr int kInterruptedStatus = 130;  // shell convention: 128 + SIGINT

// A function that prints messages and writes files before endInterrupted() ends the program, as
// long as this object lives. The newest object's function runs first. It must not wait for a
// device. Any thread may call it, while the others work: it reads only data that doesn't change, or
// that is changed under HeldMessages.
class InterruptMessage {
public:
    explicit InterruptMessage(std::function<void()> speak);
    ~InterruptMessage();
    InterruptMessage(const InterruptMessage&) = delete;
    InterruptMessage& operator=(const InterruptMessage&) = delete;

    void speak() const { speak_(); }
    const InterruptMessage* before() const { return before_; }

private:
    std::function<void()> speak_;
    const InterruptMessage* before_ = nullptr;
};

// No InterruptMessage is called during this object's lifetime, so that it never sees half a change.
// The thread must neither wait for a device nor check for interrupts meanwhile. May nest.
class HeldMessages {
public:
    HeldMessages();
    ~HeldMessages();
    HeldMessages(const HeldMessages&) = delete;
    HeldMessages& operator=(const HeldMessages&) = delete;
};

// Ends the program with kInterruptedStatus, or with another status if an InterruptMessage throws.
// First calls the InterruptMessages (or prints a line on stderr if there are none) and removes
// Leftover files. No object is destroyed.
[[noreturn]] void endInterrupted();

// Calls endInterrupted() if an interrupt was seen at least 0.7 s ago.
void endIfLongInterrupted();

// Waits for a device. `wait` gets the longest time to wait (ns) and returns whether all work is
// done.
template <class Wait>
void waitInterruptibly(Wait&& wait) {
    constexpr std::uint64_t kSlice = 50'000'000;
    while (!wait(kSlice)) endIfLongInterrupted();
}

// A file or folder to remove if an interrupt ends the program during this object's lifetime.
class Leftover {
public:
    explicit Leftover(std::filesystem::path path);
    ~Leftover();
    Leftover(const Leftover&) = delete;
    Leftover& operator=(const Leftover&) = delete;

private:
    std::filesystem::path path_;
};

// ---- Progress, for observers --------------------------------------------------------------------

// A step that may be long, under way during this object's lifetime. Steps of one thread nest.
class Step {
public:
    // `name`: the work, such as "grows strands". `parts`: how many parts it has. The text is then
    // "grows strands, 31000 of 100000", or for 0 parts the name alone.
    explicit Step(std::string name, std::uint64_t parts = 0);
    // `words` returns the text; any thread may call it.
    explicit Step(std::function<std::string()> words);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

    // Adds to the parts done. Throws Interrupted after an interrupt: a step can
    // be ended where it reports progress. Thread-safe.
    void advance(std::uint64_t parts = 1);

    std::string text() const;
    std::chrono::steady_clock::time_point start() const { return start_; }

private:
    std::string name_;
    std::uint64_t parts_ = 0;
    std::atomic<std::uint64_t> done_ = 0;
    std::function<std::string()> words_;
    std::chrono::steady_clock::time_point start_;
};

struct StepsUnderWay {
    std::string text;  // of all steps, outermost first
    std::chrono::steady_clock::time_point start;  // of the outermost; meaningless without text
};
StepsUnderWay stepsUnderWay();

// From now on no step is reported: the program is ending.
void forgetSteps();

// Sets a function that is called once no step is under way, by the thread that ended the last step;
// empty: none. Set it only while no step is under way.
void onceStepsEnd(std::function<void()> ended);

// ---- Scratch folders and CPU use
// -----------------------------------------------------------------

// A folder for temporary files, removed in any case.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::optional<Leftover> leftover_;
};

// CPU time of the calling thread since some moment in the past, ms.
double threadTime();

// CPU use of all threads of this process. On a software device this is the cost of passes, whatever
// else runs on the machine.
struct ProcessUse {
    double cpu = 0.0;  // ms
    // Instructions retired in user mode; absent if no counter is available.
    std::optional<double> instructions;
};

ProcessUse operator-(const ProcessUse& to, const ProcessUse& from);
ProcessUse operator+(const ProcessUse& a, const ProcessUse& b);

// Returns the use since some moment in the past: only differences are meaningful. Instructions are
// those of the first calling thread and of threads started later under it. Call it before the
// device is made, because that starts threads.
ProcessUse processUse();

// Lowers the priority of the calling thread and of threads that it starts from now on. They slow
// down only if other work on this machine needs the same processors.
void lowerPriority();

}  // namespace engine
