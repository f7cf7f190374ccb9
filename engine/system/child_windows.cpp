#include "engine/system/child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cwchar>
#include <iterator>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <windows.h>

#include <psapi.h>

#include "engine/error.h"

namespace engine::system {
namespace {

[[noreturn]] void fail(const std::string& what, DWORD error) {
    const bool is_missing = error == ERROR_FILE_NOT_FOUND || error == ERROR_PATH_NOT_FOUND ||
                            error == ERROR_INVALID_NAME || error == ERROR_DIRECTORY;
    const bool is_no_program = error == ERROR_BAD_EXE_FORMAT || error == ERROR_ACCESS_DENIED;
    throw std::system_error(
        is_missing      ? ENOENT
        : is_no_program ? EACCES
                        : EIO,
        std::generic_category(), what);
}

class Handle {
public:
    explicit Handle(HANDLE handle = nullptr) : handle_(handle) {}
    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Handle& operator=(Handle&&) = delete;
    ~Handle() { close(); }

    bool isOpen() const { return handle_ && handle_ != INVALID_HANDLE_VALUE; }
    HANDLE get() const { return handle_; }
    void close() {
        if (isOpen()) CloseHandle(handle_);
        handle_ = nullptr;
    }

private:
    HANDLE handle_;
};

// ---- Command line and environment ---------------------------------------------------------------

std::wstring wide(const std::string& text) { return std::filesystem::path(text).wstring(); }

// Quotes an argument as CommandLineToArgvW() and the C library read it: backslashes are doubled
// before a quote.
void appendQuoted(std::wstring& line, const std::wstring& argument) {
    if (!line.empty()) line += L' ';
    if (!argument.empty() && argument.find_first_of(L" \t\n\v\"") == std::wstring::npos) {
        line += argument;
        return;
    }
    line += L'"';
    std::size_t slashes = 0;
    for (const wchar_t each : argument) {
        if (each == L'"') line.append(slashes + 1, L'\\');
        slashes = each == L'\\' ? slashes + 1 : 0;
        line += each;
    }
    line.append(slashes, L'\\');
    line += L'"';
}

// The environment variables that a program with limits on reading gets: those without which
// Windows' libraries and Python don't start.
constexpr std::wstring_view kToolVariables[] = {
    L"APPDATA",
    L"COMSPEC",
    L"HOMEDRIVE",
    L"HOMEPATH",
    L"LANG",
    L"LOCALAPPDATA",
    L"NUMBER_OF_PROCESSORS",
    L"PATH",
    L"PATHEXT",
    L"SYSTEMDRIVE",
    L"SYSTEMROOT",
    L"TEMP",
    L"TMP",
    L"USERPROFILE",
    L"WINDIR",
};

// Returns the block that CreateProcessW() takes. Each of `names` gets the value `folder`.
std::wstring environmentFor(
    const ChildLimits& limits, const std::vector<std::wstring_view>& names,
    const std::wstring& folder) {
    const auto is_in = [](std::wstring_view name, const auto& list) {
        return std::ranges::any_of(list, [&](std::wstring_view each) {
            return each.size() == name.size() &&
                   _wcsnicmp(each.data(), name.data(), name.size()) == 0;
        });
    };
    std::wstring block;
    wchar_t* const all = GetEnvironmentStringsW();
    for (const wchar_t* each = all; each && *each; each += std::wcslen(each) + 1) {
        const std::wstring_view variable = each;
        const std::wstring_view name = variable.substr(0, variable.find(L'=', 1));
        if (is_in(name, names) || (limits.reads && !is_in(name, kToolVariables))) continue;
        block.append(variable) += L'\0';
    }
    if (all) FreeEnvironmentStringsW(all);
    for (const std::wstring_view name : names)
        block.append(name).append(L"=").append(folder) += L'\0';
    block += L'\0';
    return block;
}

// ---- A child ------------------------------------------------------------------------------------

struct Pipe {
    Pipe() {
        constexpr DWORD kBytes = 1 << 20;
        SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
        HANDLE from = nullptr, to = nullptr;
        if (!CreatePipe(&from, &to, &inherited, kBytes)) fail("pipe", GetLastError());
        SetHandleInformation(from, HANDLE_FLAG_INHERIT, 0);
        read.emplace(from);
        write.emplace(to);
    }

