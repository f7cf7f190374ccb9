#include "engine/system/child.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" char** environ;

namespace engine::system {
namespace {

[[noreturn]] void failWith(int error, const char* what) {
    throw std::system_error(error, std::generic_category(), what);
}

class File {
public:
    explicit File(int descriptor) : descriptor_(descriptor) {}
    File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    File& operator=(File&&) = delete;
    ~File() { close(); }

    int get() const { return descriptor_; }
    void close() {
        if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
    }

private:
    int descriptor_;
};

struct Pipe {
    Pipe() : Pipe(open()) {}

    File read;
    File write;

private:
    explicit Pipe(const std::array<int, 2>& ends) : read(ends[0]), write(ends[1]) {}

    // Other children don't inherit the pipe.
    static std::array<int, 2> open() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) failWith(errno, "pipe");
        return ends;
    }
};

// ---- What a child may open ----------------------------------------------------------------------

constexpr std::uint64_t kRead =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;

// Returns the rights that the kernel's Landlock knows for reading and changing files and folders,
// or 0 without Landlock.
std::uint64_t accessKnown() {
    const long version = syscall(
        SYS_landlock_create_ruleset, nullptr, std::size_t{0}, LANDLOCK_CREATE_RULESET_VERSION);
    std::uint64_t all = version < 1 ? 0 : (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
#ifdef LANDLOCK_ACCESS_FS_TRUNCATE
    if (version >= 3) all |= LANDLOCK_ACCESS_FS_TRUNCATE;
#endif
    return all;
}

// The system's libraries and the files that they read.
constexpr const char* kSystemFiles[] = {
    "/usr",
    "/lib",
    "/lib32",
    "/lib64",
    "/bin",
    "/sbin",
    "/opt",
    "/nix/store",
    "/etc/ld.so.cache",
    "/etc/ld.so.preload",
    "/etc/localtime",
    "/etc/locale.alias",
    "/proc",
    "/sys/devices/system",
    "/sys/fs/cgroup",
    "/dev/urandom",
    "/dev/zero"};

void allow(const File& rules, const std::filesystem::path& path, std::uint64_t access) {
    const File file(open(path.c_str(), O_PATH | O_CLOEXEC));
    if (file.get() < 0) return;
    std::error_code error;
    if (!std::filesystem::is_directory(path, error))
        access &= ~std::uint64_t{LANDLOCK_ACCESS_FS_READ_DIR};
    const landlock_path_beneath_attr rule{.allowed_access = access, .parent_fd = file.get()};
    syscall(SYS_landlock_add_rule, rules.get(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
}

// Returns Landlock's rules for a child with these limits, or a closed file without Landlock or
// limits on reading.
File rulesFor(const ChildLimits& limits) {
    const std::uint64_t known = limits.reads ? accessKnown() : 0;
    if (known == 0) return File(-1);
    landlock_ruleset_attr handled{};
    handled.handled_access_fs = known;
    File rules(static_cast<int>(
        syscall(SYS_landlock_create_ruleset, &handled, sizeof handled.handled_access_fs, 0)));
    if (rules.get() < 0) return rules;
    for (const char* path : kSystemFiles) allow(rules, path, kRead);
    for (const std::filesystem::path& path : *limits.reads) allow(rules, path, kRead);
    allow(rules, "/dev/null", LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_WRITE_FILE);
    return rules;
}

// ---- System calls of a child --------------------------------------------------------------------

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HAIRBENCH_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HAIRBENCH_SANITIZED 1
#endif
#endif

// Calls that a reader of files has no use for: those to the network, to other processes, and to
// parts of the kernel that have nothing to do with files.
constexpr int kRefusedCalls[] = {
    SCMP_SYS(socket),
    SCMP_SYS(socketpair),
    SCMP_SYS(process_vm_readv),
    SCMP_SYS(process_vm_writev),
    SCMP_SYS(pidfd_open),
    SCMP_SYS(pidfd_getfd),
    SCMP_SYS(pidfd_send_signal),
    SCMP_SYS(unshare),
    SCMP_SYS(setns),
    SCMP_SYS(mount),
    SCMP_SYS(umount2),
    SCMP_SYS(open_by_handle_at),
    SCMP_SYS(bpf),
    SCMP_SYS(perf_event_open),
    SCMP_SYS(userfaultfd),
    SCMP_SYS(io_uring_setup),
    SCMP_SYS(keyctl),
    SCMP_SYS(add_key),
    SCMP_SYS(request_key),
    SCMP_SYS(shmget),
    SCMP_SYS(msgget),
    SCMP_SYS(semget),
    SCMP_SYS(mq_open),
};
// Calls that a fork of this process doesn't need either, because it only computes.
constexpr int kRefusedToForks[] = {
    SCMP_SYS(execve), SCMP_SYS(execveat), SCMP_SYS(open),      SCMP_SYS(creat),
    SCMP_SYS(openat), SCMP_SYS(openat2),  SCMP_SYS(unlink),    SCMP_SYS(unlinkat),
    SCMP_SYS(rename), SCMP_SYS(renameat), SCMP_SYS(renameat2),
};

enum class Runs { program, fork };

// Returns a filter that refuses these calls, for setFilter(); none if libseccomp can't make one.
std::vector<sock_filter> filterFor(Runs runs) {
    const std::unique_ptr<void, decltype(&seccomp_release)> context(
        seccomp_init(SCMP_ACT_ALLOW), seccomp_release);
    if (!context) return {};
    const auto refuse = [&](int call, int error) {
        // Fails for calls that this processor does not have.
        seccomp_rule_add(context.get(), SCMP_ACT_ERRNO(static_cast<std::uint32_t>(error)), call, 0);
    };
    for (const int call : kRefusedCalls) refuse(call, EPERM);
    if (runs == Runs::fork)
        for (const int call : kRefusedToForks) refuse(call, EPERM);
#ifndef HAIRBENCH_SANITIZED
    // The leak sanitizer traces this process from a process of its own.
    refuse(SCMP_SYS(ptrace), EPERM);
    refuse(SCMP_SYS(fork), EPERM);
    refuse(SCMP_SYS(vfork), EPERM);
    refuse(SCMP_SYS(clone3), ENOSYS);  // its flags are in memory; glibc then calls clone()
    seccomp_rule_add(
        context.get(), SCMP_ACT_ERRNO(EPERM), SCMP_SYS(clone), 1,
        SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0));
#endif
    const File exported(memfd_create("filter", MFD_CLOEXEC));
    if (exported.get() < 0 || seccomp_export_bpf(context.get(), exported.get()) != 0) return {};
    const off_t size = lseek(exported.get(), 0, SEEK_END);
    std::vector<sock_filter> filter(static_cast<std::size_t>(size) / sizeof(sock_filter));
    const std::size_t bytes = filter.size() * sizeof(sock_filter);
    if (pread(exported.get(), filter.data(), bytes, 0) != static_cast<ssize_t>(bytes)) return {};
    return filter;
}

// Sets a filter for this process from now on, where the kernel has filters. Async-signal-safe.
void setFilter(std::span<sock_filter> filter) {
    if (filter.empty() || prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    const sock_fprog program{
        .len = static_cast<unsigned short>(filter.size()), .filter = filter.data()};
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
}

// ---- Limits of a child --------------------------------------------------------------------------

// The environment variables that a program with limits on reading gets.
constexpr std::string_view kToolVariables[] = {
    "ASAN_OPTIONS", "HOME", "LANG",   "LC_ALL",       "LC_CTYPE",      "LD_LIBRARY_PATH",
    "LSAN_OPTIONS", "PATH", "TMPDIR", "TSAN_OPTIONS", "UBSAN_OPTIONS",
};

// `variable`, like "TMPDIR=/tmp", replaces this process's if it is not empty.
std::vector<char*> environmentFor(const ChildLimits& limits, const std::string& variable) {
    const auto nameOf = [](std::string_view each) { return each.substr(0, each.find('=')); };
    std::vector<char*> all;
    for (char** each = environ; *each; ++each) {
        const std::string_view name = nameOf(*each);
        if (!variable.empty() && name == nameOf(variable)) continue;
        if (!limits.reads || std::ranges::find(kToolVariables, name) != std::end(kToolVariables))
            all.push_back(*each);
    }
    if (!variable.empty()) all.push_back(const_cast<char*>(variable.c_str()));
    all.push_back(nullptr);
    return all;
}

void limit(__rlimit_resource resource, rlim_t value) {
    rlimit limits{};
    if (getrlimit(resource, &limits) != 0) return;
    limits.rlim_cur = std::min(limits.rlim_max, value);
    setrlimit(resource, &limits);
}

// Limits a process that was just forked. `bytes` is the size of its address space.
void limitForked(const ChildLimits& limits, std::size_t bytes, pid_t parent) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    if (limits.seconds > 0) limit(RLIMIT_CPU, limits.seconds);
    if (limits.bytes > 0) limit(RLIMIT_AS, bytes);
    if (limits.seconds > 0 || limits.bytes > 0) limit(RLIMIT_CORE, 0);
    if (limits.reads) limit(RLIMIT_FSIZE, 0);
}

// ---- A child ------------------------------------------------------------------------------------

ChildEnd endOf(int status) {
    if (WIFSIGNALED(status))
        return {
            .status = WTERMSIG(status),
            .signaled = true,
            .out_of_time = WTERMSIG(status) == SIGXCPU};
    return {.status = WEXITSTATUS(status)};
}

// A child process that is ended in any case.
class Child {
public:
    Child(
        const std::vector<std::string>& arguments, const ChildLimits& limits, const File& output,
        const File& errors, const std::string& variable = {}) {
        std::vector<char*> pointers;
        for (const std::string& argument : arguments)
            pointers.push_back(const_cast<char*>(argument.c_str()));  // execve's interface
        pointers.push_back(nullptr);
        const std::vector<char*> environment = environmentFor(limits, variable);
        const File rules = rulesFor(limits);
        std::vector<sock_filter> filter;
        if (limits.reads) filter = filterFor(Runs::program);
        const File nothing(open("/dev/null", O_RDONLY | O_CLOEXEC));
        Pipe failure;
        const pid_t parent = getpid();
        id_ = fork();
        if (id_ < 0) failWith(errno, "fork");
        if (id_ == 0) {  // only async-signal-safe calls: other threads may hold locks
            limitForked(limits, limits.bytes, parent);
            int error = 0;
            if (dup2(nothing.get(), STDIN_FILENO) < 0 || dup2(output.get(), STDOUT_FILENO) < 0 ||
                dup2(errors.get(), STDERR_FILENO) < 0)
                error = errno;
            if (rules.get() >= 0 && (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
                                     syscall(SYS_landlock_restrict_self, rules.get(), 0) != 0))
                error = errno;
            setFilter(filter);
            if (error == 0) execvpe(pointers.front(), pointers.data(), environment.data());
            if (error == 0) error = errno;
            [[maybe_unused]] const ssize_t written =
                write(failure.write.get(), &error, sizeof error);
            _exit(127);
        }
        failure.write.close();
        int error = 0;
        ssize_t size = 0;
        while ((size = read(failure.read.get(), &error, sizeof error)) < 0 && errno == EINTR) {
        }
        if (size != sizeof error) return;
        wait();
        failWith(error, pointers.front());
    }
    explicit Child(pid_t id) : id_(id) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (id_ <= 0) return;
        kill(-id_, SIGKILL);
        kill(id_, SIGKILL);  // it may have no group yet
        wait();
    }

    void interrupt() const { kill(-id_, SIGINT); }

    std::optional<ChildEnd> end() {
        int status = 0;
        const pid_t ended = waitpid(id_, &status, WNOHANG);
        if (ended == 0 || (ended < 0 && errno == EINTR)) return {};
        id_ = 0;
        if (ended < 0) failWith(errno, "waitpid");
        return endOf(status);
    }

    // Calls `poll` while it waits.
    ChildEnd wait(const Poll& poll = {}) {
        constexpr std::chrono::milliseconds kLook{5};
        int status = 0;
        for (;;) {
            const pid_t ended = waitpid(id_, &status, poll ? WNOHANG : 0);
            if (ended == id_ || (ended < 0 && errno != EINTR)) break;
            if (!poll) continue;
            poll();
            std::this_thread::sleep_for(kLook);
        }
        id_ = 0;
        return endOf(status);
    }

private:
    pid_t id_ = 0;
};

constexpr int kPollInterval = 100;  // ms
constexpr std::size_t kKeptErrors = std::size_t{1} << 16;  // bytes kept of a child's last errors

// Reads stdout and stderr until the child has closed them.
void drain(File& output, const Take& take, File& errors, std::string& text, const Poll& idle) {
    std::vector<char> part(1 << 16);
    while (output.get() >= 0 || errors.get() >= 0) {
        std::array<pollfd, 2> ready{
            pollfd{output.get(), POLLIN, 0}, pollfd{errors.get(), POLLIN, 0}};
        const int count = poll(ready.data(), ready.size(), idle ? kPollInterval : -1);
        if (idle) idle();
        if (count <= 0) continue;
        for (std::size_t i = 0; i < ready.size(); ++i) {
            if (ready[i].revents == 0) continue;
            const ssize_t size = read(ready[i].fd, part.data(), part.size());
            if (size < 0 && errno == EINTR) continue;
            if (size <= 0) {
                (i == 0 ? output : errors).close();
            } else if (i == 0) {
                take(std::span(part).first(static_cast<std::size_t>(size)));
            } else {
                text.append(part.data(), static_cast<std::size_t>(size));
                if (text.size() > 2 * kKeptErrors) text.erase(0, text.size() - kKeptErrors);
            }
        }
    }
}

// ---- A fork of this process ---------------------------------------------------------------------

// Returns the bytes of this process's address space.
std::size_t addressSpace() {
    std::ifstream pages("/proc/self/statm");
    std::size_t count = 0;
    pages >> count;
    return count * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

constexpr int kOutOfMemory = 12;  // exit status of the fork: ENOMEM

[[noreturn]] void workAndEnd(
    const std::function<std::string()>& work, const ChildLimits& limits,
    std::span<sock_filter> filter, int output, pid_t parent) {
    limitForked(limits, addressSpace() + limits.bytes, parent);
    setFilter(filter);
    signal(SIGINT, SIG_IGN);  // the parent ends this child
    signal(SIGXCPU, SIG_DFL);
    std::string bytes;
    try {
        bytes = work();
    } catch (const std::bad_alloc&) {
        _exit(kOutOfMemory);
    } catch (...) {
        _exit(1);
    }
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = write(output, bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) _exit(1);
        done += static_cast<std::size_t>(count);
    }
    _exit(0);  // destroys no object of the parent
}

std::atomic<const char*> said_out_of_time = nullptr;  // for the handler

extern "C" void sayOutOfTime(int) {
    const char* const text = said_out_of_time;
    const auto written = write(STDERR_FILENO, text, std::strlen(text));
    _exit(written > 0 ? 1 : 2);
}

}  // namespace

