#include "hair/groom/style/style.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/groom/style/sample_strand_set.h"
#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

TEST(Followers, ComeAfterTheirStrandWithAllThatItHas) {
    const StrandSet before = sampleStrandSet();
    const StrandSet after = addFollowers(before, 2, 0.1f, 1.0f, 1);
    EXPECT_EQ(after.ends, (std::vector<std::uint32_t>{2, 4, 6, 9, 12, 15, 16, 17, 18}));
    for (std::uint32_t i = 0; i < 9; ++i) {
        EXPECT_EQ(after.root_uvs[i], before.root_uvs[i / 3]);
        for (std::uint32_t k = 0; k < after.size(i); ++k) {
            EXPECT_EQ(
                after.widths.values[after.first(i) + k],
                before.widths.values[before.first(i / 3) + k]);
            if (i % 3 == 0)
                EXPECT_EQ(after.strand(i)[k], before.strand(i / 3)[k]);
            else
                EXPECT_NE(after.strand(i)[k], before.strand(i / 3)[k]);
        }
    }
    EXPECT_EQ(after.root_triangles.front(), (std::array<std::uint32_t, 3>{0, 3, 6}));
}

// The followers spread by a factor from 1 at the root to 3 at the tip, in a disc across the first
// segment.
TEST(Followers, KeepToTheDiscAndSpreadTowardsTheTip) {
    StrandSet strand;
    strand.ends = {3};
    strand.points = {{0, 0, 0}, {0, 0.1f, 0}, {0.1f, 0.1f, 0}};
    const StrandSet after = addFollowers(strand, 4000, 0.02f, 3.0f, 1);
    double mean_square = 0.0;
    glm::dvec3 mean(0.0);
    for (std::uint32_t i = 1; i < after.strandCount(); ++i) {
        const auto offset = [&](std::size_t k) {
            return glm::dvec3(after.strand(i)[k]) - glm::dvec3(strand.points[k]);
        };
        EXPECT_NEAR(offset(0).y, 0.0, kRounding);
        EXPECT_LE(glm::length(offset(0)), 0.02 + kRounding);
        EXPECT_NEAR(glm::distance(offset(1), 2.0 * offset(0)), 0.0, kRounding);
        EXPECT_NEAR(glm::distance(offset(2), 3.0 * offset(0)), 0.0, kRounding);
        mean_square += glm::dot(offset(0), offset(0)) / 4000.0;
        mean += offset(0) / 4000.0;
    }
    // Uniform in the disc's area: r^2 is uniform in [0, R^2]; each coordinate's variance is R^2/4.
    EXPECT_NEAR(mean_square, 0.5 * 0.0004, 4.0 * 0.0004 / std::sqrt(12.0 * 4000.0));
    EXPECT_NEAR(glm::length(mean), 0.0, 4.0 * 0.02 / std::sqrt(2.0 * 4000.0));
}

TEST(Followers, OfNoneAreTheStrandsAsTheyWere) {
    const StrandSet before = sampleStrandSet();
    const StrandSet after = addFollowers(before, 0, 1.0f, 2.0f, 1);
    EXPECT_EQ(after.points, before.points);
    EXPECT_EQ(after.root_triangles, before.root_triangles);
}

TEST(Followers, DependOnTheSeedAlone) {
    const StrandSet before = sampleStrandSet();
    const auto points = [&](std::uint32_t seed) {
        return addFollowers(before, 2, 0.1f, 1.0f, seed).points;
    };
    EXPECT_EQ(points(3), points(3));
    EXPECT_NE(points(3), points(4));
}

TEST(Followers, OfStrandsWithoutLengthAreFinite) {
    StrandSet strands;
    strands.ends = {1, 3};
    strands.points = {{1, 1, 1}, {2, 2, 2}, {2, 2, 2}};
    for (const glm::vec3& point : addFollowers(strands, 5, 0.1f, 2.0f, 1).points)
        EXPECT_LT(glm::length(point), 4.0f);
}

TEST(Followers, AreNotMadeWhereTheyAreTooMany) {
    const auto add = [] { addFollowers(sampleStrandSet(), 0xffff'ffffu, 0.1f, 1.0f, 1); };
    EXPECT_THAT(errorText(add), testing::HasSubstr("more than 2^32 - 1"));
}

// A follower belongs to its strand's group, and guides nothing.
TEST(AddFollowers, AreInTheGroupAndNoGuides) {
    const StrandSet after = addFollowers(sampleStrandSet(), 1, 0.1f, 1.0f, 1);
    EXPECT_EQ(after.groups, (std::vector<std::int32_t>{4, 4, -5, -5, 6, 6}));
    EXPECT_EQ(after.guides, (std::vector<std::uint8_t>{1, 0, 0, 0, 1, 0}));
}

}  // namespace
}  // namespace hair::groom
