#include "benchmarks/gate/gate_run.h"

#include <cmath>
#include <limits>

#include "benchmarks/exit_codes.h"

namespace benchmarks {

namespace {

// The two blocks of a pair, as they came.
struct PairOfBlocks {
    const BlockRecord* first;
    const BlockRecord* second;
};

std::vector<PairOfBlocks> completePairs(const GateRun& run, Phase phase) {
    std::vector<PairOfBlocks> pairs;
    const BlockRecord* waiting = nullptr;
    for (const BlockRecord& each : run.blocks) {
        if (each.phase != phase) continue;
        if (waiting) pairs.push_back({waiting, &each});
        waiting = waiting ? nullptr : &each;
    }
    return pairs;
}

double difference(const GateTime& time, double a, double b) {
    const double ratio = std::log(costOf(time.metric, b) / costOf(time.metric, a));
    return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Verdict overallVerdict(const GateRun& run) {
    return run.mismatches.empty() ? overallVerdict(run.changes) : Verdict::mismatch;
}

int exitStatus(const GateRun& run, const VerdictOptions& options) {
    if (run.end == GateRun::End::interrupted) return kInterrupted;
    if (run.end == GateRun::End::failed) return run.failure_status;
    if (run.mismatches.empty() && run.changes.empty()) return kNothingRan;
    return verdictStatus(overallVerdict(run), options.fail_on_inconclusive);
}

std::vector<std::vector<double>> pairDifferences(const GateRun& run, Phase phase) {
    std::vector<std::vector<double>> differences(run.times.size());
    for (const PairOfBlocks& pair : completePairs(run, phase)) {
        const bool a_first =
            phase == Phase::calibration ? pair.first->pair % 2 == 0 : pair.first->side == 'A';
        const BlockRecord& a = a_first ? *pair.first : *pair.second;
        const BlockRecord& b = a_first ? *pair.second : *pair.first;
        for (std::size_t i = 0; i < run.times.size(); ++i)
            differences[i].push_back(difference(run.times[i], a.medians[i], b.medians[i]));
    }
    return differences;
}

}  // namespace benchmarks
