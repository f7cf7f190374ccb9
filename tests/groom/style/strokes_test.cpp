#include "hair/groom/style/strokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"
#include "tests/groom/surface_meshes.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

constexpr std::array kTools{
    BrushTool::comb, BrushTool::cut, BrushTool::lengthen, BrushTool::push, BrushTool::clump};

StrokeSettings
stroke(BrushTool tool, float radius, float strength, const std::vector<glm::vec3>& path) {
    StrokeSettings settings{.tool = tool, .radius = radius, .strength = strength};
    for (const glm::vec3& position : path) settings.path.push_back({position});
    return settings;
}

Groom brushed(
    const Groom& groom, const std::vector<StrokeSettings>& strokes, const Mesh* mesh = nullptr,
    double clearance = 0.0) {
    return replay(groom, Strokes(strokes, mesh, clearance, middleOfRoots(groom)));
}

std::vector<double> segmentsOf(const Groom& groom, std::uint32_t strand) {
    std::vector<double> lengths;
    const auto points = groom.strand(strand);
    for (std::size_t i = 1; i < points.size(); ++i)
        lengths.push_back(glm::distance(glm::dvec3(points[i - 1]), glm::dvec3(points[i])));
    return lengths;
}

double lengthOf(const Groom& groom, std::uint32_t strand) {
    double sum = 0.0;
    for (const double length : segmentsOf(groom, strand)) sum += length;
    return sum;
}

// The weight of a place at this fraction of the radius from the path.
double weightAt(double part) { return (1.0 - part * part) * (1.0 - part * part); }

// Helices of 0.2 m and more, 1 cm apart.
Groom helices(std::uint32_t strands) {
    return sampleGroom(strands, 24, [](std::uint32_t strand, double t) {
        const double turn = 4.0 * std::numbers::pi * t + strand;
        return glm::dvec3(
            0.01 * strand + 0.02 * (std::cos(turn) - std::cos(double(strand))), 0.2 * t,
            0.02 * (std::sin(turn) - std::sin(double(strand))));
    });
}

const std::vector<glm::vec3> kAcross{
    {-0.05f, 0.12f, 0.01f}, {0.0f, 0.13f, 0.0f}, {0.06f, 0.1f, 0.02f}};

// ---- What stays ---------------------------------------------------------------------------------

// A length of 1e-2 m between floats of 0.2 m, each off by 7.5e-9 m, is known to 1e-6 of it.
TEST(Strokes, KeepLengthsOfSegments) {
    const Groom before = helices(12);
    for (const BrushTool tool : {BrushTool::comb, BrushTool::push, BrushTool::clump}) {
        const Groom after = brushed(before, {stroke(tool, 0.05f, 0.9f, kAcross)});
        ASSERT_NE(after.points, before.points);
        for (std::uint32_t s = 0; s < 12; ++s) {
            EXPECT_LT(largestDifference(segmentsOf(after, s), segmentsOf(before, s)), 5e-8)
                << static_cast<int>(tool) << ' ' << s;
            EXPECT_NEAR(lengthOf(after, s), lengthOf(before, s), 1e-5 * lengthOf(before, s));
        }
    }
}

TEST(Strokes, KeepRootsCountsAndStrandsBeyondTheRadius) {
    Groom before = helices(12);
    before.widths.assign(before.points.size(), 1e-4f);
    // The point is 3 m away.
    for (std::size_t i = 6 * 24; i < before.points.size(); ++i) before.points[i].z += 3.0f;
    for (const BrushTool tool : kTools) {
        const Groom after = brushed(before, {stroke(tool, 0.05f, 0.9f, kAcross)});
        ASSERT_EQ(after.points.size(), before.points.size());
        EXPECT_EQ(after.strand_count, before.strand_count);
        EXPECT_TRUE(allFinite(after));
        bool changed = false;
        for (std::uint32_t s = 0; s < 12; ++s) {
            EXPECT_EQ(after.strand(s)[0], before.strand(s)[0]);
            const bool same = std::ranges::equal(after.strand(s), before.strand(s));
            changed |= !same;
            EXPECT_TRUE(same || s < 6) << s;
        }
        EXPECT_TRUE(changed) << static_cast<int>(tool);
    }
}

