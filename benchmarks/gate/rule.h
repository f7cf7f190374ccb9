#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "benchmarks/report/change.h"

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

}  // namespace benchmarks::gate
