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

// Processes of a gate: the command of each side, and the results of a process.
namespace benchmarks::gate {

struct BlockCase {
    report::CaseOutcome outcome;
    std::vector<report::MetricReading> metrics;  // none if the case did not run
    bool capped = false;  // the board's power cap lowered its clock
};

// The part of a process's report that a gate uses.
struct BlockReport {
    scene::Document environment;
    scene::Document scene;  // path and hash
    bool software_device = false;
    std::vector<BlockCase> cases;
};

const BlockCase* findCase(const BlockReport& block, const std::string& name);

// A metric of a case that is in both blocks; the blocks must outlive it.
struct CommonMetric {
    std::string case_name;
    const report::MetricReading* a;
    const report::MetricReading* b;
};

// In A's order.
std::vector<CommonMetric> commonMetrics(const BlockReport& a, const BlockReport& b);

// Differences of the cases that are in both blocks.
std::vector<report::Mismatch> mismatches(const BlockReport& a, const BlockReport& b);

struct GateOptions {
    std::string a;  // build folder, program, or command line
    std::string b;
    scene::SceneOptions scene;
    std::string filter;
    std::vector<std::string> a_sets;  // "POINTER=VALUE" for A's or B's runs only
    std::vector<std::string> b_sets;
    std::uint32_t pairs = 12;
    std::uint32_t calibration = 0;  // A/A pairs before the gate; 0: none
    report::VerdictOptions verdict;
    bool all = false;  // continue after a regression until nothing is inconclusive
    double max_minutes = 0.0;  // after which no new block begins; 0: no limit
    std::filesystem::path out;  // report of the gate; empty: results/local/gate-<scene>.json
    std::vector<std::string> command;
};

// One of the two sides of a gate: the command for each of its blocks.
struct Side {
    char name = 'A';
    std::string text;  // as the user gave it
    // A shell command with {scene}, {out} and optionally {seed}; empty: `program` is used.
    std::string pattern;
    std::vector<std::string> program;  // "run SCENE --out OUT ..." is appended to it
    std::vector<std::string> options;  // for this side's runs, appended last
};

// The side of --a or --b: a build folder, a program, a shell command line, or a pattern with places
// for scene and report, which is used unchanged. Throws engine::Error "--a TEXT: ..." for a folder
// without a program, a pattern without {out}, or options that a pattern cannot receive.
Side parseSide(char name, const GateOptions& options);

// Default duration of each mode of a block, without --max-time. The error of one process does not
// average out within it, so many short processes tell more than few long ones. A GPU raises its
// clocks in this time.
inline constexpr double kBlockSeconds = 0.5;

// The command of one block.
std::vector<std::string> blockCommand(
    const Side& side, const std::filesystem::path& scene, const std::filesystem::path& out,
    std::uint32_t seed);

// Thrown for a process that did not measure anything.
class BlockFailed : public std::runtime_error {
public:
    BlockFailed(const std::string& what, int exit_status)
        : std::runtime_error(what), exit_status_(exit_status) {}

    // The exit status for this program. It is that of the process if the scene or its options were
    // faulty (2), nothing ran (14) or there was no device (77); otherwise 1.
    int exitStatus() const { return exit_status_; }

private:
    int exit_status_;
};

// Runs the processes of a gate, one at a time.
class BlockRunner {
public:
    explicit BlockRunner(std::filesystem::path scene) : scene_(std::move(scene)) {}

    // Runs one process to its end and returns the content of its report. Throws BlockFailed with
    // the end of the process's output, and Interrupted.
    BlockReport run(const Side& side, std::uint32_t seed);

private:
    engine::ScratchFolder scratch_;
    std::filesystem::path scene_;
};

}  // namespace benchmarks::gate