TEST(Strokes, OfNoStrengthOrWithoutAPathDoNothing) {
    const Groom before = helices(12);
    for (const BrushTool tool : kTools) {
        EXPECT_EQ(brushed(before, {stroke(tool, 0.05f, 0.0f, kAcross)}).points, before.points);
        EXPECT_EQ(brushed(before, {stroke(tool, 0.05f, 1.0f, {})}).points, before.points);
    }
    // A comb that does not move.
    const Groom after = brushed(before, {stroke(BrushTool::comb, 0.05f, 1.0f, {kAcross[1]})});
    EXPECT_LT(largestDifference(after.points, before.points), kRounding);
}

TEST(Strokes, TakeStrandsAsFilesHaveThem) {
    for (const BrushTool tool : kTools)
        EXPECT_TRUE(allFinite(brushed(
            awkwardStrands(),
            {stroke(tool, 0.3f, 1.0f, {{0.0f, 0.1f, 0.0f}, {0.3f, 0.1f, 0.0f}})})))
            << static_cast<int>(tool);
}

// ---- Order --------------------------------------------------------------------------------------

// Strands saved after some strokes and brushed on are equal to strands with all strokes, with any
// number of threads.
TEST(Strokes, ReplayOneAfterTheOther) {
    const Groom before = helices(1000);
    std::vector<StrokeSettings> strokes;
    for (const BrushTool tool : kTools) strokes.push_back(stroke(tool, 0.05f, 0.7f, kAcross));
    const Groom all = brushed(before, strokes);
    EXPECT_EQ(brushed(before, strokes).points, all.points);
    Groom one = before;
    for (const StrokeSettings& each : strokes)
        one = replay(one, Strokes(std::span(&each, 1), nullptr, 0.0, middleOfRoots(before)));
    EXPECT_EQ(one.points, all.points);
}

// 0.2 m cut at 0.1 m and then made half as long again are 0.15 m; in the other order they are 0.1
// m.
TEST(Strokes, GoInTheirOrder) {
    const Groom before = verticalStrands(1, 9, 0.2, 0.0);
    const StrokeSettings cuts = stroke(BrushTool::cut, 0.01f, 1.0f, {{0.0f, 0.1f, 0.0f}});
    const StrokeSettings grows = stroke(BrushTool::lengthen, 0.01f, 0.5f, {{0.0f, 0.0f, 0.0f}});
    EXPECT_NEAR(lengthOf(brushed(before, {cuts, grows}), 0), 0.15, kRounding);
    EXPECT_NEAR(lengthOf(brushed(before, {grows, cuts}), 0), 0.1, kRounding);
}

// ---- What each does -----------------------------------------------------------------------------

// A strand of one segment turns towards the movement of its tip.
TEST(Strokes, CombTakesATipAlong) {
    const Groom before = verticalStrands(1, 2, 0.1, 0.0);
    const glm::dvec3 brush(0.01, 0.1, 0.0);
    const glm::dvec3 way(0.002, 0.001, 0.003);  // one step, less than an eighth of the radius
    const Groom after = brushed(
        before, {stroke(BrushTool::comb, 0.04f, 0.5f, {glm::vec3(brush), glm::vec3(brush + way)})});
    const glm::dvec3 tip = glm::dvec3(0.0, 0.1, 0.0) + 0.5 * weightAt(0.25) * way;
    EXPECT_LT(differenceOf(after.strand(0)[1], 0.1 * glm::normalize(tip)), kRounding);
}

// The result doesn't depend on the number of points on the path. The weight is that at a step's
// start. Over an eighth of the radius this weight changes by a fifth at most (the slope of (1 -
// x^2)^2 is 1.54), by a tenth in a step's mean, which is an increase as the brush approaches and a
// decrease as it leaves. The tolerance is half of that.
TEST(Strokes, CombDoesNotDependOnPlacesOfItsPath) {
    const Groom before = helices(12);
    const glm::vec3 from{-0.05f, 0.12f, 0.0f}, to{0.15f, 0.08f, 0.02f};
    std::vector<glm::vec3> fine;
    for (int i = 0; i <= 200; ++i) fine.push_back(glm::mix(from, to, float(i) / 200.0f));
    const Groom coarse = brushed(before, {stroke(BrushTool::comb, 0.05f, 0.5f, {from, to})});
    const Groom same = brushed(before, {stroke(BrushTool::comb, 0.05f, 0.5f, fine)});
    const double way = largestDifference(coarse.points, before.points);
    EXPECT_GT(way, 0.03);
    EXPECT_LT(largestDifference(coarse.points, same.points), 0.05 * way);
}