// ---- What this unit offers ----------------------------------------------------------------------

ChildEnd runChild(
    const std::vector<std::string>& arguments, const ChildLimits& limits, const Take& take,
    const Poll& poll, std::string& errors) {
    Pipe output;
    Pipe error_output;
    Child child(arguments, limits, output.write, error_output.write);
    output.write.close();
    error_output.write.close();
    drain(output.read, take, error_output.read, errors, poll);
    return child.wait(poll);
}

ChildEnd runFork(
    const std::function<std::string()>& work, const ChildLimits& limits, const Take& take,
    const Poll& poll) {
    Pipe output;
    std::vector<sock_filter> filter = filterFor(Runs::fork);
    const pid_t parent = getpid();
    const pid_t id = fork();
    if (id < 0) failWith(errno, "fork");
    if (id == 0) workAndEnd(work, limits, filter, output.write.get(), parent);
    Child child(id);
    output.write.close();
    File no_errors(-1);
    std::string none;
    drain(output.read, take, no_errors, none, poll);
    ChildEnd end = child.wait(poll);
    end.out_of_memory = !end.signaled && end.status == kOutOfMemory;
    return end;
}

void limitSelf(const ChildLimits& limits, const char* out_of_time) {
    said_out_of_time = out_of_time;
    std::signal(SIGXCPU, sayOutOfTime);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
    limit(RLIMIT_AS, addressSpace() + limits.bytes);
}

struct Program::Parts {
    std::optional<Child> child;  // absent: it could not be started
};

Program::Program(
    const std::vector<std::string>& command, const std::filesystem::path& output,
    const std::filesystem::path& temporary)
    : parts_(std::make_unique<Parts>()) {
    const File file(
        open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0600));
    if (file.get() < 0) failWith(errno, output.c_str());
    try {
        parts_->child.emplace(command, ChildLimits{}, file, file, "TMPDIR=" + temporary.string());
    } catch (const std::system_error& error) {
        const int code = error.code().value();
        if (code != ENOENT && code != EACCES && code != ENOEXEC) throw;
    }
}

Program::~Program() = default;

std::optional<ChildEnd> Program::end() {
    constexpr int kNotFound = 127;
    if (!parts_->child) return ChildEnd{.status = kNotFound};
    return parts_->child->end();
}

void Program::interrupt() {
    if (parts_->child) parts_->child->interrupt();
}

std::vector<std::string> shellCommand(const std::string& line) { return {"/bin/sh", "-c", line}; }

}  // namespace engine::system
