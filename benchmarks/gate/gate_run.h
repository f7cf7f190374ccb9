#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/compare/change.h"
#include "benchmarks/compare/mismatch.h"
#include "benchmarks/decide/gate.h"
#include "benchmarks/gate/block_report.h"
#include "benchmarks/gate/side.h"

namespace benchmarks {

// A metric of a case that both sides have and a verdict is passed on.
struct GateTime {
    std::string case_name;
    MetricReading metric;  // of A's first block
    std::vector<double> calibration{};  // ln(A2/A1) of each pair of A with itself; may be empty
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
    enum class End { decided, interrupted, failed };

    Side a;
    Side b;
    std::string scene;
    VerdictRule rule;
    std::optional<BlockReport> first_a;  // blocks that came first
    std::optional<BlockReport> first_b;
    std::vector<std::string> unmatched;  // "only in A: thesis/msaa:4"
    std::vector<GateTime> times;
    std::vector<GateTime> too_short;  // see kShortestTime
    std::vector<BlockRecord> blocks;  // in the order in which they ran
    std::vector<Mismatch> mismatches;
    char unstable = 0;  // the side whose own blocks differ, 'A' or 'B'; else 0
    std::size_t pairs = 0;  // that were compared
    std::vector<Change> changes;  // one for each of `times`; none before a pair is complete

    End end = End::decided;
    std::string failure;  // what a process that failed said
    int failure_status = 0;
};

// `mismatch` if there is one, otherwise as overallVerdict() of its changes.
Verdict overallVerdict(const GateRun& run);

// The exit status of the gate command.
int exitStatus(const GateRun& run, const VerdictOptions& options);

// Differences ln(B/A) of the pairs of a phase whose blocks are complete; in the calibration B is
// the second of a pair where A came first, so that a drift cancels there too. One for each of
// `times`; NaN where a median is missing.
std::vector<std::vector<double>> pairDifferences(const GateRun& run, Phase phase);

}  // namespace benchmarks
