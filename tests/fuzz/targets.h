#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The targets of fuzzing: all readers of files that a stranger may have made.
namespace fuzz {

// A folder of files to start from, relative to the project's folder.
struct Seeds {
    std::string folder;  // or one file
    std::vector<std::string> extensions;  // with the dot; empty: all files
};

struct Limits {
    std::size_t length = 4096;  // bytes of a file; larger seeds are left out
    // Greatest single allocation in MiB. A file of a few kilobytes needs no more, so a larger
    // allocation means that some count was not checked.
    std::size_t allocation = 64;
    std::size_t seconds = 10;  // for one file
};

struct Target {
    std::string name;  // also of the folder with its findings
    // Throws engine::Error to refuse the bytes, and std::logic_error if the result is not valid.
    // Any other exception is a finding too.
    std::function<void(std::string_view bytes)> read;
    std::vector<Seeds> seeds;
    Limits limits{};
};

// Returns the readers of strands, named after their formats' extensions, then all others.
std::span<const Target> targets();

// Throws std::out_of_range if no target has the name.
const Target& targetNamed(std::string_view name);

// Returns the files to start from that are not longer than the target's limit, sorted. Leaves out
// findings.
std::vector<std::filesystem::path> seedsOf(const Target& target);

// Returns the target's findings in tests/corpus/findings, sorted.
std::vector<std::filesystem::path> findingsOf(const Target& target);

}  // namespace fuzz
