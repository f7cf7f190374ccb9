#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "benchmarks/report/change.h"

// Stopping rule of a gate.
namespace benchmarks::gate {

struct GateMetric {
    std::vector<double> calibration{};  // ln(A2/A1) of pairs of one build; may be empty
    bool decides = true;  // false: it is judged, and nothing waits for it
    // Index of the metric that has this one's time in cycles: where that is the same, a change of
    // time is the clock's, and decides nothing.
    std::optional<std::size_t> cycles{};
};

// Says which build to run next and when enough is known, and judges: whoever has it runs processes.
// Pairs of blocks go A B, B A, A B ..., so that a drift of the machine raises as many differences
// as it lowers. After 12, 24 and 48 pairs (from the rule's first_pairs on) verdicts are passed; one
// that is not "inconclusive" stays, as each try has its share of the level. It is over if no metric
// that decides is inconclusive, or if one has regressed and not all are wanted; at 48 whatever is
// inconclusive stays so. It takes all blocks to be of the same work: whoever has it ends where
// pictures or states differ.
class Gate {
public:
    enum class Step { run_a, run_b, decided };

    // `all`: a regression does not end it while others are inconclusive.
    explicit Gate(
        std::vector<GateMetric> metrics, const report::VerdictRule& rule = {}, bool all = false);

    Step next() const;

    // A block of the build that next() asked for: the median of each metric's samples, larger is
    // worse. Another number of medians than of metrics is an engine::Error.
    void add(std::vector<double> medians);

    std::size_t pairs() const { return pairs_; }

    // Pairs at which there is something to decide next; the last number of pairs at the end.
    std::size_t nextDecision() const;

    // Whether the metric's time changed and its cycles did not.
    bool isClockChange(std::size_t metric) const;

    // Pairs at which verdicts were passed last; 0: none were.
    std::size_t decidedAt() const { return decided_at_; }

    // One for each metric: as of decidedAt(), so that stopping at a lucky moment decides nothing,
    // or, where a verdict was passed before that, as of then. Before the first time what is known
    // so far, all inconclusive. A metric with a median that is not above 0 in some block cannot be
    // compared: it is inconclusive, asks for no more pairs and leaves the rest alone.
    std::vector<report::Comparison> comparisons() const;

private:
    void addPair(const std::vector<double>& a, const std::vector<double>& b);
    bool isStage(std::size_t pairs) const;
    void passVerdicts();
    std::vector<report::Comparison> compareNow() const;

    std::vector<GateMetric> metrics_;
    report::VerdictRule rule_;
    std::vector<std::vector<double>> differences_;  // [metric][pair], ln(B/A)
    std::vector<char> comparable_;  // [metric]
    bool all_;
    std::vector<report::Comparison> decided_;  // [metric], of decided_at_; may be empty
    std::size_t decided_at_ = 0;
    std::optional<std::vector<double>> waiting_;  // the first block of the next pair
    std::size_t pairs_ = 0;
};

}  // namespace benchmarks::gate
