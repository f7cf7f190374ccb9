#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

// Other programs, run as children.
namespace engine {

// Runs a program, without a shell and with nothing to read, and returns what it wrote to stdout.
// Throws Error: the last line that it wrote to stderr if it fails, its first 300 bytes, or how it
// ended if it wrote none; std::errc::no_such_file_or_directory as std::system_error where there is
// no such program. More than `most` bytes end the program, and are an error too.
// An interrupt of this process ends the program, and throws Interrupted.
std::vector<std::byte> runTool(
    const std::vector<std::string>& arguments,
    std::size_t most = std::numeric_limits<std::size_t>::max());

// Runs a program as the function above does but for interrupts, hands over each line that it writes
// to stdout, without its end, as soon as it is there, and calls `poll` some ten times a second
// while there is nothing. What either throws ends the program.
void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll = {});

}  // namespace engine
