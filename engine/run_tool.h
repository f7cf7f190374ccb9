#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/system/child.h"

// Runs other programs, and parts of this one, as child processes.
namespace engine {

using system::ChildLimits;

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
// as checkInterrupted() does. On Windows, which has no forks, `work` runs in this process, without
// limits.
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
