#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/gate/blocks.h"
#include "benchmarks/gate/rule.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"

// A gate: warm-up, calibration and pairs of processes until the verdicts are known.
namespace benchmarks::gate {

// A metric of a case that both sides have and a verdict is passed on.
struct GateTime {
    std::string case_name;
    report::MetricReading metric;  // of A's first block
    std::vector<double> calibration{};  // ln(A2/A1) of each pair of A with itself; may be empty
    std::optional<double> share{};  // of a pass: of all passes of its case, in A or B, the larger
    bool decides = true;  // no pass that is too small a share of its frame, and no cycles
    std::optional<std::size_t> cycles{};  // index in `times` of the same in cycles
};

enum class Phase { warm_up, calibration, gate };

// One process.
struct BlockRecord {
    Phase phase = Phase::gate;
    char side = 'A';
    std::size_t pair = 0;  // of its phase
    std::uint32_t seed = 0;  // of the order of its cases
    std::vector<double> medians;  // of each GateTime, in its unit; NaN where it has none
};

// All that a gate did, from which its verdicts can be worked out again.
struct GateRun {
    enum class End { decided, interrupted, out_of_time, failed };

    Side a;
    Side b;
    std::string scene;
    report::VerdictRule rule;
    std::optional<BlockReport> first_a;  // blocks that came first
    std::optional<BlockReport> first_b;
    std::vector<std::string> unmatched;  // "only in A: thesis/msaa:4"
    std::vector<GateTime> times;
    std::vector<GateTime> too_short;  // see kShortestTime
    std::vector<BlockRecord> blocks;  // in the order in which they ran
    std::vector<report::Mismatch> mismatches;
    char unstable = 0;  // the side whose own blocks differ, 'A' or 'B'; else 0
    std::size_t pairs = 0;  // that were compared
    std::size_t decided_at = 0;  // pairs at which the verdicts were passed; 0: none were
    std::vector<report::Change> changes;  // one for each of `times`; none before a pair is complete

    End end = End::decided;
    std::string failure;  // what a process that failed said
    int failure_status = 0;
};

// `mismatch` if there is one, otherwise as overallVerdict() of its changes.
report::Verdict overallVerdict(const GateRun& run);

// The exit status of the gate command. One that was stopped ends as its last verdicts say, where
// any were passed.
int exitStatus(const GateRun& run, const report::VerdictOptions& options);

// Differences ln(B/A) of the pairs of a phase whose blocks are complete; in the calibration B is
// the second of a pair where A came first, so that a drift cancels there too. One for each of
// `times`; NaN where a median is missing.
std::vector<std::vector<double>> pairDifferences(const GateRun& run, Phase phase);

// No block is begun any more.
struct OutOfTime {};

// A gate in steps: warmUp() first, calibrate() if wanted, then play(). Each returns whether there
// is anything to go on with: not where pictures or states differ or nothing is to be judged. They
// throw Interrupted, OutOfTime, BlockFailed, engine::Error; what was done until then is in run().
class GateSession {
public:
    // Judges the metrics of `judged`; of an empty one those that options.verdict.metrics finds.
    explicit GateSession(const GateOptions& options, report::MetricChoice judged = {});
    GateSession(const GateSession&) = delete;
    GateSession& operator=(const GateSession&) = delete;
    ~GateSession();

    // One block of each side, which is no sample: it fills caches of shaders and files, shows which
    // metrics there are, and whether pictures and states agree before anything is timed.
    bool warmUp();

    // Pairs of A with itself: what differs between them is the machine's noise.
    bool calibrate(std::size_t pairs);

    // Pairs of blocks until the verdicts are known.
    bool play();

    GateRun& run() { return run_; }

private:
    // One more process; false where its pictures or states are not those of its side's first block.
    bool block(const Side& side, Phase phase, std::size_t pair);
    void chooseTimes();
    void addCycles(const std::vector<CommonMetric>& common);
    void judge(const Gate& gate);

    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double max_minutes_;
    bool all_;
    double smallest_share_;
    std::string regex_;  // of the metrics that were asked for; may be empty
    report::MetricChoice judged_;  // empty: the times by the clock that tells most
    BlockRunner runner_;
    std::uint32_t seed_;  // of the first pair: both blocks of a pair have the same order of cases
    GateRun run_;
    std::optional<measure::Progress> progress_;  // of the step that goes on
};

// All steps; what ended them is in the result.
GateRun runGate(const GateOptions& options);

}  // namespace benchmarks::gate
