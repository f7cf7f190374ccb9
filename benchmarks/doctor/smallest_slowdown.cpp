#include "benchmarks/doctor/smallest_slowdown.h"

#include <cmath>
#include <iterator>
#include <random>
#include <vector>

#include "benchmarks/decide/multiple_tests.h"
#include "benchmarks/decide/signed_rank.h"
#include "benchmarks/decide/verdict.h"
#include "benchmarks/statistics.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

constexpr int kGates = 1000;  // 90 % of them are known to a percent
constexpr double kFound = 0.9;
constexpr std::uint32_t kSeed = 1;

}  // namespace

double
smallestSlowdown(std::span<const double> differences, double decisive_change, std::size_t metrics) {
    if (differences.size() < 2) throw engine::Error("calibration", "two pairs are needed");
    const double level = stageLevel(VerdictRule{}.alpha) / static_cast<double>(metrics);
    std::mt19937 random(kSeed);  // whose numbers the standard fixes
    std::vector<double> missing;  // ln of the slowdown that each gate needs, less ln(1 + tau)
    std::vector<double> drawn(*std::rbegin(kStages));
    for (int gate = 0; gate < kGates; ++gate) {
        for (double& each : drawn) {
            each = differences[random() % differences.size()];
            if (random() % 2 == 0) each = -each;
        }
        missing.push_back(-signedRankInterval(drawn, level).lower);
    }
    return std::expm1(std::log1p(decisive_change) + quantile(missing, kFound));
}

}  // namespace benchmarks
