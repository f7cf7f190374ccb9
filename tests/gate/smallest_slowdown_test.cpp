#include "benchmarks/doctor/reports.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/report/change.h"
#include "tests/decide/noise.h"
#include "tests/error_text.h"

namespace benchmarks::gate {
namespace {

constexpr double kDeviation = 0.05;  // of a pair

std::vector<double> normalDifferences(Noise& noise, std::size_t count) {
    std::vector<double> differences(count);
    for (double& each : differences) each = kDeviation * noise.normal();
    return differences;
}

TEST(SmallestSlowdown, IsThatOfTheNormalApproximation) {
    Noise noise(31);
    const double tau = 0.15;
    const double found = doctor::smallestSlowdown(normalDifferences(noise, 4000), tau, 1);
    // The signed-rank test of n normal differences is as good as a t test of 3 / pi n: its
    // estimate's standard error is sigma sqrt(pi / 3 / n). The interval at level 0.05 / 3 ends
    // 2.394 standard errors below, and nine of ten estimates lie above 1.282 standard errors below
    // the median. 48 pairs are few, so the tolerance is 4 %.
    const double error = kDeviation * std::sqrt(3.14159265 / 3.0 / 48.0);
    const double expected = std::log1p(tau) + (2.394 + 1.282) * error;
    EXPECT_NEAR(std::log1p(found) - std::log1p(tau), expected - std::log1p(tau), 0.04 * expected);
}

TEST(SmallestSlowdown, IsFoundInNineOfTenGates) {
    Noise noise(32);
    const double tau = 0.1;
    const double slowdown = doctor::smallestSlowdown(normalDifferences(noise, 4000), tau, 3);
    constexpr int kGates = 400;
    int found = 0;
    for (int i = 0; i < kGates; ++i) {
        std::vector<std::vector<double>> differences;
        for (int metric = 0; metric < 3; ++metric)
            differences.push_back(normalDifferences(noise, 48));
        for (double& each : differences[0]) each += std::log1p(slowdown);
        const std::vector<double> taus(3, tau);
        found += report::compare(differences, taus, 0.05)[0].verdict == report::Verdict::regressed;
    }
    // Four standard deviations of 400 tries at 0.9 are 0.06.
    EXPECT_NEAR(found / double{kGates}, 0.9, 0.06);
}

TEST(SmallestSlowdown, IsTauWithoutNoise) {
    EXPECT_DOUBLE_EQ(doctor::smallestSlowdown(std::vector<double>(12, 0.0), 0.02, 4), 0.02);
}

TEST(SmallestSlowdown, NeedsPairs) {
    EXPECT_EQ(
        errorText([] { doctor::smallestSlowdown(std::vector{0.1}, 0.02, 1); }),
        "calibration: two pairs are needed");
}

}  // namespace
}  // namespace benchmarks::gate
