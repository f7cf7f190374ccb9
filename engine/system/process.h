#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

// This process, as the system runs it: its interrupts, its use of the processors, its terminal.
namespace engine::system {

// ---- Start and end ------------------------------------------------------------------------------

// Makes the standard streams usable. A missing one is opened: otherwise the next opened file, a
// report or a device, would take the number of a closed stream. Writing to a closed standard output
// then fails, as on a full disk. On Windows it also sets the console's output to UTF-8 and the
// streams to bytes, so that a line ends as on other systems.
void prepareStreams();

// From here on, an interrupt, a request to end and a closed terminal call `came` instead of ending
// the program, and then `watch` on a thread of its own. `came` may run in a signal handler. A
// second interrupt ends the program at once. Exceeding the limit on file size becomes an error of
// the writer. May be called again with the same functions.
void watchInterrupts(void (*came)(), void (*watch)());

// Ends the process, without any more of its code.
[[noreturn]] void endNow(int status);

// ---- The terminal -------------------------------------------------------------------------------

// Whether stderr is a terminal.
bool hasTerminal();

// Columns of the terminal at stderr; 0: unknown.
std::size_t terminalWidth();

// ---- Use of the processors ----------------------------------------------------------------------

// CPU time since some moment in the past, ms.
double threadTime();  // of the calling thread
double processTime();  // of all threads of this process

// Lowers the priority of the calling thread, and on Linux of threads that it starts from now on.
void lowerPriority();

// An event that the kernel counts: PERF_TYPE_* and PERF_COUNT_* of Linux's perf_event.h.
struct Event {
    std::uint32_t type;
    std::uint64_t config;
};
inline constexpr Event kInstructions{0, 1};  // retired

// A kernel counter (Linux: perf_event_open(2) with `inherit`) of user-mode events in the thread
// that makes it and in all threads later started under it. Threads that already run are not
// counted.
class PerfCounter {
public:
    // If the kernel, the container or the machine offers no counter, read() is empty; this is no
    // error. Windows offers none.
    explicit PerfCounter(Event event);
    ~PerfCounter();
    PerfCounter(const PerfCounter&) = delete;
    PerfCounter& operator=(const PerfCounter&) = delete;

    // Returns the events so far, of running and ended threads. Also empty if the counter shared the
    // processor's counters with others, so that the kernel missed some events.
    std::optional<double> read() const;

private:
    int file_;  // -1: none
};

// ---- Limits -------------------------------------------------------------------------------------

// Returns the limit on the size of files that this process writes, in bytes; absent if there is
// none.
std::optional<std::uint64_t> largestFile();

}  // namespace engine::system
