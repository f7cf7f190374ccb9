#include "benchmarks/gate/blocks.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/error_text.h"

namespace benchmarks::report {
namespace {

using Step = gate::Gate::Step;

const std::vector<gate::GateMetric> kOneMetric(1);

// Runs pairs with the medians 10 and 10 * ratio(pair) of one metric.
template <class Ratio>
std::size_t play(gate::Gate& gate, Ratio ratio) {
    std::size_t blocks = 0;
    for (Step step = gate.next(); step != Step::decided; step = gate.next(), ++blocks)
        gate.add({step == Step::run_a ? 10.0 : 10.0 * ratio(gate.pairs())});
    return blocks;
}

// Returns -1, 1, -1 ... times a growing spread: all magnitudes differ, and the median is 0.
double wobble(std::size_t pair) {
    return (pair % 2 == 0 ? -1.0 : 1.0) * (1.0 + 0.01 * static_cast<double>(pair));
}

TEST(Gate, TakesTurnsThatCancelADrift) {
    gate::Gate gate(kOneMetric);
    std::string order;
    for (int i = 0; i < 8; ++i) {
        order += gate.next() == Step::run_a ? 'A' : 'B';
        gate.add({1.0});
    }
    EXPECT_EQ(order, "ABBAABBA");
    EXPECT_EQ(gate.pairs(), 4u);
    EXPECT_EQ(gate.nextDecision(), 12u);
}

TEST(Gate, FindsARegressionAtTheFirstDecision) {
    gate::Gate gate(kOneMetric);
    EXPECT_EQ(play(gate, [](std::size_t i) { return 1.03 + 0.001 * wobble(i); }), 24u);
    const Comparison found = gate.comparisons()[0];
    EXPECT_EQ(found.verdict, Verdict::regressed);
    EXPECT_NEAR(found.change, 0.03, 0.001);
    EXPECT_GT(found.lower, 0.02);
    EXPECT_LT(found.upper, 0.04);
    EXPECT_EQ(found.decisive_change, 0.02);
    EXPECT_DOUBLE_EQ(found.p, std::ldexp(1.0, -11));  // all 12 above the band
}

// A share of 20 % in each of 8 pairs, faster or slower.
TEST(Gate, EndsAt8WhenAChangeIsLargeInEveryPair) {
    gate::Gate slower(kOneMetric);
    EXPECT_EQ(play(slower, [](std::size_t i) { return 1.5 + 0.06 * wobble(i); }), 16u);
    EXPECT_EQ(slower.comparisons()[0].verdict, Verdict::regressed);
    EXPECT_EQ(slower.comparisons()[0].pairs, 8u);
    EXPECT_EQ(slower.decidedAt(), 8u);
    EXPECT_EQ(slower.nextDecision(), 8u);  // at the end, the last number of pairs
    gate::Gate faster(kOneMetric);
    EXPECT_EQ(play(faster, [](std::size_t) { return 1.0 / 1.21; }), 16u);
    EXPECT_EQ(faster.comparisons()[0].verdict, Verdict::improved);
    // After one pair of 19 %, or noise that large, the verdict waits for the next decision.
    gate::Gate once(kOneMetric);
    EXPECT_EQ(play(once, [](std::size_t i) { return i == 5 ? 1.19 : 1.5; }), 24u);
    gate::Gate noisy(std::vector<gate::GateMetric>{{.calibration = {0.4, -0.4, 0.4, -0.4}}});
    play(noisy, [](std::size_t i) { return 1.5 + 0.001 * wobble(i); });
    EXPECT_GE(noisy.pairs(), 12u);
    // If 24 pairs are requested, the gate makes no decision before it has them.
    gate::Gate late(kOneMetric, {.first_pairs = 24});
    EXPECT_EQ(play(late, [](std::size_t) { return 1.5; }), 48u);
}

// 5 % slower at equal cycles. Only the slower build's power cap makes that more than a clock
// change.
TEST(Gate, BlamesABuildThatThePowerCapSlowsEachTime) {
    const auto capped_in = [](Step side, std::size_t except) {
        gate::Gate gate({{.cycles = 1}, {.decides = false}});
        for (Step step = gate.next(); step != Step::decided; step = gate.next()) {
            const double time = step == Step::run_b ? 10.5 + 0.001 * wobble(gate.pairs()) : 10.0;
            const char capped = step == side && gate.pairs() != except;
            gate.add({time, 100.0 + 0.001 * wobble(gate.pairs())}, {capped, capped});
        }
        EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::regressed);
        EXPECT_EQ(gate.comparisons()[1].verdict, Verdict::same);
        return gate.isClockChange(0);
    };
    constexpr std::size_t kNever = 1000;
    EXPECT_FALSE(capped_in(Step::run_b, kNever));
    EXPECT_TRUE(capped_in(Step::run_b, 3));
    EXPECT_TRUE(capped_in(Step::run_a, kNever));
}

TEST(Gate, MirrorsForAnImprovement) {
    gate::Gate gate(kOneMetric);
    EXPECT_EQ(play(gate, [](std::size_t i) { return 1.0 / (1.03 + 0.001 * wobble(i)); }), 24u);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::improved);
}

