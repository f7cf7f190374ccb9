#include "tests/largest_difference.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Sides of 2, 3 and 6 have a diagonal of 7. Sides of 3 and 4 have one of 5.
TEST(LargestDifference, IsTheLargestOfNumbersAndOfVectors) {
    EXPECT_EQ(largestDifference(std::vector{1.0f, 2.0f, 3.0f}, std::array{1.5, -1.0, 3.0}), 3.0);
    const std::vector<glm::vec3> a{{1, 1, 1}, {0, 0, 0}, {5, 5, 5}};
    const std::vector<glm::dvec3> b{{1, 1, 1}, {2, -3, 6}, {5, 5, 6}};
    EXPECT_EQ(largestDifference(a, b), 7.0);
    EXPECT_EQ(largestDifference(std::span(b), a), 7.0);
    EXPECT_EQ(largestDifference(a, a), 0.0);
    EXPECT_EQ(
        largestDifference(std::array{glm::vec4(0, 0, 0, 3)}, std::array{glm::dvec4(4, 0, 0, 0)}),
        5.0);
}

// Compares float points in double precision: a float 1 + 1 would lose 2^-24.
TEST(LargestDifference, IsOfDoublePrecision) {
    EXPECT_EQ(
        largestDifference(
            std::array{glm::vec3(2, 0, 0)}, std::array{glm::dvec3(2 + 0x1p-40, 0, 0)}),
        0x1p-40);
}

TEST(LargestDifference, IsNotANumberWhereAnythingIsNotFinite) {
    for (const float bad : {kNan, kInfinity, -kInfinity})
        for (std::size_t at = 0; at < 3; ++at)
            for (int component = 0; component < 3; ++component) {
                const std::vector<glm::vec3> good{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
                auto broken = good;
                broken[at][component] = bad;
                EXPECT_TRUE(std::isnan(largestDifference(broken, good)));
                EXPECT_TRUE(std::isnan(largestDifference(good, broken)));
                EXPECT_TRUE(std::isnan(largestDifference(broken, broken)));
                EXPECT_FALSE(largestDifference(broken, good) < 1e30);  // as in EXPECT_LT
            }
    EXPECT_TRUE(std::isnan(largestDifference(std::array{0.0, 1.0}, std::array{double{kNan}, 9.0})));
}

TEST(LargestDifference, RefusesOtherLengthsAndNothing) {
    const std::vector<double> none;
    const std::vector<double> two(2);
    const std::vector<double> three(3);
    EXPECT_THAT(
        [&] { largestDifference(two, three); },
        ThrowsMessage<std::invalid_argument>(HasSubstr("2 values with 3")));
    EXPECT_THAT(
        [&] { largestDifference(three, none); },
        ThrowsMessage<std::invalid_argument>(HasSubstr("3 values with 0")));
    EXPECT_THAT(
        [&] { largestDifference(none, none); },
        ThrowsMessage<std::invalid_argument>(HasSubstr("no values")));
}

TEST(Extremes, AreTheLeastAndTheGreatest) {
    Extremes extremes;
    for (const double value : {-3.0, -1.0, -2.0}) extremes.add(value);
    EXPECT_EQ(extremes.least(), -3.0);
    EXPECT_EQ(extremes.greatest(), -1.0);
}

TEST(Extremes, StayNotANumberOnceAValueWasNotFinite) {
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        Extremes extremes;
        for (const double value : {1.0, double{bad}, 2.0}) extremes.add(value);
        EXPECT_TRUE(std::isnan(extremes.least()));
        EXPECT_TRUE(std::isnan(extremes.greatest()));
    }
}

TEST(Extremes, AreThereOnlyOfSomething) {
    const Extremes none;
    EXPECT_THROW(none.least(), std::logic_error);
    EXPECT_THROW(none.greatest(), std::logic_error);
}

}  // namespace
