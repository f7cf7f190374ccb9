#include "hair/groom/guides/choose_guides.h"

#include <algorithm>
#include <numeric>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/random.h"
#include "tests/error_text.h"
#include "tests/groom/style/sample_strands.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;

constexpr std::uint32_t kSide = 41;

// Upright, from a square lattice on the unit square.
Groom lattice() {
    return sampleGroom(kSide * kSide, 3, [](std::uint32_t strand, double t) {
        return glm::dvec3(strand % kSide, 0.3 * t * (kSide - 1), strand / kSide) / (kSide - 1.0);
    });
}

TEST(ChooseGuides, GivesIndicesInOrderAndOnce) {
    const auto chosen = chooseGuides(lattice(), 200, 5);
    EXPECT_EQ(chosen.size(), 200u);
    EXPECT_TRUE(std::ranges::is_sorted(chosen));
    EXPECT_EQ(std::ranges::adjacent_find(chosen), chosen.end());
    EXPECT_LT(chosen.back(), kSide * kSide);
    EXPECT_EQ(chooseGuides(lattice(), 200, 5), chosen);
}

// The farthest-point traversal covers within twice the best radius (Gonzalez 1985), and a lattice
// of 8 x 8 cells covers the square within half of a cell's diagonal.
TEST(ChooseGuides, CoversRoots) {
    const Groom dense = lattice();
    const auto chosen = chooseGuides(dense, 64, 1);
    for (std::uint32_t i = 0; i < dense.strand_count; ++i) {
        Extremes distances;
        for (const std::uint32_t guide : chosen)
            distances.add(double{glm::distance(dense.strand(i)[0], dense.strand(guide)[0])});
        EXPECT_LE(distances.least(), 2.0 * std::sqrt(0.5) / 8.0);
    }
}

// The point of a square farthest from any point in it is a corner, and the point farthest from
// some corners is another corner.
TEST(ChooseGuides, TakesTheCorners) {
    for (std::uint32_t seed = 0; seed < 5; ++seed)
        EXPECT_THAT(
            chooseGuides(lattice(), 4, seed),
            ElementsAre(0, kSide - 1, kSide * (kSide - 1), kSide * kSide - 1));
}

TEST(ChooseGuides, TakesStrandsWithoutLengthLast) {
    const Groom dense = sampleGroom(100, 5, [](std::uint32_t strand, double t) {
        return glm::dvec3(0.01 * strand, strand % 10 == 3 ? 0.0 : 0.1 * t, 0);
    });
    for (const std::uint32_t guide : chooseGuides(dense, 90, 1)) EXPECT_NE(guide % 10, 3u);
    EXPECT_EQ(chooseGuides(dense, 91, 1).size(), 91u);
    const Groom points =
        sampleGroom(9, 2, [](std::uint32_t strand, double) { return glm::dvec3(strand, 0, 0); });
    EXPECT_EQ(chooseGuides(points, 3, 1).size(), 3u);
}

TEST(ChooseGuides, TellsStrandsWithTheSameRootApart) {
    const Groom dense = sampleGroom(100, 5, [](std::uint32_t strand, double t) {
        return strand == 42 ? glm::dvec3(0.1 * t, 0, 0) : glm::dvec3(0, 0.1 * t, 0);
    });
    for (std::uint32_t seed = 0; seed < 5; ++seed)
        EXPECT_THAT(chooseGuides(dense, 2, seed), testing::Contains(42));
}

// A metre between shapes counts as much as a metre between roots. The first choice is a distant
// strand. The second is the one farthest off the rest: by 0.3 m in shape, or by less or more at its
// root.
TEST(ChooseGuides, WeighsShapesAsRoots) {
    const auto chosen = [](double away) {
        const Groom dense = sampleGroom(4, 5, [away](std::uint32_t strand, double t) {
            const glm::dvec3 root(strand == 2 ? away : 0.0, 0.0, strand == 0 ? 10.0 : 0.0);
            const double off = strand == 1 && t > 0.0 ? 0.3 : 0.0;
            return root + glm::dvec3(0.0, 0.1 * t + off, 0.0);
        });
        return chooseGuides(dense, 2, 1);
    };
    EXPECT_THAT(chosen(0.2), ElementsAre(0, 1));
    EXPECT_THAT(chosen(0.4), ElementsAre(0, 2));
}

TEST(ChooseGuides, TakesRepeatedStrandsLast) {
    const Groom dense = sampleGroom(
        50, 4, [](std::uint32_t strand, double t) { return glm::dvec3(strand % 5, t, 0.0); });
    auto chosen = chooseGuides(dense, 5, 2);
    for (std::uint32_t& strand : chosen) strand %= 5;
    std::ranges::sort(chosen);
    EXPECT_THAT(chosen, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_EQ(chooseGuides(dense, 23, 2).size(), 23u);
}

// The mean of each half is the same for all; only the vertices differ.
TEST(ChooseGuides, TakesWhatOnlyItsVerticesTellApart) {
    const Groom dense = sampleGroom(8, 9, [](std::uint32_t strand, double t) {
        const int vertex = static_cast<int>(8.0 * t);
        const double side = vertex == 0 ? 0.0 : vertex % 2 == 0 ? 0.125 : -0.125;
        return glm::dvec3(strand == 6 ? -side : side, t, 0.0);
    });
    EXPECT_THAT(chooseGuides(dense, 2, 1), testing::Contains(6));
}

TEST(ChooseGuides, TakesAllOrNone) {
    const Groom dense = awkwardStrands();
    EXPECT_THAT(chooseGuides(dense, 4, 9), ElementsAre(0, 1, 2, 3));
    EXPECT_TRUE(chooseGuides(dense, 0, 9).empty());
    EXPECT_EQ(
        errorText([&] { chooseGuides(dense, 5, 9); }),
        "there are 4 strands to choose 5 guides from");
}

TEST(PickStrands, TakesWhatStrandsHave) {
    Groom dense = withNormals(verticalStrands(4, 2, 1.0, 1.0), {0, 1, 0});
    dense.root_normals[2] = {1, 0, 0};
    dense.widths = {0, 1, 2, 3, 4, 5, 6, 7};
    dense.root_triangles = {{0, 1, 2}};
    dense.bindings.resize(4);
    const Groom picked = pickStrands(dense, {1, 2});
    EXPECT_EQ(picked.strand_count, 2u);
    EXPECT_EQ(picked.vertices_per_strand, 2u);
    EXPECT_THAT(
        picked.points,
        ElementsAre(
            glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(2, 0, 0), glm::vec3(2, 1, 0)));
    EXPECT_THAT(picked.root_normals, ElementsAre(glm::vec3(0, 1, 0), glm::vec3(1, 0, 0)));
    EXPECT_THAT(picked.widths, ElementsAre(2, 3, 4, 5));
    EXPECT_TRUE(picked.root_triangles.empty());
    EXPECT_TRUE(picked.bindings.empty());
    EXPECT_TRUE(pickStrands(verticalStrands(4, 2, 1.0, 1.0), {3}).widths.empty());
}

}  // namespace
}  // namespace hair::groom
