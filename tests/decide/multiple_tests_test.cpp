#include "benchmarks/report/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/decide/scipy_values.h"
#include "tests/error_text.h"

namespace benchmarks::report {
namespace {

TEST(FalseDiscovery, IsScipys) {
    for (const auto& row : scipyValues()["false_discovery"]) {
        const auto adjusted = falseDiscoveryAdjusted(row["p"].get<std::vector<double>>());
        const auto expected = row["adjusted"].get<std::vector<double>>();
        ASSERT_EQ(adjusted.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_NEAR(adjusted[i], expected[i], 1e-15);
    }
}

TEST(FalseDiscovery, RejectsWhatThePaperRejects) {
    // Benjamini and Hochberg 1995, section 3.1: 4 of 15 tests are rejected at 5 %.
    const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
    int rejected = 0;
    for (const double adjusted : falseDiscoveryAdjusted(p)) rejected += adjusted <= 0.05;
    EXPECT_EQ(rejected, 4);
}

TEST(FalseDiscovery, OfNothingIsNothing) {
    EXPECT_TRUE(falseDiscoveryAdjusted({}).empty());
    const char* const error = "false discovery rate: a p-value is outside [0, 1]";
    EXPECT_EQ(errorText([] { falseDiscoveryAdjusted(std::vector{0.1, -0.1}); }), error);
    EXPECT_EQ(errorText([] { falseDiscoveryAdjusted(std::vector{std::nan("")}); }), error);
}

// The early decision on large changes has its own share of the level.
TEST(StageLevel, IsSpentInWhole) {
    EXPECT_DOUBLE_EQ(stageLevel(0.05) * (std::size(kStages) + 1), 0.05);
}

}  // namespace
}  // namespace benchmarks::report
