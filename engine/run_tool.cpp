#include "engine/run_tool.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>
#include <span>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/error.h"
#include "engine/process.h"

extern "C" char** environ;

namespace engine {
namespace {

[[noreturn]] void failWith(int error, const char* what) {
    throw std::system_error(error, std::generic_category(), what);
}

class File {
public:
    explicit File(int descriptor) : descriptor_(descriptor) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
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

// A child process that is ended in any case.
class Child {
public:
    Child(const std::vector<std::string>& arguments, const File& output, const File& errors) {
        std::vector<char*> pointers;
        for (const std::string& argument : arguments)
            pointers.push_back(const_cast<char*>(argument.c_str()));  // posix_spawn's interface
        pointers.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, output.get(), STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions, errors.get(), STDERR_FILENO);
        const int error =
            posix_spawnp(&id_, pointers.front(), &actions, nullptr, pointers.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0) failWith(error, pointers.front());
    }
    explicit Child(pid_t id) : id_(id) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (id_ <= 0) return;
        kill(id_, SIGKILL);
        wait();
    }

    // Returns the child's status as waitpid gives it.
    int wait() {
        int status = 0;
        while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
        }
        id_ = 0;
        return status;
    }

private:
    pid_t id_ = 0;
};

using Take = std::function<void(std::span<const char>)>;
using Poll = std::function<void()>;

constexpr int kPollInterval = 100;  // ms
constexpr std::size_t kKeptErrors = std::size_t{1} << 16;  // bytes kept of a child's last errors
constexpr std::size_t kLongestLine = 300;  // bytes

// Reads both until the child has closed them.
void drain(File& output, const Take& take, File& errors, std::string& text, const Poll& idle) {
    std::vector<char> part(1 << 16);
    while (output.get() >= 0 || errors.get() >= 0) {
        std::array<pollfd, 2> ready{
            pollfd{output.get(), POLLIN, 0}, pollfd{errors.get(), POLLIN, 0}};
        const int count = poll(ready.data(), ready.size(), idle ? kPollInterval : -1);
        if (count == 0 && idle) idle();
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

std::string lastLine(std::string_view text) {
    while (text.ends_with('\n')) text.remove_suffix(1);
    const std::string_view line = text.substr(text.rfind('\n') + 1);
    std::string shown(line.substr(0, kLongestLine));
    if (line.size() > kLongestLine) shown += " [...]";
    return shown;
}

std::string describe(int status) {
    if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
    return "ended with status " + std::to_string(WEXITSTATUS(status));
}

void run(const std::vector<std::string>& arguments, const Take& take, const Poll& idle = {}) {
    Pipe output;
    Pipe errors;
    Child child(arguments, output.write, errors.write);
    output.write.close();
    errors.write.close();
    std::string text;
    drain(output.read, take, errors.read, text, idle);
    const int status = child.wait();
    checkInterrupted();  // a terminal's interrupt also ends the child
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    const std::string line = WIFEXITED(status) ? lastLine(text) : "";
    throw Error(line.empty() ? arguments.front() + ' ' + describe(status) : line);
}

// ---- A fork of this process ---------------------------------------------------------------------

// Returns the bytes of this process's address space.
std::size_t addressSpace() {
    std::ifstream pages("/proc/self/statm");
    std::size_t count = 0;
    pages >> count;
    return count * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource resource, rlim_t value) {
    rlimit limits{};
    if (getrlimit(resource, &limits) != 0) return;
    limits.rlim_cur = std::min(limits.rlim_max, value);
    setrlimit(resource, &limits);
}

constexpr int kOutOfMemory = 12;  // exit status of the fork: ENOMEM

[[noreturn]] void
workAndEnd(const std::function<std::string()>& work, const ChildLimits& limits, int output) {
    signal(SIGINT, SIG_IGN);  // from a terminal: the parent ends this child
    signal(SIGXCPU, SIG_DFL);
    limitSelf(limits);
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
    _exit(0);  // nothing of the parent's is destroyed
}

std::string describe(int status, const ChildLimits& limits) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return "not done after " + std::to_string(limits.seconds) + " s of the processor";
    if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory)
        return "not done with " + std::to_string(limits.bytes >> 20) + " MiB of memory";
    return describe(status);
}

}  // namespace

void limitSelf(const ChildLimits& limits) {
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
    limit(RLIMIT_AS, addressSpace() + limits.bytes);
}

std::string runApart(const std::function<std::string()>& work, const ChildLimits& limits) {
    Pipe output;
    const pid_t id = fork();
    if (id < 0) failWith(errno, "fork");
    if (id == 0) workAndEnd(work, limits, output.write.get());
    Child child(id);
    output.write.close();
    std::string bytes, none;
    File no_errors(-1);
    drain(
        output.read, [&](std::span<const char> part) { bytes.append(part.data(), part.size()); },
        no_errors, none, checkInterrupted);
    const int status = child.wait();
    checkInterrupted();
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return bytes;
    throw Error(describe(status, limits));
}

std::vector<std::byte> runTool(const std::vector<std::string>& arguments, std::size_t most) {
    std::vector<std::byte> bytes;
    const Take take = [&](std::span<const char> part) {
        checkInterrupted();
        if (part.size() > most - bytes.size())
            throw Error(arguments.front() + " wrote more than " + std::to_string(most) + " bytes");
        const auto read = std::as_bytes(part);
        bytes.insert(bytes.end(), read.begin(), read.end());
    };
    run(arguments, take, checkInterrupted);
    return bytes;
}

void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll) {
    std::string rest;
    run(
        arguments,
        [&](std::span<const char> part) {
            rest.append(part.data(), part.size());
            std::size_t begin = 0;
            for (std::size_t end; (end = rest.find('\n', begin)) != std::string::npos;
                 begin = end + 1)
                each_line(std::string_view(rest).substr(begin, end - begin));
            rest.erase(0, begin);
        },
        poll);
    if (!rest.empty()) each_line(rest);
}

}  // namespace engine
