#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace benchmarks {

// How a process ended.
struct ChildEnd {
    int status = 0;  // of its exit; 128 + signal where one ended it, as shells count
    bool signaled = false;
};

// Runs a program to its end, found as the shell finds it, with nothing to read and all that it says
// in the file `output`. It has a process group of its own: where this program is interrupted, the
// group is interrupted, killed if it goes on for five seconds more, and Interrupted thrown.
// Status 127 where there is no such program.
ChildEnd runChild(const std::vector<std::string>& command, const std::filesystem::path& output);

}  // namespace benchmarks
