#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/sweep.h"
#include "engine/process.h"

// Processes of a gate: which command each side runs, and what a process reported.
namespace benchmarks::gate {

struct BlockCase {
    report::CaseOutcome outcome;
    std::vector<report::MetricReading> metrics;  // none where it did not run
};

// What a gate takes from the report of one process.
struct BlockReport {
    scene::Document environment;
    scene::Document scene;  // path and hash
    bool software_device = false;
    std::vector<BlockCase> cases;
};

const BlockCase* findCase(const BlockReport& block, const std::string& name);

// A metric of a case that both blocks have; they have to outlive it.
struct CommonMetric {
    std::string case_name;
    const report::MetricReading* a;
    const report::MetricReading* b;
};

// In A's order.
std::vector<CommonMetric> commonMetrics(const BlockReport& a, const BlockReport& b);

// What differs in any case that both have.
std::vector<report::Mismatch> mismatches(const BlockReport& a, const BlockReport& b);

struct GateOptions {
    std::string a;  // build folder, program, or command line
    std::string b;
    scene::SceneOptions scene;
    std::string filter;
    std::vector<std::string> a_sets;  // "POINTER=VALUE" for A's or B's runs alone
    std::vector<std::string> b_sets;
    std::uint32_t pairs = 12;
    std::uint32_t calibration = 0;  // A/A pairs before the gate; 0: none
    report::VerdictOptions verdict;
    bool all = false;  // go on after a regression, until nothing is inconclusive
    double max_minutes = 0.0;  // after which no block is begun; 0: no limit
    std::filesystem::path out;  // report of the gate; empty: results/local/gate-<scene>.json
    std::vector<std::string> command;
};

// One of the two that a gate compares: what is run for each of its blocks.
struct Side {
    char name = 'A';
    std::string text;  // as the user gave it
    // A shell command with {scene} and {out} in it, and {seed} if it wants it; empty: `program`.
    std::string pattern;
    std::vector<std::string> program;  // that "run SCENE --out OUT ..." is added to
    std::vector<std::string> options;  // of this side's runs, after those
};

// The side that --a or --b names: a build folder, a program, a command line for the shell, or one
// with places for scene and report, which is taken as it is. Throws engine::Error "--a TEXT: ...":
// a folder without a program, a pattern without {out}, options that a pattern would not get.
Side parseSide(char name, const GateOptions& options);

// How long each mode of a block goes on unless --max-time says otherwise. What one process is off
// by does not average out within it: many short processes tell more than few long ones. A GPU
// raises its clocks in that time.
inline constexpr double kBlockSeconds = 0.5;

// The command of one block.
std::vector<std::string> blockCommand(
    const Side& side, const std::filesystem::path& scene, const std::filesystem::path& out,
    std::uint32_t seed);

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
    engine::ScratchFolder scratch_;
    std::filesystem::path scene_;
};

}  // namespace benchmarks::gate
