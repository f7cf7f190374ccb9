#include "hair/groom/style/style.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/random.h"
#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

// Roots at random in a square of 1 m, straight up.
Groom lawn(std::uint32_t strands) {
    return sampleGroom(strands, 5, [](std::uint32_t strand, double t) {
        return glm::dvec3(
            random01(99, strand, 1), 0.2 * t * (1.0 + random01(99, strand, 3)),
            random01(99, strand, 2));
    });
}

// Only strands that haven't moved count, because the tips of the others are elsewhere.
std::vector<std::uint32_t> unmoved(const Groom& after, const Groom& before) {
    std::vector<std::uint32_t> strands;
    for (std::uint32_t i = 0; i < after.strand_count; ++i)
        if (after.strand(i).back() == before.strand(i).back()) strands.push_back(i);
    return strands;
}

TEST(Clump, BringsAllTipsToTheNearestCentres) {
    const ClumpSettings settings{.strength = 1.0f, .spacing = 0.1f, .start = 0.1f};
    const Groom before = lawn(2000);
    const Groom after = clump(before, settings, 1);
    const std::vector<std::uint32_t> centres = unmoved(after, before);
    for (std::uint32_t i = 0; i < before.strand_count; ++i) {
        EXPECT_EQ(after.strand(i).front(), before.strand(i).front());
        std::uint32_t nearest = centres.front();
        const auto distance = [&](std::uint32_t centre) {
            return glm::distance(
                glm::dvec3(before.strand(i)[0]), glm::dvec3(before.strand(centre)[0]));
        };
        for (const std::uint32_t centre : centres)
            if (distance(centre) < distance(nearest)) nearest = centre;
        EXPECT_LT(distance(nearest), 0.1);  // otherwise there is room for another centre
        // With strength 1 it is the same point, except for the rounding of the weighted mean.
        EXPECT_NEAR(
            glm::distance(after.strand(i).back(), before.strand(nearest).back()), 0.0, 1e-6);
    }
}

// Per unit of area there are at most 2 / (sqrt 3 d^2) points at least d apart (Thue 1910, the
// densest packing), and, if there is no room for another, at least 2 / (3 sqrt 3 d^2) (Kershner
// 1939, the thinnest covering by discs of radius d).
TEST(Clump, SpreadsItsCentresOverTheRoots) {
    const ClumpSettings settings{.strength = 1.0f, .spacing = 0.05f};
    const Groom before = lawn(20000);
    const std::vector<std::uint32_t> centres = unmoved(clump(before, settings, 1), before);
    for (std::size_t i = 0; i < centres.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GE(
                glm::distance(
                    glm::dvec3(before.strand(centres[i])[0]),
                    glm::dvec3(before.strand(centres[k])[0])),
                double{settings.spacing});
    const double per_disc = 400.0;  // 1 / d^2
    const double with_rim = (1.0 + 0.05) * (1.0 + 0.05);  // centres keep d/2 of room round them
    EXPECT_GT(static_cast<double>(centres.size()), per_disc * 2.0 / (3.0 * std::sqrt(3.0)));
    EXPECT_LT(static_cast<double>(centres.size()), per_disc * with_rim * 2.0 / std::sqrt(3.0));
}

// Two strands are 0.01 m apart at the root. The tip is drawn half of the way.
TEST(Clump, GrowsFromItsStart) {
    const ClumpSettings settings{.strength = 0.5f, .spacing = 1.0f, .start = 0.5f};
    const Groom before = verticalStrands(2, 9, 0.2, 0.01);
    const Groom after = clump(before, settings, 1);
    // 3 t^2 - 2 t^3 at t = 0 up to the middle, then 1/4, 1/2, 3/4, 1
    const double growth[] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.15625, 0.5, 0.84375, 1.0};
    for (std::uint32_t i = 0; i < 9; ++i)
        EXPECT_NEAR(
            std::abs(after.strand(1)[i].x - after.strand(0)[i].x), 0.01 * (1.0 - 0.5 * growth[i]),
            kRounding)
            << i;
}

// The centre stays. Each other strand is drawn with at least 1 - variation of the strength.
TEST(Clump, DrawsSomeStrandsLess) {
    ClumpSettings settings{.strength = 1.0f, .spacing = 10.0f, .start = 0.0f};
    settings.variation = 0.75f;
    const Groom before = lawn(2000);
    const Groom after = clump(before, settings, 1);
    const std::vector<std::uint32_t> centres = unmoved(after, before);
    ASSERT_EQ(centres.size(), 1u);
    const glm::dvec3 tip(before.strand(centres.front()).back());
    double mean = 0.0;
    for (std::uint32_t i = 0; i < before.strand_count; ++i) {
        if (i == centres.front()) continue;
        const double left = glm::distance(glm::dvec3(after.strand(i).back()), tip) /
                            glm::distance(glm::dvec3(before.strand(i).back()), tip);
        ASSERT_GE(left, -1e-5) << i;
        ASSERT_LE(left, 0.75 + 1e-4) << i;  // rounding of points 0.01 m apart and more
        mean += left / 1999.0;
    }
    // Uniform in [0, 0.75]: a mean of 0.375, four standard errors of 0.2165 / sqrt 1999.
    EXPECT_NEAR(mean, 0.375, 0.02);
}

// With two levels the style makes the finer clumps and draws these together.
TEST(Clump, HasClumpsWithinClumps) {
    ClumpSettings settings{.strength = 0.5f, .spacing = 0.1f, .start = 0.1f};
    const Groom before = lawn(2000);
    ClumpSettings finer = settings;
    finer.spacing = 0.05f;
    const Groom expected = clump(clump(before, finer, 1), settings, 1);
    settings.levels = 2;
    EXPECT_EQ(clump(before, settings, 1).points, expected.points);
}

TEST(Clump, DependsOnTheSeedAlone) {
    const ClumpSettings settings{.strength = 0.7f, .spacing = 0.1f};
    const Groom before = lawn(500);
    EXPECT_EQ(clump(before, settings, 3).points, clump(before, settings, 3).points);
    EXPECT_NE(clump(before, settings, 3).points, clump(before, settings, 4).points);
}

TEST(Clump, TakesEqualRootsAndFarOnes) {
    Groom groom = verticalStrands(8, 3, 0.2, 0.0);
    groom.points.back() = {3e38f, -3e38f, 0.0f};
    groom.points[3] = groom.points[4] = groom.points[5] = {-3e38f, 0.0f, 3e38f};
    EXPECT_TRUE(allFinite(clump(groom, {.strength = 1.0f, .spacing = 0.0001f}, 1)));
}

}  // namespace
}  // namespace hair::groom
