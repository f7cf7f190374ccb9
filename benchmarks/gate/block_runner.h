#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "benchmarks/gate/block_report.h"
#include "benchmarks/gate/side.h"
#include "benchmarks/scratch_folder.h"

namespace benchmarks {

// A process that should have measured something and did not.
class BlockFailed : public std::runtime_error {
public:
    BlockFailed(const std::string& what, int exit_status)
        : std::runtime_error(what), exit_status_(exit_status) {}

    // For this program to end with: the process's, where it found the scene or its options at fault
    // (2), had nothing to run (14) or no device (77); else 1.
    int exitStatus() const { return exit_status_; }

private:
    int exit_status_;
};

// Runs the processes of a gate, one at a time.
class BlockRunner {
public:
    explicit BlockRunner(std::filesystem::path scene) : scene_(std::move(scene)) {}

    // One process to its end, and what its report says. Throws BlockFailed with the end of what the
    // process said, Interrupted.
    BlockReport run(const Side& side, std::uint32_t seed);

private:
    ScratchFolder scratch_;
    std::filesystem::path scene_;
};

}  // namespace benchmarks
