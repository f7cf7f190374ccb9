#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/gate/blocks.h"
#include "benchmarks/report/statistics.h"
#include "tests/decide/noise.h"

// Tests gates with the noise of shared machines: every block is off by 0.4 %, and the machine's
// speed does a random walk with a standard deviation of 1.5 % over the 24 blocks of 12 pairs.
namespace benchmarks::report {
namespace {

constexpr double kBlockNoise = 0.004;
constexpr double kWalk = 0.015;
constexpr double kWalkBlocks = 24.0;

class Machine {
public:
    explicit Machine(Noise& noise) : noise_(noise) {}

    // Returns the median of a block that takes 1 ms on a quiet machine, times exp(cost).
    double run(double cost) {
        walked_ += kWalk / std::sqrt(kWalkBlocks) * noise_.normal();
        return std::exp(cost + walked_ + kBlockNoise * noise_.normal());
    }

private:
    Noise& noise_;
    double walked_ = 0.0;
};

std::vector<double> calibrate(Noise& noise, std::size_t pairs) {
    Machine machine(noise);
    std::vector<double> differences;
    for (std::size_t i = 0; i < pairs; ++i) {
        const double first = machine.run(0.0);
        const double second = machine.run(0.0);
        differences.push_back(i % 2 == 0 ? std::log(second / first) : std::log(first / second));
    }
    return differences;
}

struct GateEnd {
    Verdict verdict;
    std::size_t pairs;
};

GateEnd play(
    Noise& noise, double slowdown, const std::vector<double>& calibration,
    const VerdictRule& rule = {}) {
    Machine machine(noise);
    gate::Gate gate(std::vector<gate::GateMetric>{{.calibration = calibration}}, rule);
    const double cost = std::log1p(slowdown);
    for (auto step = gate.next(); step != gate::Gate::Step::decided; step = gate.next())
        gate.add({machine.run(step == gate::Gate::Step::run_b ? cost : 0.0)});
    return {gate.comparisons()[0].verdict, gate.pairs()};
}

bool isFalse(Verdict verdict) {
    return verdict == Verdict::regressed || verdict == Verdict::improved;
}

constexpr int kGates = 2000;

TEST(SimulatedGates, OfIdenticalBuildsRaiseNoFalseAlarm) {
    Noise noise(10);
    int alarms = 0;
    int calibrated_alarms = 0;
    for (int i = 0; i < kGates; ++i) {
        alarms += isFalse(play(noise, 0.0, {}).verdict);
        calibrated_alarms += isFalse(play(noise, 0.0, calibrate(noise, 12)).verdict);
    }
    EXPECT_LE(alarms, kGates / 100);
    EXPECT_LE(calibrated_alarms, kGates / 100);
}

TEST(SimulatedGates, FindASlowdownOf3PercentIn12Pairs) {
    Noise noise(11);
    int found = 0;
    for (int i = 0; i < kGates; ++i) {
        const GateEnd outcome = play(noise, 0.03, {});
        found += outcome.verdict == Verdict::regressed && outcome.pairs == 12;
    }
    EXPECT_GE(found, kGates * 9 / 10);
}

// From 48 pairs the median absolute deviation is known well enough that tau stays below 3 %. From
// 12 it is not always.
TEST(SimulatedGates, FindASlowdownOf3PercentWhenCalibrated) {
    Noise noise(16);
    int found = 0;
    constexpr int kCalibrated = 500;
    for (int i = 0; i < kCalibrated; ++i)
        found += play(noise, 0.03, calibrate(noise, 48)).verdict == Verdict::regressed;
    EXPECT_GE(found, kCalibrated * 9 / 10);
}

// Processes of one build differ by 5 %, as CPU times do on a busy machine.
TEST(SimulatedGates, FindSlowdownsAmidNoiseOf5Percent) {
    Noise noise(17);
    const auto found = [&](double slowdown, std::size_t most_pairs) {
        constexpr int kNoisy = 500;
        int count = 0;
        for (int i = 0; i < kNoisy; ++i) {
            gate::Gate gate(std::vector<gate::GateMetric>(1));
            for (auto step = gate.next(); step != gate::Gate::Step::decided; step = gate.next()) {
                const double cost = step == gate::Gate::Step::run_b ? std::log1p(slowdown) : 0.0;
                gate.add({std::exp(cost + 0.05 / std::sqrt(2.0) * noise.normal())});
            }
            count +=
                gate.comparisons()[0].verdict == Verdict::regressed && gate.pairs() <= most_pairs;
        }
        return static_cast<double>(count) / kNoisy;
    };
    EXPECT_GE(found(0.05, 48), 0.9);
    EXPECT_GE(found(0.5, 8), 0.99);
}

// At the threshold verdicts are most often wrong: at most alpha / 2 on either side, over all tries.
TEST(SimulatedGates, KeepTheirLevelAtTheThreshold) {
    Noise noise(12);
    int regressed = 0;
    for (int i = 0; i < kGates; ++i)
        regressed += play(noise, 0.02, {}).verdict == Verdict::regressed;
    EXPECT_LE(regressed, mostOf(kGates, VerdictRule{}.alpha / 2.0));
}

// Without a threshold only the order of the blocks protects a verdict from drift.
constexpr VerdictRule kNoThreshold{.threshold = 0.0};

TEST(SimulatedGates, KeepTheirLevelWithoutAThreshold) {
    Noise noise(13);
    int alarms = 0;
    for (int i = 0; i < kGates; ++i) alarms += isFalse(play(noise, 0.0, {}, kNoThreshold).verdict);
    EXPECT_LE(alarms, mostOf(kGates, kNoThreshold.alpha));
}

// If all blocks of A ran before those of B, about half of the gates would take the machine's drift
// for the build's. This shows that the tests above can fail.
TEST(SimulatedGates, WouldCryWolfIfBuildsTookNoTurns) {
    Noise noise(14);
    int alarms = 0;
    for (int i = 0; i < kGates; ++i) {
        Machine machine(noise);
        std::vector<double> a(kStages[0]);
        std::vector<double> differences;
        for (double& median : a) median = machine.run(0.0);
        for (const double median : a) differences.push_back(std::log(machine.run(0.0) / median));
        const double tau = kNoThreshold.threshold;
        alarms += isFalse(
            compare(std::span(&differences, 1), std::vector{tau}, kNoThreshold.alpha)[0].verdict);
    }
    EXPECT_GE(alarms, kGates * 4 / 10);
}

// 10 of 30 metrics are really slower. All are exactly at the threshold or far beyond it. Tests the
// share of false verdicts among the regressed metrics, averaged over gates.
TEST(SimulatedGates, KeepTheRateOfFalseDiscoveries) {
    Noise noise(15);
    constexpr std::size_t kMetrics = 30;
    constexpr std::size_t kSlower = 10;
    constexpr int kFamilies = 100;
    double false_share = 0.0;
    double found = 0.0;
    for (int i = 0; i < kFamilies; ++i) {
        std::vector<Machine> machines(kMetrics, Machine(noise));
        gate::Gate gate{std::vector<gate::GateMetric>(kMetrics)};
        for (auto step = gate.next(); step != gate::Gate::Step::decided; step = gate.next()) {
            std::vector<double> medians;
            for (std::size_t m = 0; m < kMetrics; ++m) {
                const double slowdown = m < kSlower ? 0.04 : 0.02;
                medians.push_back(
                    machines[m].run(step == gate::Gate::Step::run_b ? std::log1p(slowdown) : 0.0));
            }
            gate.add(std::move(medians));
        }
        const std::vector<Comparison> compared = gate.comparisons();
        double wrong = 0.0;
        double right = 0.0;
        for (std::size_t m = 0; m < kMetrics; ++m)
            (m < kSlower ? right : wrong) += compared[m].verdict == Verdict::regressed;
        false_share += wrong / std::max(1.0, wrong + right) / kFamilies;
        found += right / kSlower / kFamilies;
    }
    EXPECT_LE(false_share, VerdictRule{}.alpha);
    EXPECT_GE(found, 0.9);
}

}  // namespace
}  // namespace benchmarks::report
