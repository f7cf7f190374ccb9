#include "hair/groom/style/style.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

constexpr std::uint32_t kSeed = 1;

TEST(Cut, LeavesSoMuchLengthEvenly) {
    const Groom after = cut(verticalStrands(1, 8, 0.3, 0.0), {.length = 0.21f}, kSeed);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(after.points[i].y, 0.21 * static_cast<double>(i) / 7.0, kRounding) << i;
}

TEST(Cut, LeavesShorterStrandsToTheBit) {
    const Groom before = verticalStrands(1, 8, 0.3, 0.0);
    EXPECT_EQ(cut(before, {.length = 0.31f}, kSeed).points, before.points);
    const CutSettings above{.point = {0.0f, 0.4f, 0.0f}, .normal = {0.0f, 1.0f, 0.0f}};
    EXPECT_EQ(cut(before, above, kSeed).points, before.points);
}

// A right-angled strand, 0.1 m up and 0.1 m to the right, is cut at 0.15 m. The new points are on
// the old lines.
TEST(Cut, KeepsToTheOldLine) {
    Groom before{.strand_count = 1, .vertices_per_strand = 3};
    before.points = {{0, 0, 0}, {0, 0.1f, 0}, {0.1f, 0.1f, 0}};
    before.widths = {4.0f, 3.0f, 1.0f};
    const Groom after = cut(before, {.length = 0.15f}, kSeed);
    EXPECT_NEAR(glm::distance(after.points[1], glm::vec3(0.0f, 0.075f, 0.0f)), 0.0, kRounding);
    EXPECT_NEAR(glm::distance(after.points[2], glm::vec3(0.05f, 0.1f, 0.0f)), 0.0, kRounding);
    EXPECT_NEAR(after.widths[1], 3.25, 1e-6);
    EXPECT_NEAR(after.widths[2], 2.0, 1e-6);
}

// The plane goes through (0, 0.1, 0) at 45 degrees; a strand at x ends at y = 0.1 - x. The length
// of the normal has no effect.
TEST(Cut, EndsAtThePlane) {
    const CutSettings settings{.point = {0.0f, 0.1f, 0.0f}, .normal = {0.5f, 0.5f, 0.0f}};
    const Groom after = cut(verticalStrands(4, 8, 0.3, 0.02), settings, kSeed);
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(after.strand(i)[7].y, 0.1 - 0.02 * i, kRounding);
        EXPECT_NEAR(after.strand(i)[1].y, (0.1 - 0.02 * i) / 7.0, kRounding);
    }
}

// The strand goes up through the plane and down again. Only the first part is left.
TEST(Cut, EndsWhereAStrandFirstPassesThePlane) {
    Groom before{.strand_count = 1, .vertices_per_strand = 4};
    before.points = {{0, 0, 0}, {0, 0.2f, 0}, {0.1f, 0.2f, 0}, {0.1f, 0, 0}};
    const CutSettings settings{.point = {0.0f, 0.15f, 0.0f}, .normal = {0.0f, 1.0f, 0.0f}};
    const Groom after = cut(before, settings, kSeed);
    EXPECT_NEAR(glm::distance(after.points[3], glm::vec3(0.0f, 0.15f, 0.0f)), 0.0, kRounding);
}

TEST(Cut, TakesTheShorterOfLengthAndPlane) {
    CutSettings settings{
        .length = 0.05f, .point = {0.0f, 0.1f, 0.0f}, .normal = {0.0f, 1.0f, 0.0f}};
    const Groom before = verticalStrands(1, 8, 0.3, 0.0);
    EXPECT_NEAR(cut(before, settings, kSeed).points[7].y, 0.05, kRounding);
    settings.length = 0.2f;
    EXPECT_NEAR(cut(before, settings, kSeed).points[7].y, 0.1, kRounding);
}

TEST(Cut, LeavesAThousandthOfAStrandWhoseRootIsBeyondThePlane) {
    const CutSettings settings{.point = {0.0f, -0.1f, 0.0f}, .normal = {0.0f, 1.0f, 0.0f}};
    EXPECT_NEAR(cut(verticalStrands(1, 8, 0.3, 0.0), settings, kSeed).points[7].y, 0.0003, 1e-9);
    EXPECT_NEAR(
        cut(verticalStrands(1, 8, 0.3, 0.0), {.length = 1e-6f}, kSeed).points[7].y, 0.0003, 1e-9);
}

// Lengths are uniform from 0.06 to 0.1 m: their mean is within three standard errors of the middle,
// 0.04 / sqrt(12 * 1000) m each, and a tenth of them is in each tenth, within four of sqrt(90).
TEST(Cut, VariesTheLengthsOfCutStrands) {
    constexpr std::uint32_t kStrands = 1000;
    const CutSettings settings{
        .point = {0.0f, 0.1f, 0.0f}, .normal = {0.0f, 1.0f, 0.0f}, .variation = 0.04f};
    const Groom after = cut(verticalStrands(kStrands, 8, 0.3, 0.02), settings, kSeed);
    std::array<int, 10> tenths{};
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        const double length = after.strand(i)[7].y;
        ASSERT_GE(length, 0.06 - kRounding);
        ASSERT_LE(length, 0.1 + kRounding);
        sum += length;
        ++tenths[static_cast<std::size_t>(std::clamp((length - 0.06) / 0.004, 0.0, 9.0))];
    }
    EXPECT_NEAR(sum / kStrands, 0.08, 3 * 0.04 / std::sqrt(12.0 * kStrands));
    for (const int count : tenths) EXPECT_NEAR(count, 100, 4 * std::sqrt(90.0));
    const CutSettings beyond{
        .point = {0.0f, 0.4f, 0.0f}, .normal = {0.0f, 1.0f, 0.0f}, .variation = 0.04f};
    const Groom before = verticalStrands(1, 8, 0.3, 0.0);
    EXPECT_EQ(cut(before, beyond, kSeed).points, before.points);
}

}  // namespace
}  // namespace hair::groom
