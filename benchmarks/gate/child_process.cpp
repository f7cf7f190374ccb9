#include "benchmarks/gate/child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <optional>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/interrupt.h"

extern "C" char** environ;

namespace benchmarks {

namespace {

using Clock = std::chrono::steady_clock;

// How long to look away while a child runs: looking costs microseconds, which is nothing beside
// what a long one measures, and short ones are not waited for longer than they take.
constexpr std::chrono::milliseconds kShortestLook{1};
constexpr std::chrono::milliseconds kLongestLook{20};
constexpr std::chrono::seconds kGrace{5};
constexpr int kNotFound = 127;

// A child that is gone in any case.
class Child {
public:
    Child(const std::vector<std::string>& command, const std::filesystem::path& output) {
        std::vector<char*> arguments;
        for (const std::string& each : command)
            arguments.push_back(const_cast<char*>(each.c_str()));  // posix_spawn's interface
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(
            &actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        error_ =
            posix_spawnp(&id_, arguments.front(), &actions, &attributes, arguments.data(), environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        if (error_ != 0) id_ = 0;
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        if (id_ <= 0) return;
        signal(SIGKILL);
        waitpid(id_, nullptr, 0);
    }

    int error() const { return error_; }

    void signal(int number) const { kill(-id_, number); }

    // How it ended, once it has.
    std::optional<ChildEnd> end() {
        int status = 0;
        const pid_t ended = waitpid(id_, &status, WNOHANG);
        if (ended == 0 || (ended < 0 && errno == EINTR)) return {};
        id_ = 0;
        if (ended < 0) throw std::system_error(errno, std::generic_category(), "waitpid");
        if (WIFSIGNALED(status)) return ChildEnd{128 + WTERMSIG(status), true};
        return ChildEnd{WEXITSTATUS(status), false};
    }

private:
    pid_t id_ = 0;
    int error_ = 0;
};

}  // namespace

ChildEnd runChild(const std::vector<std::string>& command, const std::filesystem::path& output) {
    Child child(command, output);
    if (child.error() == ENOENT || child.error() == EACCES || child.error() == ENOEXEC)
        return {.status = kNotFound};
    if (child.error() != 0)
        throw std::system_error(child.error(), std::generic_category(), command.front());
    std::optional<Clock::time_point> asked_to_end;
    Clock::duration look = kShortestLook;
    for (;;) {
        const std::optional<ChildEnd> end = child.end();
        if (asked_to_end && (end || Clock::now() > *asked_to_end + kGrace)) throw Interrupted();
        if (end) return *end;
        if (interrupted() && !asked_to_end) {
            child.signal(SIGINT);
            asked_to_end = Clock::now();
        }
        std::this_thread::sleep_for(look);
        look = std::min<Clock::duration>(look * 5 / 4, kLongestLook);
    }
}

}  // namespace benchmarks