TEST(Strokes, CutLeavesWhatIsBelowThePath) {
    const Groom before = verticalStrands(3, 9, 0.3, 0.1);
    const std::vector<glm::vec3> path{{-0.05f, 0.07f, 0.01f}, {0.15f, 0.19f, 0.01f}};
    const Groom all = brushed(before, {stroke(BrushTool::cut, 0.02f, 1.0f, path)});
    const Groom half = brushed(before, {stroke(BrushTool::cut, 0.02f, 0.5f, path)});
    for (std::uint32_t s = 0; s < 2; ++s) {
        const double left = 0.07 + 0.12 * (0.05 + 0.1 * s) / 0.2;
        EXPECT_NEAR(lengthOf(all, s), left, kRounding);
        EXPECT_NEAR(lengthOf(half, s), 0.3 - 0.5 * (0.3 - left), kRounding);
    }
    EXPECT_TRUE(std::ranges::equal(all.strand(2), before.strand(2)));  // 5 cm beyond the path
}

// A cut at vertex 12 of a helix of equal segments: a bit more than half of its 23 is left, each
// shorter.
TEST(Strokes, CutIsExactOnCurves) {
    Groom before = helices(1);
    before.widths.resize(24);
    for (int i = 0; i < 24; ++i) before.widths[i] = 1e-4f * static_cast<float>(24 - i);
    const glm::vec3 place = before.strand(0)[12];
    const Groom after = brushed(before, {stroke(BrushTool::cut, 0.01f, 1.0f, {place})});
    double left = 0.0;
    for (std::size_t i = 0; i < 12; ++i) left += segmentsOf(before, 0)[i];
    EXPECT_NEAR(lengthOf(after, 0), left, 24 * kRounding);
    // The new vertices divide the old curve into equal parts. They cut its corners, by 2 pi / 12
    // each, so they lie farther out, by less than 2 % of the length in total.
    EXPECT_LT(differenceOf(after.strand(0)[23], place), 0.02 * left);
    EXPECT_NEAR(after.widths[23], before.widths[12], 1e-9);
    EXPECT_EQ(after.widths[0], before.widths[0]);
}

TEST(Strokes, CutLeavesAThousandthAtLeast) {
    const Groom before = verticalStrands(1, 9, 0.2, 0.0);
    const auto cut = stroke(BrushTool::cut, 0.01f, 1.0f, {{0.0f, 1e-6f, 0.0f}});
    EXPECT_NEAR(lengthOf(brushed(before, {cut}), 0), 0.0002, 1e-9);
}

TEST(Strokes, LengthenGoesOnStraight) {
    const Groom before = verticalStrands(2, 9, 0.2, 0.015);
    const Groom after =
        brushed(before, {stroke(BrushTool::lengthen, 0.03f, 0.4f, {{0.0f, 0.1f, 0.0f}})});
    EXPECT_NEAR(lengthOf(after, 0), 1.4 * 0.2, kRounding);
    EXPECT_NEAR(lengthOf(after, 1), (1.0 + 0.4 * weightAt(0.5)) * 0.2, kRounding);
    const glm::dvec3 tip(0.0, 0.28, 0.0);
    EXPECT_LT(differenceOf(after.strand(0)[8], tip), kRounding);
}

