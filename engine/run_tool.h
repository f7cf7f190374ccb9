#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

// Other programs, and parts of this one, run as children.
namespace engine {

// Runs a program, without a shell and with nothing to read, and returns what it wrote to stdout.
// Throws Error: the last line that it wrote to stderr if it fails, its first 300 bytes, or how it
// ended if it wrote none; std::errc::no_such_file_or_directory as std::system_error where there is
// no such program. More than `most` bytes end the program, and are an error too.
// An interrupt of this process ends the program, and throws Interrupted.
std::vector<std::byte> runTool(
    const std::vector<std::string>& arguments,
    std::size_t most = std::numeric_limits<std::size_t>::max());

// What a child may use at most.
struct ChildLimits {
    unsigned seconds = 0;  // of the processor
    std::size_t bytes = 0;  // of memory, beside what this process has
};

// Runs `work` in a copy of this process, and returns what it returns: for what may never end, take
// all memory, or crash. The copy has this thread alone, so `work` may wait for no other; it is to
// throw nothing. Throws Error that says how the child ended if it did not return. An interrupt, or
// the end of a TimeLimit, ends the child and is thrown as checkInterrupted() does.
std::string runApart(const std::function<std::string()>& work, const ChildLimits& limits);

// Runs a program as the function above does but for interrupts, hands over each line that it writes
// to stdout, without its end, as soon as it is there, and calls `poll` some ten times a second
// while there is nothing. What either throws ends the program.
void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll = {});

}  // namespace engine
