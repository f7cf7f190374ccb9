#include "hair/groom/build_groom.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

using testing::Each;
using testing::ElementsAre;

// An L of 1 down and 3 across, with its corner between the ends.
StrandSet bend() {
    StrandSet strands;
    strands.ends = {3};
    strands.points = {{0, 1, 0}, {0, 0, 0}, {3, 0, 0}};
    return strands;
}

TEST(Resample, SpacesPointsEvenlyByArcLength) {
    EXPECT_THAT(
        resample(bend(), 5).points, ElementsAre(
                                        glm::vec3(0, 1, 0), glm::vec3(0, 0, 0), glm::vec3(1, 0, 0),
                                        glm::vec3(2, 0, 0), glm::vec3(3, 0, 0)));
    EXPECT_THAT(resample(bend(), 2).points, ElementsAre(glm::vec3(0, 1, 0), glm::vec3(3, 0, 0)));
}

TEST(Resample, InterpolatesWhatPointsHave) {
    StrandSet strands = bend();
    strands.widths.values = {8, 4, 1};
    strands.transparencies.values = {0, 1, 0.25f};
    strands.colors.everywhere = glm::vec3(0.5f);
    strands.root_uvs = {{0.1f, 0.2f}};
    strands.root_triangles = {{0, 0, 0}};
    strands.metres_per_unit = 0.01;
    strands.comment = "a bend";
    const StrandSet even = resample(std::move(strands), 5);
    EXPECT_THAT(even.ends, ElementsAre(5));
    EXPECT_THAT(even.widths.values, ElementsAre(8, 4, 3, 2, 1));
    EXPECT_THAT(even.transparencies.values, ElementsAre(0, 1, 0.75f, 0.5f, 0.25f));
    EXPECT_EQ(even.colors.everywhere, glm::vec3(0.5f));
    EXPECT_TRUE(even.colors.values.empty());
    EXPECT_EQ(even.root_uvs.size(), 1u);
    EXPECT_EQ(even.root_triangles.size(), 1u);
    EXPECT_EQ(even.metres_per_unit, 0.01);
    EXPECT_EQ(even.comment, "a bend");
}

TEST(Resample, InterpolatesColors) {
    StrandSet strands = bend();
    strands.colors.values = {{0, 0, 1}, {0, 0, 1}, {0.75f, 0.375f, 0.25f}};
    EXPECT_EQ(resample(std::move(strands), 5).colors.values[2], glm::vec3(0.25f, 0.125f, 0.75f));
}