TEST(Strokes, PushGoesAwayFromTheRootsWithoutAMesh) {
    // Roots on either side of (0.05, 0, 0).
    const Groom before = verticalStrands(2, 2, 0.1, 0.1);
    const Groom after =
        brushed(before, {stroke(BrushTool::push, 0.04f, 0.5f, {{0.0f, 0.1f, 0.01f}})});
    const glm::dvec3 outward = glm::normalize(glm::dvec3(-0.05, 0.1, 0.0));
    const glm::dvec3 tip = glm::dvec3(0.0, 0.1, 0.0) + 0.5 * weightAt(0.25) * 0.04 * outward;
    EXPECT_LT(differenceOf(after.strand(0)[1], 0.1 * glm::normalize(tip)), kRounding);
    EXPECT_EQ(after.strand(1)[1], before.strand(1)[1]);
}

TEST(Strokes, ClumpDrawsTipsToThePath) {
    const Groom before = verticalStrands(3, 2, 0.1, 0.01);
    const glm::dvec3 middle(0.01, 0.1, 0.0);
    const Groom after =
        brushed(before, {stroke(BrushTool::clump, 0.02f, 0.8f, {glm::vec3(middle)})});
    for (std::uint32_t s = 0; s < 3; ++s) {
        const glm::dvec3 root(before.strand(s)[0]), old(before.strand(s)[1]);
        const double share = 0.8 * weightAt(s == 1 ? 0.0 : 0.5);
        const glm::dvec3 tip = glm::mix(old, middle, share);
        EXPECT_LT(
            differenceOf(after.strand(s)[1], root + 0.1 * glm::normalize(tip - root)), kRounding);
    }
}

// ---- Bodies -------------------------------------------------------------------------------------

// Strands from a ball, brushed through it. Its flat sides lie up to r (1 - cos(pi / 48)) = 2.2e-4 m
// inside the sphere, and strands are kept clear to within 1e-4 m.
TEST(Strokes, LeadNoVertexIntoTheMesh) {
    constexpr double kRadius = 0.1;
    const Mesh ball = makeSphere(kRadius, 96, 48);
    const Groom before = sampleGroom(40, 12, [](std::uint32_t strand, double t) {
        const double angle = 0.1 * strand - 2.0;
        return (kRadius + 0.15 * t) * glm::dvec3(std::sin(angle), std::cos(angle), 0.0);
    });
    for (const BrushTool tool : kTools) {
        const Groom after = brushed(
            before,
            {stroke(tool, 0.12f, 1.0f, {{0.15f, 0.15f, 0.0f}, {0.0f, -0.1f, 0.0f}}),
             stroke(tool, 0.12f, 1.0f, {{-0.15f, 0.15f, 0.0f}, {0.0f, 0.0f, 0.05f}})},
            &ball, 0.004);
        ASSERT_NE(after.points, before.points);
        Extremes gaps;
        for (std::uint32_t s = 0; s < 40; ++s) {
            for (std::size_t i = 1; i < 12; ++i)
                gaps.add(glm::length(glm::dvec3(after.strand(s)[i])) - kRadius);
            if (tool == BrushTool::cut || tool == BrushTool::lengthen) continue;
            EXPECT_NEAR(lengthOf(after, s), lengthOf(before, s), 1e-5 * lengthOf(before, s));
        }
        EXPECT_GT(gaps.least(), -2.2e-4 - 1e-4) << static_cast<int>(tool);
    }
}

// The push goes away from a nearly flat side of a large ball, wherever the roots are.
TEST(Strokes, PushGoesAwayFromTheMesh) {
    const Mesh ball = makeSphere(0.1, 96, 48);
    // The path runs along the ball's top.
    Groom before{.strand_count = 1, .vertices_per_strand = 2};
    before.points = {{0.0f, 0.1f, 0.0f}, {0.05f, 0.12f, 0.0f}};
    const auto push = stroke(BrushTool::push, 0.05f, 1.0f, {{0.05f, 0.12f, 0.0f}});
    const Groom after = brushed(before, {push}, &ball);
    const glm::dvec3 root(before.points[0]), old(before.points[1]);
    const glm::dvec3 tip = old + 0.05 * glm::normalize(old);
    const glm::dvec3 expected = root + glm::distance(root, old) * glm::normalize(tip - root);
    // The ball's triangles are 3.75 degrees wide, and the direction away from it may be off by
    // half of that: 0.05 m by 0.033 rad.
    EXPECT_LT(differenceOf(after.points[1], expected), 0.05 * 0.033);
}

}  // namespace
}  // namespace hair::groom
