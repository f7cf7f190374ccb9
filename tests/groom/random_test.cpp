#include "hair/random.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace hair::groom {
namespace {

// The published formula worked out in integers of unlimited size.
TEST(Random, PcgGivesTheValuesOfItsFormula) {
    EXPECT_EQ(pcg(0u), 129708002u);
    EXPECT_EQ(pcg(1u), 2831084092u);
    EXPECT_EQ(pcg(2u), 2055130248u);
    EXPECT_EQ(pcg(0xffffffffu), 3861530882u);
}

TEST(Random, StaysBelowOne) {
    for (std::uint32_t i = 0; i < 100000; ++i) {
        ASSERT_GE(random01(1, i, 2), 0.0f);
        ASSERT_LT(random01(1, i, 2), 1.0f);
    }
    EXPECT_LT(static_cast<float>(0xffffffffu >> 8u) * 0x1p-24f, 1.0f);
}

// Chi-square with 15 degrees of freedom exceeds 44 once in 10^4 times; the test tries three
// arguments.
TEST(Random, IsUniformAlongEveryArgument) {
    constexpr std::uint32_t count = 160000;
    for (int argument = 0; argument < 3; ++argument) {
        std::array<double, 16> bins{};
        for (std::uint32_t i = 0; i < count; ++i) {
            const float value = argument == 0   ? random01(i, 7, 7)
                                : argument == 1 ? random01(7, i, 7)
                                                : random01(7, 7, i);
            bins[static_cast<std::size_t>(value * 16.0f)] += 1.0;
        }
        double chi_square = 0.0;
        for (const double bin : bins) chi_square += (bin - 10000.0) * (bin - 10000.0) / 10000.0;
        EXPECT_LT(chi_square, 44.0) << "argument " << argument;
    }
}

// The correlation of n independent pairs has the standard deviation 1 / sqrt(n); the test allows
// five.
TEST(Random, PurposesAreUncorrelated) {
    constexpr std::uint32_t count = 100000;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        sum += (random01(1, i, 1) - 0.5) * (random01(1, i, 2) - 0.5);
    }
    EXPECT_LT(std::abs(12.0 * sum / count), 5.0 / 316.0);
}

}  // namespace
}  // namespace hair::groom
