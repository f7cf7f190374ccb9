#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hair {

// Runs a program, without a shell and with nothing to read, and returns what it wrote to stdout.
// Throws engine::Error: the last line that it wrote to stderr if it fails, how it ended if it wrote
// none; std::errc::no_such_file_or_directory as std::system_error where there is no such program.
std::vector<std::byte> runTool(const std::vector<std::string>& arguments);

// The same, but hands over each line of stdout, without its end, as soon as it is there, and calls
// `poll` some ten times a second while there is nothing. What either throws ends the program.
void runTool(
    const std::vector<std::string>& arguments,
    const std::function<void(std::string_view line)>& each_line,
    const std::function<void()>& poll = {});

}  // namespace hair