    std::optional<Handle> read;
    std::optional<Handle> write;
};

std::uint64_t number(const FILETIME& time) {
    return std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime;
}

double cpuSeconds(HANDLE process) {
    FILETIME created{}, ended{}, kernel{}, user{};
    if (!GetProcessTimes(process, &created, &ended, &kernel, &user)) return 0.0;
    return static_cast<double>(number(kernel) + number(user)) * 1e-7;
}

// Memory that the process asked for, bytes.
std::size_t committed(HANDLE process) {
    PROCESS_MEMORY_COUNTERS counters{};
    counters.cb = sizeof counters;
    return GetProcessMemoryInfo(process, &counters, sizeof counters) ? counters.PagefileUsage : 0;
}

// Returns a job whose processes end with it and have these limits.
Handle jobFor(const ChildLimits& limits) {
    Handle job(CreateJobObjectW(nullptr, nullptr));
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION information{};
    DWORD& flags = information.BasicLimitInformation.LimitFlags;
    flags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE | JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
    if (limits.bytes > 0) {
        flags |= JOB_OBJECT_LIMIT_PROCESS_MEMORY;
        information.ProcessMemoryLimit = limits.bytes;
    }
    if (limits.reads) {  // it starts no other process
        flags |= JOB_OBJECT_LIMIT_ACTIVE_PROCESS;
        information.BasicLimitInformation.ActiveProcessLimit = 1;
    }
    if (!SetInformationJobObject(
            job.get(), JobObjectExtendedLimitInformation, &information, sizeof information))
        fail("limits of a child", ERROR_GEN_FAILURE);
    return job;
}

// A child process that is ended in any case, with those that it started.
class Child {
public:
    Child(
        const std::vector<std::string>& arguments, const ChildLimits& limits, HANDLE output,
        HANDLE errors, const std::wstring& environment)
        : limits_(limits), job_(jobFor(limits)) {
        std::wstring line;
        for (const std::string& argument : arguments)
            appendQuoted(
                line, line.empty() ? std::filesystem::path(argument).make_preferred().wstring()
                                   : wide(argument));
        SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
        const Handle nothing(CreateFileW(
            L"NUL", GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherited, OPEN_EXISTING, 0,
            nullptr));

        // Other handles are not inherited.
        std::vector<HANDLE> handles{nothing.get(), output};
        if (errors != output) handles.push_back(errors);
        SIZE_T size = 0;
        InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
        std::vector<std::byte> memory(size);
        STARTUPINFOEXW start{};
        start.lpAttributeList = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory.data());
        InitializeProcThreadAttributeList(start.lpAttributeList, 1, 0, &size);
        UpdateProcThreadAttribute(
            start.lpAttributeList, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handles.data(),
            handles.size() * sizeof(HANDLE), nullptr, nullptr);
        start.StartupInfo.cb = sizeof start;
        start.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
        start.StartupInfo.hStdInput = nothing.get();
        start.StartupInfo.hStdOutput = output;
        start.StartupInfo.hStdError = errors;
        PROCESS_INFORMATION made{};
        const BOOL is_made = CreateProcessW(
            nullptr, line.data(), nullptr, nullptr, TRUE,
            CREATE_SUSPENDED | CREATE_NEW_PROCESS_GROUP | CREATE_UNICODE_ENVIRONMENT |
                EXTENDED_STARTUPINFO_PRESENT,
            const_cast<wchar_t*>(environment.data()), nullptr, &start.StartupInfo, &made);
        const DWORD error = GetLastError();
        DeleteProcThreadAttributeList(start.lpAttributeList);
        if (!is_made) fail(arguments.front(), error);
        process_.emplace(made.hProcess);
        id_ = made.dwProcessId;
        const Handle thread(made.hThread);
        if (!AssignProcessToJobObject(job_.get(), made.hProcess)) {
            TerminateProcess(made.hProcess, 1);  // it has not begun
            fail("limits of a child", ERROR_GEN_FAILURE);
        }
        ResumeThread(thread.get());
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        TerminateJobObject(job_.get(), 1);
        WaitForSingleObject(process_->get(), INFINITE);
    }

    void interrupt() const { GenerateConsoleCtrlEvent(CTRL_BREAK_EVENT, id_); }

    // Ends the child if it exceeds a limit. The job does that only for memory.
    void checkLimits() {
        if (limits_.seconds > 0 && cpuSeconds(process_->get()) > limits_.seconds)
            end_.out_of_time = true;
        if (limits_.bytes > 0 && committed(process_->get()) > limits_.bytes)
            end_.out_of_memory = true;
        if (end_.out_of_time || end_.out_of_memory) TerminateJobObject(job_.get(), 1);
    }

