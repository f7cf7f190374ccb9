#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

// This process: interrupts, scratch folders, and what it uses of the CPU.
namespace engine {

// ---- Interrupts ---------------------------------------------------------------------------------

// From here on Ctrl-C, termination and a closed terminal are remembered instead of ending the
// program, which is to heed them within two seconds; a second one ends it at once. A limit on the
// size of files becomes an error of who writes.
//
// Heeded they are in one of three ways, each with the status kInterruptedStatus:
// - who works asks interrupted() or calls checkInterrupted(), and ends what it does;
// - who waits for a device (waitHeeding()) that isn't done 0.7 s after the interrupt ends
//   the program where it stands, by endInterrupted(): a driver's work can't be called off;
// - where nobody asks for 1.2 s (kPatience), as within a library, a thread ends the program,
//   without LastWords.
void catchInterrupts();

// Whether an interrupt came since catchInterrupts(). Who hears so ends its work: nobody else does.
bool interrupted();

// Thrown to end work that is interrupted.
class Interrupted {};

// Throws Interrupted where an interrupt came, TimedOut where a TimeLimit is over.
void checkInterrupted();

// Thrown to end work whose time is over.
struct TimedOut {
    std::string reason;  // "not done after 60 s (/run/case_timeout)"
};

// How long what is begun while this is there may go on. There is one at a time. Work that is never
// asked whether it was interrupted does not hear of it.
class TimeLimit {
public:
    // `seconds`: 0 is no limit. `name`: who set it.
    TimeLimit(double seconds, const std::string& name);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;
};

inline constexpr int kInterruptedStatus = 130;  // as shells have it: 128 + SIGINT

// What a program that ends where it stands says and writes first, for as long as this is there; of
// several the last one made begins. It is called by the thread that waits for the device, and must
// not wait for one itself.
class LastWords {
public:
    explicit LastWords(std::function<void()> speak);
    ~LastWords();
    LastWords(const LastWords&) = delete;
    LastWords& operator=(const LastWords&) = delete;

    void speak() const { speak_(); }
    const LastWords* before() const { return before_; }

private:
    std::function<void()> speak_;
    const LastWords* before_ = nullptr;
};

// Ends the program with kInterruptedStatus, or another where LastWords throw: after these (a line
// on stderr where there are none) files that nobody keeps are removed, and no object is destroyed.
[[noreturn]] void endInterrupted();

// Ends the program by endInterrupted() where an interrupt was there 0.7 s ago already.
void endIfLongInterrupted();

// Waits for a device: `wait` is given the ns that it may take, and says whether all is done.
template <class Wait>
void waitHeeding(Wait&& wait) {
    constexpr std::uint64_t kSlice = 50'000'000;
    while (!wait(kSlice)) endIfLongInterrupted();
}

// A file or folder that is removed where the program ends by an interrupt while this is there.
class Leftover {
public:
    explicit Leftover(std::filesystem::path path);
    ~Leftover();
    Leftover(const Leftover&) = delete;
    Leftover& operator=(const Leftover&) = delete;

private:
    std::filesystem::path path_;
};

// ---- Scratch folders and counters ---------------------------------------------------------------

// A folder for files that nobody keeps; gone in any case.
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

// A counter of the kernel (perf_event_open(2) with `inherit`) for what the thread that makes it,
// and every thread that starts under that one from then on, does in user mode. Threads that run
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

// CPU time of the calling thread since some moment in the past, ms.
double threadTime();

// What all threads of this process have used of the CPU: on a software device, what passes cost
// whoever else is at work on the machine.
struct ProcessUse {
    double cpu = 0.0;  // ms
    // Retired in user mode; absent where no counter is to be had.
    std::optional<double> instructions;
};

ProcessUse operator-(const ProcessUse& to, const ProcessUse& from);
ProcessUse operator+(const ProcessUse& a, const ProcessUse& b);

// What was used since some moment in the past: differences count. Instructions are those of the
// thread that calls first and of every thread that starts after that, under it: call it before the
// device is made, which starts threads.
ProcessUse processUse();

// The calling thread, and those that it starts from now on, give way where others of this machine
// want the same processors; where none do, they are as fast as before.
void giveWay();

}  // namespace engine