TEST(Gate, SaysSameOfWhatIsInsideTheBand) {
    gate::Gate gate(kOneMetric);
    EXPECT_EQ(play(gate, [](std::size_t i) { return 1.0 + 0.005 * wobble(i); }), 24u);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::same);
    // A significant change that is too small to matter counts as no change.
    gate::Gate slower(kOneMetric);
    play(slower, [](std::size_t i) { return 1.01 + 0.001 * wobble(i); });
    EXPECT_EQ(slower.comparisons()[0].verdict, Verdict::same);
}

TEST(Gate, GoesOnWhileItCannotTellAndGivesUpAt48) {
    gate::Gate gate(kOneMetric);
    EXPECT_EQ(play(gate, [](std::size_t i) { return 1.02 + 0.01 * wobble(i); }), 96u);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::inconclusive);
    EXPECT_EQ(gate.nextDecision(), 48u);
}

TEST(Gate, EndsAt24WhenThatIsEnough) {
    // There is noise at first and none later: 12 pairs decide nothing, and 24 do.
    gate::Gate gate(kOneMetric);
    const auto ratio = [](std::size_t i) { return 1.06 + (i < 12 ? 0.06 : 0.001) * wobble(i); };
    EXPECT_EQ(play(gate, ratio), 48u);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::regressed);
}

// One metric is slower by 50 %, and the other can't be decided. The first is enough to fail a
// build.
TEST(Gate, EndsWithARegressionUnlessAllAreWanted) {
    const auto pair_of = [](gate::Gate& gate) {
        const bool b = gate.next() == Step::run_b;
        const double unsure = 1.02 + 0.01 * wobble(gate.pairs());
        gate.add({b ? 15.0 + 0.01 * wobble(gate.pairs()) : 10.0, b ? unsure : 1.0});
    };
    gate::Gate gate(std::vector<gate::GateMetric>(2));
    while (gate.next() != Step::decided) pair_of(gate);
    EXPECT_EQ(gate.pairs(), 8u);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::regressed);
    EXPECT_EQ(gate.comparisons()[1].verdict, Verdict::inconclusive);
    gate::Gate all(std::vector<gate::GateMetric>(2), {}, true);
    while (all.next() != Step::decided) pair_of(all);
    EXPECT_EQ(all.pairs(), 48u);
    EXPECT_EQ(all.comparisons()[0].verdict, Verdict::regressed);
    EXPECT_EQ(all.comparisons()[0].pairs, 8u);
    EXPECT_EQ(all.comparisons()[1].pairs, 48u);
}

// The first of two metrics changes after the verdict at 12 pairs, which stays. The second keeps the
// gate going.
TEST(Gate, TakesNoVerdictBack) {
    struct Change {
        double before, after;  // of the first metric's ratio
        Verdict verdict;
    };
    for (const auto& [before, after, verdict] :
         {Change{1.1, 1.0, Verdict::regressed}, Change{0.9, 1.0, Verdict::improved},
          Change{1.0, 1.1, Verdict::same}}) {
        gate::Gate gate(std::vector<gate::GateMetric>(2), {}, true);
        while (gate.next() != Step::decided) {
            const bool b = gate.next() == Step::run_b;
            const double wobbling = 0.001 * wobble(gate.pairs());
            const double first = gate.pairs() < 12 ? before + wobbling : after;
            gate.add({b ? first : 1.0, b ? 1.02 + 10.0 * wobbling : 1.0});
            if (gate.decidedAt() > 0) {
                EXPECT_EQ(gate.comparisons()[0].verdict, verdict) << gate.pairs();
                EXPECT_NEAR(gate.comparisons()[0].change, before - 1.0, 0.001);
            }
        }
        EXPECT_EQ(gate.pairs(), 48u);
    }
}

