#include "engine/system/process.h"

#include <atomic>
#include <semaphore>
#include <thread>

#include <fcntl.h>
#include <io.h>
#include <windows.h>

namespace engine::system {

// ---- Start and end ------------------------------------------------------------------------------

void prepareStreams() {
    // A crash ends the program instead of asking the user.
    SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
    SetConsoleOutputCP(CP_UTF8);
    for (const int stream : {0, 1, 2}) {
        if (_get_osfhandle(stream) < 0) continue;  // a program without a console may have none
        _setmode(stream, _O_BINARY);
        const HANDLE console = reinterpret_cast<HANDLE>(_get_osfhandle(stream));
        DWORD mode = 0;
        if (stream > 0 && GetConsoleMode(console, &mode))
            SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
}

namespace {

void (*interrupt_came)() = nullptr;
std::binary_semaphore interrupt_signal{0};
std::atomic<bool> interrupted_before = false;

// Windows calls it on a thread of its own. An event that it does not take ends the program.
BOOL WINAPI onEvent(DWORD event) {
    const bool is_typed = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
    if (!interrupted_before.exchange(true)) {
        interrupt_came();
        interrupt_signal.release();
    } else if (is_typed) {
        return FALSE;
    }
    // The window closes or the user logs off. The program ends once this returns, or after some
    // seconds.
    if (!is_typed) Sleep(INFINITE);
    return TRUE;
}

}  // namespace

void watchInterrupts(void (*came)(), void (*watch)()) {
    if (interrupt_came) return;
    interrupt_came = came;
    std::thread([watch] {
        interrupt_signal.acquire();
        watch();
    }).detach();
    SetConsoleCtrlHandler(onEvent, TRUE);
}

void endNow(int status) {
    // ExitProcess() would wait for libraries, and those may wait for threads that it has ended.
    TerminateProcess(GetCurrentProcess(), static_cast<UINT>(status));
    for (;;) Sleep(INFINITE);
}

// ---- The terminal -------------------------------------------------------------------------------

bool hasTerminal() {
    DWORD mode = 0;
    return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

std::size_t terminalWidth() {
    CONSOLE_SCREEN_BUFFER_INFO console{};
    if (!GetConsoleScreenBufferInfo(GetStdHandle(STD_ERROR_HANDLE), &console)) return 0;
    return static_cast<std::size_t>(console.srWindow.Right - console.srWindow.Left + 1);
}

// ---- Use of the processors ----------------------------------------------------------------------

namespace {

// Times are in units of 100 ns. Windows adds to them at each tick of its clock, of 15.6 ms.
double milliseconds(const FILETIME& kernel, const FILETIME& user) {
    const auto units = [](const FILETIME& time) {
        return static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime);
    };
    return (units(kernel) + units(user)) * 1e-4;
}

}  // namespace

double threadTime() {
    FILETIME created{}, ended{}, kernel{}, user{};
    GetThreadTimes(GetCurrentThread(), &created, &ended, &kernel, &user);
    return milliseconds(kernel, user);
}

double processTime() {
    FILETIME created{}, ended{}, kernel{}, user{};
    GetProcessTimes(GetCurrentProcess(), &created, &ended, &kernel, &user);
    return milliseconds(kernel, user);
}

void lowerPriority() { SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_BELOW_NORMAL); }

PerfCounter::PerfCounter(Event) : file_(-1) {}

PerfCounter::~PerfCounter() = default;

std::optional<double> PerfCounter::read() const { return std::nullopt; }

// ---- Limits -------------------------------------------------------------------------------------

std::optional<std::uint64_t> largestFile() { return std::nullopt; }

}  // namespace engine::system
