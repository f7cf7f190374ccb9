#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/gate/blocks.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/scene/json.h"

// A gate: warm-up, calibration and pairs of processes until the verdicts are known.

namespace benchmarks::gate {

// A metric of a case that both sides have and that gets a verdict.
struct GateTime {
    std::string case_name;
    report::MetricReading metric;  // of A's first block
    std::vector<double> calibration{};  // ln(A2/A1) of each pair of A with itself; may be empty
    std::optional<double> share{};  // of a pass: share of all passes of its case, the larger of A
                                    // and B
    bool decides = true;  // false for passes with too small a share of their frame, and for cycles
    std::optional<std::size_t> cycles{};  // index in `times` of the same metric in cycles
};

enum class Phase { warm_up, calibration, gate };

// One process.
struct BlockRecord {
    Phase phase = Phase::gate;
    char side = 'A';
    std::size_t pair = 0;  // in its phase
    std::uint32_t seed = 0;  // for the order of its cases
    std::vector<double> medians;  // one per GateTime, in its unit; NaN if missing
    std::vector<char> capped;  // one per GateTime: the board's power cap lowered the clock
};

// Everything that a gate did; its verdicts can be recomputed from it.
struct GateRun {
    enum class End { decided, interrupted, out_of_time, failed };

    Side a;
    Side b;
    std::string scene;
    report::VerdictRule rule;
    std::optional<BlockReport> first_a;  // the first block of each side
    std::optional<BlockReport> first_b;
    std::vector<std::string> unmatched;  // "only in A: thesis/msaa:4"
    std::vector<GateTime> times;
    std::vector<GateTime> too_short;  // see kShortestTime
    std::vector<report::CodeChange> code;  // of the first blocks
    std::vector<BlockRecord> blocks;  // in the order in which they ran
    std::vector<report::Mismatch> mismatches;
    std::size_t repeated_blocks = 0;  // blocks that were lost, for example to heat, and run again
    char unstable = 0;  // the side whose own blocks differ, 'A' or 'B'; else 0
    std::size_t pairs = 0;  // number of compared pairs
    std::size_t decided_at = 0;  // number of pairs at the verdicts; 0: none yet
    std::vector<report::Change> changes;  // one for each of `times`; none before the first complete
                                          // pair

    End end = End::decided;
    std::string failure;  // output of the failed process
    int failure_status = 0;
};

// `mismatch` if there is one, otherwise overallVerdict() of its changes.
report::Verdict overallVerdict(const GateRun& run);

// The exit status of the gate command. If the gate was stopped, it follows the last verdicts, if
// any.
int exitStatus(const GateRun& run, const report::VerdictOptions& options);

// Differences ln(B/A) of a phase's complete pairs, for each of `times`; NaN if a median is missing.
// In the calibration, the two blocks of A take the roles of A and B in alternation, so that a drift
// cancels there too.
std::vector<std::vector<double>> pairDifferences(const GateRun& run, Phase phase);

// Thrown when the time is up and no further block may begin.
struct OutOfTime {};

// A gate in steps: warmUp(), then calibrate() if wanted, then play(). Each returns false if there
// is nothing to continue with: pictures or states differ, or there is nothing to judge. They throw
// Interrupted, OutOfTime, BlockFailed and engine::Error; run() then has everything done so far.
class GateSession {
public:
    // Judges the metrics of `judged`; if it is empty, those that match options.verdict.metrics.
    explicit GateSession(const GateOptions& options, report::MetricChoice judged = {});
    GateSession(const GateSession&) = delete;
    GateSession& operator=(const GateSession&) = delete;
    ~GateSession();

    // Runs one block per side, which gives no samples. It fills caches of shaders and files, tells
    // which metrics there are, and checks that pictures and states agree before anything is timed.
    bool warmUp();

    // Runs pairs of A with itself; their differences are the machine's noise.
    bool calibrate(std::size_t pairs);

    // Runs pairs of blocks until the verdicts are known.
    bool play();

    GateRun& run() { return run_; }

private:
    // Runs one more process. Returns false if its pictures or states differ from those of its
    // side's first block.
    bool block(const Side& side, Phase phase, std::size_t pair);
    void chooseTimes();
    void addCycles(const std::vector<CommonMetric>& common);
    void judge(const Gate& gate);

    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double max_minutes_;
    bool all_;
    double smallest_share_;
    std::string regex_;  // of the requested metrics; may be empty
    report::MetricChoice judged_;  // empty: times by the most informative clock
    BlockRunner runner_;
    std::uint32_t seed_;  // of the first pair; both blocks of a pair have the same order of cases
    GateRun run_;
    std::optional<measure::Progress> progress_;  // of the current step
};

// Runs all steps; the reason for its end is in the result.
GateRun runGate(const GateOptions& options);

// Report of a gate, as JSON and for a terminal.

inline constexpr const char* kGateSchema = "hairbench-gate/1.3.0";

// The complete gate, as described by results/gate.schema.json; verdicts can be recomputed from it.
// Unknown values are absent.
scene::Json gateReport(
    const GateRun& run, const report::VerdictOptions& options,
    const std::vector<std::string>& command);

// Text for a terminal: the sides, the differences, a row per metric, and the counts of verdicts.
std::string gateText(const GateRun& run);

}  // namespace benchmarks::gate