    // Waits for this many milliseconds at most.
    std::optional<ChildEnd> end(DWORD wait) {
        if (WaitForSingleObject(process_->get(), wait) != WAIT_OBJECT_0) return std::nullopt;
        DWORD status = 0;
        GetExitCodeProcess(process_->get(), &status);
        end_.status = static_cast<int>(status);
        return end_;
    }

private:
    ChildLimits limits_;
    Handle job_;
    std::optional<Handle> process_;
    DWORD id_ = 0;
    ChildEnd end_;
};

// Reads what a pipe has. Returns false once the child has closed it.
bool readSome(HANDLE pipe, std::vector<char>& part, std::span<const char>& read) {
    DWORD there = 0, size = 0;
    read = {};
    if (!PeekNamedPipe(pipe, nullptr, 0, nullptr, &there, nullptr)) return false;
    if (there == 0) return true;
    const auto most = static_cast<DWORD>(part.size());
    if (!ReadFile(pipe, part.data(), std::min(there, most), &size, nullptr)) return false;
    read = std::span(part).first(size);
    return true;
}

constexpr std::size_t kKeptErrors = std::size_t{1} << 16;  // bytes kept of a child's last errors

}  // namespace

// ---- What this unit offers ----------------------------------------------------------------------

ChildEnd runChild(
    const std::vector<std::string>& arguments, const ChildLimits& limits, const Take& take,
    const Poll& poll, std::string& errors) {
    constexpr DWORD kPause = 1;  // ms; Windows makes it up to 16
    Pipe output;
    Pipe error_output;
    Child child(
        arguments, limits, output.write->get(), error_output.write->get(),
        environmentFor(limits, {}, {}));
    output.write.reset();
    error_output.write.reset();
    std::vector<char> part(std::size_t{1} << 20);
    bool more_output = true, more_errors = true;
    while (more_output || more_errors) {
        std::span<const char> read;
        bool any = false;
        if (more_output) {
            more_output = readSome(output.read->get(), part, read);
            any = any || !read.empty();
            if (!read.empty()) take(read);
        }
        if (more_errors) {
            more_errors = readSome(error_output.read->get(), part, read);
            any = any || !read.empty();
            errors.append(read.begin(), read.end());
            if (errors.size() > 2 * kKeptErrors) errors.erase(0, errors.size() - kKeptErrors);
        }
        child.checkLimits();
        if (poll) poll();
        if (!any) Sleep(kPause);
    }
    for (;;) {
        if (const auto end = child.end(kPause)) return *end;
        child.checkLimits();
        if (poll) poll();
    }
}

ChildEnd runFork(
    const std::function<std::string()>& work, const ChildLimits&, const Take& take,
    const Poll& poll) {
    if (poll) poll();
    try {
        const std::string bytes = work();
        take(bytes);
    } catch (const std::bad_alloc&) {
        return {.status = 1, .out_of_memory = true};
    }
    if (poll) poll();
    return {};
}

void limitSelf(const ChildLimits& limits, const char* out_of_time) {
    const double most_seconds = limits.seconds;
    const std::size_t most_bytes = committed(GetCurrentProcess()) + limits.bytes;
    std::thread([=] {
        constexpr DWORD kPause = 100;  // ms
        const HANDLE self = GetCurrentProcess();
        for (;; Sleep(kPause)) {
            const bool is_late = most_seconds > 0.0 && cpuSeconds(self) > most_seconds;
            const bool is_large = limits.bytes > 0 && committed(self) > most_bytes;
            if (!is_late && !is_large) continue;
            const std::string text =
                is_late
                    ? std::string(out_of_time)
                    : "needed more than " + std::to_string(limits.bytes >> 20) + " MiB of memory\n";
            DWORD written = 0;
            WriteFile(
                GetStdHandle(STD_ERROR_HANDLE), text.data(), static_cast<DWORD>(text.size()),
                &written, nullptr);
            TerminateProcess(self, 1);
        }
    }).detach();
}

struct Program::Parts {
    std::unique_ptr<Child> child;  // null: it could not be started
};

Program::Program(
    const std::vector<std::string>& command, const std::filesystem::path& output,
    const std::filesystem::path& temporary)
    : parts_(std::make_unique<Parts>()) {
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    const Handle file(CreateFileW(
        output.c_str(), FILE_APPEND_DATA, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
        &inherited, CREATE_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr));
    if (!file.isOpen()) fail(output.string(), GetLastError());
    try {
        parts_->child = std::make_unique<Child>(
            command, ChildLimits{}, file.get(), file.get(),
            environmentFor({}, {L"TMP", L"TEMP"}, temporary.wstring()));
    } catch (const std::system_error& error) {
        const int code = error.code().value();
        if (code != ENOENT && code != EACCES) throw;
    }
}

Program::~Program() = default;

std::optional<ChildEnd> Program::end() {
    constexpr int kNotFound = 127;  // as shells have it
    if (!parts_->child) return ChildEnd{.status = kNotFound};
    return parts_->child->end(0);
}

void Program::interrupt() {
    if (parts_->child) parts_->child->interrupt();
}

std::vector<std::string> shellCommand(const std::string&) {
    throw Error("Windows", "a command with arguments is not run here: name a program or a folder");
}

}  // namespace engine::system
