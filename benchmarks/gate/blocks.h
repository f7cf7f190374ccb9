#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/sweep.h"
#include "engine/process.h"

// Stopping rule of a gate.

namespace benchmarks::gate {

struct GateMetric {
    std::vector<double> calibration{};  // ln(A2/A1) of pairs of one build; may be empty
    bool decides = true;  // false: the metric is judged, but the gate does not wait for it
    // Index of the metric that has this time in cycles. If the cycles stay the same, a change of
    // the time is due to the clock and decides nothing.
    std::optional<std::size_t> cycles{};
};

// Tells which build to run next and when enough is known, and passes verdicts; its owner runs the
// processes. Pairs of blocks go A B, B A, A B ..., so that a drift of the machine raises as many
// differences as it lowers. Verdicts are passed after 12, 24 and 48 pairs (from the rule's
// first_pairs on), and after 8 on changes of report::kLargeChange in every pair. A verdict other
// than "inconclusive" is final, as each stage has its share of the level. The gate ends when no
// deciding metric is inconclusive, or when one has regressed and `all` is false. After 48 pairs,
// inconclusive metrics stay inconclusive. All blocks must do the same work: the owner must stop if
// pictures or states differ.
class Gate {
public:
    enum class Step { run_a, run_b, decided };

    // `all`: a regression does not end the gate while other metrics are inconclusive.
    explicit Gate(
        std::vector<GateMetric> metrics, const report::VerdictRule& rule = {}, bool all = false);

    Step next() const;

    // Adds a block of the build that next() requested: the median of each metric's samples, where
    // larger is worse, and whether the board's power cap lowered the clock while they were taken
    // (empty: it did not). Throws engine::Error if there are more or fewer medians than metrics.
    void add(std::vector<double> medians, const std::vector<char>& capped = {});

    std::size_t pairs() const { return pairs_; }

    // Number of pairs at the next decision; at the end, the last number of pairs.
    std::size_t nextDecision() const;

    // True if the metric's time changed but its cycles did not. False if the power cap lowered the
    // clock in every block of the slower build: it needs more power for its cycles, so that it is
    // slower on this board each time.
    bool isClockChange(std::size_t metric) const;

    // Number of pairs at the last verdicts; 0: none yet.
    std::size_t decidedAt() const { return decided_at_; }

    // One comparison per metric, as of decidedAt(), so that stopping at a lucky moment decides
    // nothing. A metric with an earlier verdict keeps the comparison of that time. Before the first
    // verdicts, all comparisons are inconclusive and show the current knowledge. A metric with a
    // median that is not above 0 in some block cannot be compared: it is inconclusive, requests no
    // more pairs and does not affect the others.
    std::vector<report::Comparison> comparisons() const;

private:
    void addPair(const std::vector<double>& a, const std::vector<double>& b);
    bool isStage(std::size_t pairs) const;
    void passEarlyVerdicts();
    void passVerdicts();
    std::vector<report::Comparison> compareNow() const;

    std::vector<GateMetric> metrics_;
    report::VerdictRule rule_;
    std::vector<std::vector<double>> differences_;  // [metric][pair], ln(B/A)
    std::vector<char> comparable_;  // [metric]
    std::vector<char> a_capped_;  // [metric], in every block of A so far
    std::vector<char> b_capped_;
    bool all_;
    std::vector<report::Comparison> decided_;  // [metric], of decided_at_; may be empty
    std::size_t decided_at_ = 0;
    std::optional<std::vector<double>> waiting_;  // the first block of the next pair
    std::size_t pairs_ = 0;
};

// Processes of a gate: the command of each side, and the results of a process.

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
    bool shaders = false;  // compare figures of compiled shaders instead of times
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
    bool shaders = false;  // "shaders SCENE --out OUT ..." is
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

    // The same, but leaves the report in a file.
    void play(const Side& side, std::uint32_t seed, const std::filesystem::path& report);

private:
    engine::ScratchFolder scratch_;
    std::filesystem::path scene_;
};

}  // namespace benchmarks::gate