TEST(Resample, StaysOnACircle) {
    constexpr std::uint32_t many = 2001;
    StrandSet strands;
    strands.ends = {many};
    for (std::uint32_t i = 0; i < many; ++i) {  // unevenly: dense at the root
        const double angle = std::numbers::pi * std::pow(i / (many - 1.0), 2.0);
        strands.points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    const StrandSet even = resample(std::move(strands), 10);
    for (std::uint32_t k = 0; k < 10; ++k) {
        const double angle = std::numbers::pi * k / 9.0;
        const glm::vec3 expected(std::cos(angle), std::sin(angle), 0.0);
        // Chords of at most 2 pi / 2000 deviate by an eighth of their square, and are shorter than
        // their arcs by a 24th of their square, over a length of pi.
        EXPECT_LT(glm::distance(even.points[k], expected), 4e-6) << k;
    }
}

TEST(Resample, KeepsEndsToTheBit) {
    StrandSet strands;
    strands.points = {{0.1f, 1e-30f, -7.7f}, {123.456f, 0.3f, 0.7f}, {1.0f / 3, -0.0f, 1e20f}};
    strands.ends = {3};
    strands.widths.values = {0.1f, 0.2f, 0.3f};
    const StrandSet even = resample(strands, 7);
    EXPECT_EQ(even.points.front(), strands.points.front());
    EXPECT_EQ(even.points.back(), strands.points.back());
    EXPECT_TRUE(std::signbit(even.points.back().y));
    EXPECT_EQ(even.widths.values.front(), 0.1f);
    EXPECT_EQ(even.widths.values.back(), 0.3f);
}

TEST(Resample, KeepsStrandsThatHaveSoManyAlready) {
    StrandSet strands;
    strands.ends = {3, 5};
    strands.points = {{0, 0, 0}, {1, 0, 0}, {9, 0, 0}, {0, 1, 0}, {2, 1, 0}};
    EXPECT_THAT(
        resample(strands, 3).points,
        ElementsAre(
            glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(9, 0, 0), glm::vec3(0, 1, 0),
            glm::vec3(1, 1, 0), glm::vec3(2, 1, 0)));
}

TEST(Resample, MovesWhereNothingChanges) {
    StrandSet strands = bend();
    strands.widths.values = {1, 2, 3};
    const auto* points = strands.points.data();
    const auto* widths = strands.widths.values.data();
    strands = resample(std::move(strands), 3);
    EXPECT_EQ(strands.points.data(), points);
    const Groom groom = toGroom(std::move(strands), 0);
    EXPECT_EQ(groom.points.data(), points);
    EXPECT_EQ(groom.widths.data(), widths);
}

TEST(Resample, LeavesStrandsWithoutLengthInPlace) {
    StrandSet strands;
    strands.ends = {1, 4};
    strands.points = {{1, 2, 3}, {4, 5, 6}, {4, 5, 6}, {4, 5, 6}};
    strands.widths.values = {7, 1, 2, 3};
    const StrandSet even = resample(std::move(strands), 5);
    EXPECT_THAT(even.ends, ElementsAre(5, 10));
    EXPECT_THAT(
        std::vector(even.points.begin(), even.points.begin() + 5), Each(glm::vec3(1, 2, 3)));
    EXPECT_THAT(std::vector(even.points.begin() + 5, even.points.end()), Each(glm::vec3(4, 5, 6)));
    EXPECT_THAT(even.widths.values, ElementsAre(7, 7, 7, 7, 7, 1, 1.5f, 2, 2.5f, 3));
}

TEST(Resample, PassesSegmentsWithoutLength) {
    StrandSet strands;
    strands.ends = {5};
    strands.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_THAT(
        resample(std::move(strands), 3).points,
        ElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(2, 0, 0)));
}

TEST(Resample, TakesNoStrands) { EXPECT_TRUE(resample({}, 4).points.empty()); }

TEST(ToGroom, TakesTheLongestListWithinLimits) {
    StrandSet strands = bend();
    strands.ends = {1, 3};
    EXPECT_EQ(toGroom(strands, 0).vertices_per_strand, 2u);
    EXPECT_EQ(toGroom(strands, 9).vertices_per_strand, 9u);
    EXPECT_EQ(toGroom(strands, 9).points.size(), 18u);
    strands.ends = {1, 2, 3};
    EXPECT_EQ(toGroom(strands, 0).vertices_per_strand, 2u);
    StrandSet longest;
    longest.ends = {1000};
    longest.points.resize(1000);
    EXPECT_EQ(toGroom(longest, 0).vertices_per_strand, 256u);
    EXPECT_EQ(toGroom(longest, 1000).vertices_per_strand, 1000u);
}

TEST(ToGroom, FillsInOneWidthForAll) {
    StrandSet strands = bend();
    strands.widths.everywhere = 1e-4f;
    EXPECT_EQ(toGroom(strands, 4).widths, std::vector<float>(4, 1e-4f));
    strands.widths = {};
    EXPECT_TRUE(toGroom(strands, 4).widths.empty());
}

TEST(ToGroom, RefusesNoStrands) {
    EXPECT_EQ(errorText([] { toGroom({}, 4); }), "there are no strands");
}

TEST(Resample, RefusesMorePointsThanThereAreNumbersFor) {
    StrandSet strands = bend();
    strands.ends = {1, 3};
    EXPECT_EQ(
        errorText([&] { resample(strands, 1u << 31); }),
        "2 strands of 2147483648 points: more than 2^32 - 1 points in all");
}

TEST(ToGroom, KeepsStrandsOfAsManyVerticesAsTheyAre) {
    Groom groom{.strand_count = 2, .vertices_per_strand = 2};
    groom.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
    groom.widths = {1, 2, 3, 4};
    groom.root_triangles = {{0, 1, 1}};
    const Groom again = toGroom(strandsOf(groom), 2);
    EXPECT_EQ(again.strand_count, 2u);
    EXPECT_EQ(again.points, groom.points);
    EXPECT_EQ(again.widths, groom.widths);
    EXPECT_EQ(again.root_triangles, groom.root_triangles);
}

}  // namespace
}  // namespace hair::groom
