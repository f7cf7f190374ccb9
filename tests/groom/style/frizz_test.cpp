#include "hair/groom/style/style.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

constexpr FrizzSettings kFrizz{.amplitude = 0.01f, .frequency = 60.0f, .start = 0.0f};

TEST(Frizz, MovesNoPointFurtherThanItsAmplitudeAndNoRoot) {
    const Groom before = verticalStrands(1000, 64, 0.2, 0.001);
    const Groom after = frizz(before, kFrizz, 1);
    const double greatest = largestDifference(after.points, before.points);
    EXPECT_LE(greatest, 0.01 + kRounding);
    EXPECT_GT(greatest, 0.009);  // some of 12,000 random vectors are near the limit
    for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_EQ(after.strand(i)[0], before.strand(i)[0]);
}

// Between two random vectors of the ball, 1/60 m apart, the noise moves at most by the ball's
// diameter, with smoothstep's greatest slope, 3/2.
TEST(Frizz, IsSmoothAlongTheStrand) {
    constexpr std::uint32_t kVertices = 4001;
    const Groom before = verticalStrands(1, kVertices, 0.2, 0.0);
    const Groom after = frizz(before, kFrizz, 1);
    const double limit = 0.01 * 2.0 * 1.5 * 60.0 * (0.2 / (kVertices - 1)) + 2.0 * kRounding;
    for (std::size_t i = 1; i + 1 < kVertices; ++i) {
        const glm::dvec3 here = glm::dvec3(after.points[i]) - glm::dvec3(before.points[i]);
        const glm::dvec3 next = glm::dvec3(after.points[i + 1]) - glm::dvec3(before.points[i + 1]);
        EXPECT_LE(glm::distance(here, next), limit) << i;
    }
}

// Displacements of different strands, and those further apart on a strand than the noise reaches,
// are independent: their products average to 0. The mean of u.v over N pairs of vectors at most 1
// long has a standard error below 1 / sqrt(3 N).
TEST(Frizz, IsDifferentForEveryStrand) {
    constexpr std::uint32_t kStrands = 4000;
    const Groom before = verticalStrands(kStrands, 13, 0.2, 0.0);
    const Groom after = frizz(before, kFrizz, 1);
    const auto unit = [&](std::uint32_t strand, std::uint32_t vertex) {
        return (glm::dvec3(after.strand(strand)[vertex]) -
                glm::dvec3(before.strand(strand)[vertex])) /
               0.01;
    };
    double neighbours = 0.0;
    double along = 0.0;
    glm::dvec3 mean(0.0);
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        neighbours += glm::dot(unit(i, 7), unit((i + 1) % kStrands, 7)) / kStrands;
        along += glm::dot(unit(i, 3), unit(i, 9)) / kStrands;
        mean += unit(i, 5) / double(kStrands);
    }
    const double limit = 4.0 / std::sqrt(3.0 * kStrands);
    EXPECT_NEAR(neighbours, 0.0, limit);
    EXPECT_NEAR(along, 0.0, limit);
    EXPECT_NEAR(glm::length(mean), 0.0, limit);
}

TEST(Frizz, DependsOnTheSeedAlone) {
    const Groom before = verticalStrands(3, 9, 0.2, 0.1);
    EXPECT_EQ(frizz(before, kFrizz, 3).points, frizz(before, kFrizz, 3).points);
    EXPECT_NE(frizz(before, kFrizz, 3).points, frizz(before, kFrizz, 4).points);
}

TEST(Frizz, TakesStrandsLongerThanItsNoiseCanCount) {
    Groom groom = verticalStrands(1, 3, 0.2, 0.0);
    for (glm::vec3& point : groom.points) point *= 1e38f;
    EXPECT_TRUE(allFinite(frizz(groom, {.amplitude = 1.0f, .frequency = 10000.0f}, 1)));
}

// A tenth of 2000 strands departs from its path, within `reach`, and not before `start`.
TEST(Flyaways, AreAShareOfTheStrands) {
    const FlyawaySettings settings{.share = 0.1f, .reach = 0.02f, .start = 0.5f};
    const Groom before = verticalStrands(2000, 9, 0.2, 0.0001);
    const Groom after = flyaways(before, settings, 1);
    int apart = 0;
    for (std::uint32_t strand = 0; strand < 2000; ++strand) {
        for (std::uint32_t i = 0; i <= 4; ++i)
            ASSERT_EQ(after.strand(strand)[i], before.strand(strand)[i]);
        for (std::uint32_t i = 5; i < 9; ++i)
            ASSERT_LE(
                glm::distance(after.strand(strand)[i], before.strand(strand)[i]), 0.02 + kRounding);
        apart += after.strand(strand).back() != before.strand(strand).back() ? 1 : 0;
    }
    // Binomial: 200, four standard deviations of 13.4.
    EXPECT_NEAR(apart, 200, 54);
    EXPECT_EQ(flyaways(before, {}, 1).points, before.points);
}

}  // namespace
}  // namespace hair::groom
