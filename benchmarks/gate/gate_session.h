#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "benchmarks/gate/side.h"
#include "benchmarks/gate/block_runner.h"
#include "benchmarks/gate/gate_run.h"
#include "benchmarks/progress.h"

namespace benchmarks {

// A gate in steps: warmUp() first, calibrate() if wanted, then play(). Each returns whether there
// is anything to go on with: not where pictures or states differ or nothing is to be judged. They
// throw Interrupted, BlockFailed, engine::Error; what was done until then is in run().
class GateSession {
public:
    // Judges the metrics of `judged`; of an empty one those that options.verdict.metrics finds.
    explicit GateSession(const GateOptions& options, MetricChoice judged = {});
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
    void judge(const Gate& gate);

    std::string regex_;  // of the metrics that were asked for; may be empty
    MetricChoice judged_;  // empty: the times by the clock that tells most
    BlockRunner runner_;
    std::uint32_t seed_;  // of the first pair: both blocks of a pair have the same order of cases
    GateRun run_;
    std::optional<Progress> progress_;  // of the step that goes on
};

// All steps; what ended them is in the result.
GateRun runGate(const GateOptions& options);

}  // namespace benchmarks
