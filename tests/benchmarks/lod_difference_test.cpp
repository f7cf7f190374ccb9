#include "benchmarks/lod/walk.h"

#include <cmath>

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

const lod::Picture kBlack{0, 0, 0, 255, 0, 0, 0, 255};
const lod::Picture kHalfWhite{255, 255, 255, 255, 0, 0, 0, 255};

TEST(LodDifference, IsTheRootMeanSquareOfColorsAndNotOfAlpha) {
    EXPECT_EQ(lod::rootMeanSquare(kBlack, kBlack), 0.0);
    EXPECT_DOUBLE_EQ(lod::rootMeanSquare(kBlack, kHalfWhite), std::sqrt(0.5));
    // One of six values differs, by 51 / 255.
    EXPECT_DOUBLE_EQ(
        lod::rootMeanSquare(kBlack, lod::Picture{0, 51, 0, 0, 0, 0, 0, 0}), 0.2 / std::sqrt(6.0));
}

TEST(LodDifference, PoppingIsWhatFullDetailDoesNotDo) {
    EXPECT_EQ(lod::popping(kBlack, kHalfWhite, kBlack, kHalfWhite), 0.0);
    EXPECT_DOUBLE_EQ(lod::popping(kBlack, kHalfWhite, kBlack, kBlack), std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(lod::popping(kBlack, kBlack, kBlack, kHalfWhite), std::sqrt(0.5));
    // Opposite changes add up to twice the difference.
    EXPECT_DOUBLE_EQ(lod::popping(kBlack, kHalfWhite, kHalfWhite, kBlack), 2.0 * std::sqrt(0.5));
}

TEST(LodDifference, ShimmerIsTheMeanOfWhatFullDetailDoesNotDo) {
    EXPECT_EQ(lod::shimmerBetween(kBlack, kHalfWhite, kBlack, kHalfWhite), 0.0);
    EXPECT_DOUBLE_EQ(lod::shimmerBetween(kBlack, kHalfWhite, kBlack, kBlack), 0.5);
    EXPECT_DOUBLE_EQ(lod::shimmerBetween(kBlack, kHalfWhite, kHalfWhite, kBlack), 1.0);
    // One of six values differs, by 51 / 255.
    EXPECT_DOUBLE_EQ(
        lod::shimmerBetween(kBlack, lod::Picture{0, 51, 0, 0, 0, 0, 0, 0}, kBlack, kBlack),
        0.2 / 6.0);
}

TEST(LodDifference, WhiteShareIsTheMean) {
    EXPECT_EQ(lod::whiteShare(kBlack), 0.0);
    EXPECT_EQ(lod::whiteShare(kHalfWhite), 0.5);
}

}  // namespace
}  // namespace benchmarks
