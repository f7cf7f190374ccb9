#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

// This process: interrupts, scratch folders, and what it uses of the CPU.
namespace engine {

// From here on Ctrl-C, termination and a closed terminal are remembered instead of ending the
// program; a second one ends it. A limit on the size of files becomes an error of who writes.
void catchInterrupts();

// Whether an interrupt came since catchInterrupts().
bool interrupted();

// Thrown to end work that is interrupted.
class Interrupted {};

// Throws Interrupted where an interrupt came.
void checkInterrupted();

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