// After 20 pairs the gate still gives the verdict of 12.
TEST(Gate, KeepsTheLastVerdictsWhenItIsStopped) {
    gate::Gate gate(std::vector<gate::GateMetric>(2), {}, true);
    while (gate.pairs() < 20) {
        const bool b = gate.next() == Step::run_b;
        gate.add(
            {b ? 1.0 + 0.005 * wobble(gate.pairs()) : 1.0,
             b ? 1.02 + 0.01 * wobble(gate.pairs()) : 1.0});
    }
    EXPECT_EQ(gate.decidedAt(), 12u);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::same);
    EXPECT_EQ(gate.comparisons()[1].verdict, Verdict::inconclusive);
}

// A metric that decides nothing neither keeps a gate going nor ends it.
TEST(Gate, DoesNotWaitForWhatDecidesNothing) {
    gate::Gate gate(std::vector<gate::GateMetric>{{}, {.decides = false}, {.decides = false}});
    while (gate.next() != Step::decided) {
        const bool b = gate.next() == Step::run_b;
        gate.add(
            {b ? 1.0 + 0.005 * wobble(gate.pairs()) : 1.0,
             b ? 1.02 + 0.01 * wobble(gate.pairs()) : 1.0, b ? 3.0 : 1.0});
    }
    EXPECT_EQ(gate.pairs(), 12u);
    EXPECT_EQ(gate.comparisons()[1].verdict, Verdict::inconclusive);
    EXPECT_EQ(gate.comparisons()[2].verdict, Verdict::regressed);
}

TEST(Gate, DecidesNothingBetweenDecisions) {
    gate::Gate gate(kOneMetric);
    for (int i = 0; i < 26; ++i)  // 13 pairs, far apart; 12 were enough
        if (gate.next() != Step::decided)
            gate.add({gate.next() == Step::run_a ? 1.0 : 1.1 + 0.001 * i});
    EXPECT_EQ(gate.pairs(), 12u);
    gate::Gate early(kOneMetric);
    for (int i = 0; i < 22; ++i) early.add({early.next() == Step::run_a ? 1.0 : 1.1 + 0.001 * i});
    EXPECT_EQ(early.comparisons()[0].verdict, Verdict::inconclusive);
    EXPECT_GT(early.comparisons()[0].lower, 0.02);
}

TEST(Gate, NeedsMoreThanTheMachinesOwnNoise) {
    // Pairs of one build differ by 2 %: on such a machine a change of 3 % is not significant.
    std::vector<double> calibration;
    for (std::size_t i = 0; i < 12; ++i) calibration.push_back(0.02 * wobble(i));
    gate::Gate gate(std::vector<gate::GateMetric>{{.calibration = calibration}});
    play(gate, [](std::size_t i) { return 1.03 + 0.001 * wobble(i); });
    const Comparison found = gate.comparisons()[0];
    EXPECT_EQ(found.verdict, Verdict::same);
    // The magnitudes are 1.00 ... 1.11. Both signs have their MAD about the middle, 1.055, and the
    // median is about 0; worked out by hand to a percent.
    EXPECT_NEAR(found.decisive_change, 3.0 * 1.4826 * 0.02 * 1.055, 0.001);
}

TEST(Gate, LeavesOutAMetricThatCannotBeCompared) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double broken : {0.0, -1.0, nan}) {
        gate::Gate gate(std::vector<gate::GateMetric>(2));
        while (gate.next() != Step::decided) gate.add({1.0, broken});
        EXPECT_EQ(gate.pairs(), 12u);
        EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::same);
        EXPECT_EQ(gate.comparisons()[1].verdict, Verdict::inconclusive);
    }
}

TEST(Gate, RefusesOtherMetrics) {
    gate::Gate gate(kOneMetric);
    EXPECT_EQ(
        errorText([&] { gate.add({1.0, 2.0}); }),
        "gate: one process measured different metrics from the others");
}

TEST(Gate, KnowsNothingBeforeThePairs) {
    const gate::Gate gate(kOneMetric);
    EXPECT_EQ(gate.comparisons()[0].verdict, Verdict::inconclusive);
    EXPECT_EQ(gate.comparisons()[0].lower, -1.0);
}

TEST(DecisiveChange, IsTheThresholdOrTheNoise) {
    EXPECT_EQ(decisiveChange(0.02, {}), 0.02);
    EXPECT_EQ(decisiveChange(0.02, std::vector{0.001, 0.0, -0.001}), 0.02);
    EXPECT_DOUBLE_EQ(decisiveChange(0.02, std::vector{-0.1, 0.0, 0.1}), 3.0 * 1.4826 * 0.1);
}

}  // namespace
}  // namespace benchmarks::report
