#include "hair/groom/style/style.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/groom/style/displace.h"
#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

StyleSettings everything() {
    return {
        .clump = {.strength = 0.5f, .spacing = 0.05f},
        .wave = {.amplitude = 0.004f},
        .curl = {.radius = 0.005f, .phase_variation = 1.0f},
        .frizz = {.amplitude = 0.002f},
        .flyaways = {.share = 0.5f},
        .cut = {.length = 0.15f, .point = {0, 0.1f, 0}, .normal = {0.1f, 1.0f, 0}},
        .taper = {.root_width = 0.0001f, .tip_width = 0.00005f}};
}

Groom sample() {
    Groom groom = withNormals(verticalStrands(9, 12, 0.2, 0.01), {0.1f, 1.0f, 0.0f});
    groom.points[7] = {-0.0f, 0.1f, -0.0f};
    groom.widths.assign(groom.points.size(), 0.00007f);
    groom.root_triangles = {{0, 1, 2}};
    return groom;
}

TEST(Style, OfDefaultsLeavesTheGroomToTheBit) {
    const Groom before = sample();
    const Groom after = style(before, {}, 1, nullptr);
    ASSERT_EQ(after.points.size(), before.points.size());
    for (std::size_t i = 0; i < before.points.size(); ++i) {
        EXPECT_EQ(after.points[i], before.points[i]);
        EXPECT_EQ(std::signbit(after.points[i].x), std::signbit(before.points[i].x));
    }
    EXPECT_EQ(after.widths, before.widths);
    EXPECT_EQ(style(verticalStrands(1, 2, 0.1, 0.0), {}, 1, nullptr).widths, std::vector<float>());
}

TEST(Style, IsItsPartsInTheirOrder) {
    const StyleSettings s = everything();
    Groom expected = clump(sample(), s.clump, 5);
    expected = frizz(curl(wave(expected, s.wave, 5), s.curl, 5), s.frizz, 5);
    expected = taper(cut(flyaways(expected, s.flyaways, 5), s.cut, 5), s.taper);
    const Groom after = style(sample(), s, 5, nullptr);
    EXPECT_EQ(after.points, expected.points);
    EXPECT_EQ(after.widths, expected.widths);
}

TEST(Style, LeavesRootsNormalsAndTriangles) {
    const Groom before = sample();
    const Groom after = style(before, everything(), 5, nullptr);
    EXPECT_EQ(after.strand_count, before.strand_count);
    EXPECT_EQ(after.vertices_per_strand, before.vertices_per_strand);
    EXPECT_EQ(after.root_normals, before.root_normals);
    EXPECT_EQ(after.root_triangles, before.root_triangles);
    for (std::uint32_t i = 0; i < before.strand_count; ++i)
        EXPECT_EQ(after.strand(i)[0], before.strand(i)[0]);
    EXPECT_NE(after.points, before.points);
}

TEST(Style, TakesStrandsWithoutLengthAndOfTwoVertices) {
    const Groom awkward = style(awkwardStrands(), everything(), 1, nullptr);
    EXPECT_TRUE(allFinite(awkward));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(awkward.points[i], glm::vec3(0.0f));
    EXPECT_TRUE(
        allFinite(style(withNormals(awkwardStrands(), {0, 1, 0}), everything(), 1, nullptr)));
    EXPECT_TRUE(allFinite(style(verticalStrands(3, 2, 0.2, 0.01), everything(), 1, nullptr)));
    EXPECT_EQ(style({.vertices_per_strand = 2}, everything(), 1, nullptr).strand_count, 0u);
}

TEST(AlongStrand, CountsArcLengthFromTheRoot) {
    const std::vector<glm::vec3> points{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {3, 4, 0}, {3, 4, 5}};
    const AlongStrand along(points);
    EXPECT_EQ(along.arc(1), 3.0);
    EXPECT_EQ(along.arc(3), 7.0);
    EXPECT_EQ(along.length(), 12.0);
    EXPECT_EQ(along.fraction(4), 1.0);
}

TEST(Ease, IsLevelOutsideItsEnds) {
    EXPECT_EQ(ease(0.0, 0.5, 0.0), 0.0);
    EXPECT_EQ(ease(0.0, 0.5, 0.25), 0.5);
    EXPECT_EQ(ease(0.0, 0.5, 0.7), 1.0);
    EXPECT_EQ(ease(0.0, 0.0, 0.0), 0.0);
    EXPECT_EQ(ease(0.0, 0.0, 0.1), 1.0);
    EXPECT_EQ(ease(1.0, 1.0, 1.0), 0.0);
}

}  // namespace
}  // namespace hair::groom
