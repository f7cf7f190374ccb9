#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The targets of fuzzing: everything that reads a file which a stranger may have made.
namespace fuzz {

// Where files lie to start from, below the project's folder.
struct Seeds {
    std::string folder;  // or one file
    std::vector<std::string> extensions;  // with the dot; empty: all files
};

struct Limits {
    std::size_t length = 4096;  // bytes of a file that is tried; larger seeds are left out
    // MiB that are asked for at once at most. More is a count that nobody has checked, for which a
    // file of a few kilobytes is no reason.
    std::size_t allocation = 64;
    std::size_t seconds = 10;  // for one file
};

struct Target {
    std::string name;  // and that of the folder of its findings
    // Throws engine::Error for bytes that are refused, and std::logic_error where what it read
    // is not as it ought to be. Anything else that it throws is a finding too.
    std::function<void(std::string_view bytes)> read;
    std::vector<Seeds> seeds;
    Limits limits{};
};

// Readers of strands by their formats' extensions, then all others.
std::span<const Target> targets();

// Throws std::out_of_range where none has the name.
const Target& targetNamed(std::string_view name);

// The files to start from that are not longer than the target's limit, sorted; findings are not
// among them.
std::vector<std::filesystem::path> seedsOf(const Target& target);

// Files that were found for the target, sorted: tests/corpus/findings.
std::vector<std::filesystem::path> findingsOf(const Target& target);

}  // namespace fuzz
