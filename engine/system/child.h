#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

// Child processes, as the system starts and limits them. engine/run_tool.h has the rules for how
// they end.
namespace engine::system {

// Limits on a child's resources. Children are in process groups of their own. They end when the
// thread that started them ends, even by a signal. On Windows they end with this process.
struct ChildLimits {
    // Limit of CPU time; 0: none. The limit of wall-clock time is ten times as long plus a minute.
    unsigned seconds = 0;
    // Limit of memory; 0: none. A fork of this process gets it in addition to this process's
    // memory.
    std::size_t bytes = 0;
    std::size_t output = std::numeric_limits<std::size_t>::max();  // bytes on stdout
    // The only files and folders that a program may read, apart from the system's. It may write
    // none, and gets only the environment variables in kToolVariables. It may call neither the
    // network nor other processes. Without Landlock (Linux 5.13) the kernel does not enforce the
    // files. On Windows only the variables are enforced, and that it starts no other process.
    // Absent: any file, variable and call.
    std::optional<std::vector<std::filesystem::path>> reads{};
};

// How a child ended.
struct ChildEnd {
    int status = 0;  // exit status, or the signal that ended it
    bool signaled = false;  // never on Windows
    bool out_of_time = false;  // by its limit on CPU time
    bool out_of_memory = false;  // a fork, by its limit on memory
};

// Called with each part of a child's stdout as it arrives.
using Take = std::function<void(std::span<const char> part)>;
// Called at least ten times a second. An exception from it, or from Take, ends the child.
using Poll = std::function<void()>;

// Runs a program without a shell and with empty input to its end. `errors` gets the last 64 KiB or
// more of its stderr. Throws std::system_error with std::errc::no_such_file_or_directory if there
// is no such program.
ChildEnd runChild(
    const std::vector<std::string>& arguments, const ChildLimits& limits, const Take& take,
    const Poll& poll, std::string& errors);

// Runs `work` in a fork of this process, and passes its result to `take`. On Windows, which has no
// forks, `work` runs in this process, without limits.
ChildEnd runFork(
    const std::function<std::string()>& work, const ChildLimits& limits, const Take& take,
    const Poll& poll);

// Limits this process's CPU time and additional memory from now on. If the time is used up, prints
// the text on stderr and ends the process with status 1. `out_of_time` must live until the end.
void limitSelf(const ChildLimits& limits, const char* out_of_time);

// A program that runs. It has no input, its output goes to a file, and its temporary files to a
// folder. The destructor ends it.
class Program {
public:
    // Throws std::system_error if the file can't be written. If there is no such program, or it
    // can't be run, end() says so.
    Program(
        const std::vector<std::string>& command, const std::filesystem::path& output,
        const std::filesystem::path& temporary);
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    ~Program();

    // Absent while it runs. Status 127: there is no such program.
    std::optional<ChildEnd> end();

    // Interrupts it and the processes that it started, as Ctrl-C does.
    void interrupt();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

// Returns a command that runs a line of the system's shell, which may name the arguments after it.
// Throws Error on Windows, whose shell quotes arguments in no single way.
std::vector<std::string> shellCommand(const std::string& line);

}  // namespace engine::system
