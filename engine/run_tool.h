#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Runs other programs, and parts of this one, as child processes.
namespace engine {

// Limits on a child's resources. Children are in process groups of their own. They end when the
// thread that started them ends, even by a signal.
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
    // files. Absent: any file, variable and call.
    std::optional<std::vector<std::filesystem::path>> reads{};
};

// Sets the limits on CPU time and memory for this process from now on.
void limitSelf(const ChildLimits& limits);

// Runs a program without a shell and with empty input, and returns its stdout. Throws Error if it
// fails, with the first 300 bytes of its last line on stderr, or without such a line with its name
// and exit status. Throws std::system_error with std::errc::no_such_file_or_directory if there is
// no such program. Output over the limit ends the program and is an error too. An interrupt of this
// process ends the program and throws Interrupted.
std::vector<std::byte>
runTool(const std::vector<std::string>& arguments, const ChildLimits& limits = {});

// Runs `work` in a fork of this process and returns its result. This is for work that may never
// end, exhaust memory or crash. The fork has only the calling thread, so `work` must wait for no
// other thread, and can open no file. It must not throw. If the child does not return, throws an
// Error that says how it ended. An interrupt, or the end of a TimeLimit, ends the child and throws
// as checkInterrupted() does.
std::string runApart(const std::function<std::string()>& work, const ChildLimits& limits);

// Runs a program as the function above does, except for interrupts. Passes each line of its stdout
// to `each_line`, without the line end, as soon as it is complete. Calls `poll` at least ten times
// a second. An exception from either ends the program.
void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll = {});

// How a program ended.
struct ProgramEnd {
    int status = 0;  // exit status; 128 + signal if a signal ended it, as shells count
    bool signaled = false;
};

// Runs a program, found as a shell finds it, to its end. It has no input; its output goes to the
// file `output` and its temporary files to the folder `temporary`. It has its own process group. If
// this program is interrupted, the group is interrupted, killed if it runs for 1.7 s more, and
// Interrupted is thrown. The status is 127 if there is no such program.
ProgramEnd runProgram(
    const std::vector<std::string>& command, const std::filesystem::path& output,
    const std::filesystem::path& temporary);

}  // namespace engine
