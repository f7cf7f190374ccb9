#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hair {

// Runs a program, without a shell and with nothing to read, and returns what it wrote to stdout.
// Throws engine::Error: the last line that it wrote to stderr if it fails, how it ended if it wrote
// none; std::errc::no_such_file_or_directory as std::system_error where there is no such program.
std::vector<std::byte> runTool(const std::vector<std::string>& arguments);

}  // namespace hair
