#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "hair/groom/style/displace.h"
#include "hair/groom/style/style.h"
#include "tests/groom/surface_meshes.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

constexpr double kBallRadius = 0.1;
constexpr std::uint32_t kStrands = 300;

// Roots on the upper half of a ball round the origin, strands of 0.6 m straight out of it.
Groom standing() {
    Groom groom{.strand_count = kStrands, .vertices_per_strand = 400};
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        const double height = 0.05 + 0.9 * i / kStrands;
        const double azimuth = 2.4 * i;
        const double across = std::sqrt(1.0 - height * height);
        const glm::dvec3 out(across * std::sin(azimuth), height, across * std::cos(azimuth));
        for (std::uint32_t k = 0; k < 400; ++k)
            groom.points.emplace_back((kBallRadius + 0.6 * k / 399.0) * out);
    }
    return groom;
}

BraidSettings plait() {
    return {
        .pitch = 0.06f,
        .tie = {0.0f, -0.06f, -0.13f},
        .direction = {0.0f, -1.0f, 0.0f},
        .width = 0.03f};
}

TEST(BraidStyle, WithoutAPitchChangesNothing) {
    const Groom before = standing();
    EXPECT_EQ(braid(before, {}, 1, nullptr).points, before.points);
}

// The style places points along a line in steps of 1/32 of a pitch, and a strand's segments of 1.5
// mm follow its chords. Each segment may cut a corner of the line, by less than a hundredth of it.
TEST(BraidStyle, KeepsRootsAndLengths) {
    const Groom before = standing();
    const Mesh ball = makeSphere(kBallRadius, 96, 48);
    const Groom after = braid(before, plait(), 1, &ball);
    ASSERT_EQ(after.points.size(), before.points.size());
    Extremes lengths;
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        EXPECT_EQ(after.strand(i)[0], before.strand(i)[0]);
        lengths.add(AlongStrand(after.strand(i)).length() / 0.6);
    }
    EXPECT_GT(lengths.least(), 0.99);
    EXPECT_LT(lengths.greatest(), 1.0 + 1e-6);
}

// No path over the head leads into it. The ball's flat sides lie up to 2.2e-4 m inside the sphere,
// and chords between points 1.5 mm apart lie as much deeper.
TEST(BraidStyle, LeadsOverTheHead) {
    const Mesh ball = makeSphere(kBallRadius, 96, 48);
    const Groom after = braid(standing(), plait(), 1, &ball);
    Extremes heights;
    for (std::uint32_t i = 0; i < kStrands; ++i)
        for (const glm::vec3& point : after.strand(i).subspan(1))
            heights.add(glm::length(glm::dvec3(point)) - kBallRadius);
    EXPECT_GT(heights.least(), -4.4e-4);
}

// From one pitch below the tie on, every strand stays in the section of one of three parts. style.h
// gives the middles of the parts. Every part has a third of the strands.
TEST(BraidStyle, StrandsKeepToThreeParts) {
    const Groom after = braid(standing(), plait(), 1, nullptr);
    const double reach = 0.03 / 2.84;
    std::array<int, 3> strands{};
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        std::array<double, 3> farthest{};
        for (std::size_t point_index = 0; point_index < 400; point_index += 5) {
            const glm::vec3& point = after.strand(i)[point_index];
            const double u = -0.06 - point.y;
            if (u < 0.06 || u > 0.2) continue;  // all are 0.2 m long there
            for (int part = 0; part < 3; ++part) {
                // The nearest point of the part's middle, on a fine grid: a part leans by less than
                // 1 from the braid's direction.
                double nearest = 1.0;
                for (int k = -100; k <= 100; ++k) {
                    const double at = u + 2e-4 * k;
                    const double phase = 2.0 * std::numbers::pi * (at / 0.06 + part / 3.0);
                    const glm::dvec3 middle(
                        reach * std::sin(phase), -0.06 - at,
                        -0.13 - 0.6 * reach * std::sin(2.0 * phase));
                    const glm::dvec3 mirrored(-middle.x, middle.y, middle.z);
                    nearest = std::min(
                        {nearest, glm::distance(glm::dvec3(point), middle),
                         glm::distance(glm::dvec3(point), mirrored)});
                }
                auto& most = farthest[static_cast<std::size_t>(part)];
                most = std::max(most, nearest);
            }
        }
        const auto home = std::ranges::min_element(farthest);
        EXPECT_LT(*home, 0.42 * reach * 1.02) << i;
        ++strands[static_cast<std::size_t>(home - farthest.begin())];
    }
    for (const int count : strands) EXPECT_EQ(count, 100);
}

}  // namespace
}  // namespace hair::groom
