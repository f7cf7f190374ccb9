#include "hair/groom/style/style.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

using std::numbers::pi;

// 0.2 m with 20 waves a metre: four waves, zero at every eighth of the strand, greatest between.
TEST(Wave, CrossesZeroTwiceAWaveAndReachesItsAmplitude) {
    const WaveSettings settings{.amplitude = 0.005f, .frequency = 20.0f, .start = 0.0f};
    const Groom before = withNormals(verticalStrands(1, 17, 0.2, 0.0), {0.0f, 0.5f, 1.0f});
    const Groom after = wave(before, settings, 1);
    for (std::size_t i = 0; i < 17; ++i) {
        const double swing = i % 2 == 0 ? 0.0 : i % 4 == 1 ? 0.005 : -0.005;
        EXPECT_NEAR(after.points[i].z, swing, kRounding) << i;
        EXPECT_EQ(after.points[i].x, 0.0f);
        EXPECT_EQ(after.points[i].y, before.points[i].y);
    }
}

// A strand that bends in the plane of its root's normal stays in that plane.
TEST(Wave, StaysInThePlaneOfTheNormal) {
    const Groom before = withNormals(
        sampleGroom(
            1, 50,
            [](std::uint32_t, double t) {
                return glm::dvec3(0.0, 0.1 * std::sin(2.0 * t), 0.1 * (1.0 - std::cos(2.0 * t)));
            }),
        {0.0f, 1.0f, 0.0f});
    const Groom after = wave(before, {.amplitude = 0.01f, .frequency = 30.0f}, 1);
    for (const glm::vec3& point : after.points) EXPECT_NEAR(point.x, 0.0, kRounding);
    EXPECT_NE(after.points, before.points);
}

TEST(Wave, TakesTheStrandsOwnPlaneWithoutANormal) {
    const Groom before = sampleGroom(1, 50, [](std::uint32_t, double t) {
        return glm::dvec3(0.1 * (1.0 - std::cos(t)), 0.1 * std::sin(t), 0.0);
    });
    const Groom after = wave(before, {.amplitude = 0.01f, .frequency = 30.0f}, 1);
    for (const glm::vec3& point : after.points) EXPECT_NEAR(point.z, 0.0, kRounding);
    EXPECT_NE(after.points, before.points);
}

TEST(Wave, MovesNeighboursAlikeUnlessPhasesVary) {
    WaveSettings settings{.amplitude = 0.005f, .frequency = 20.0f};
    const Groom before = withNormals(verticalStrands(2, 17, 0.2, 0.0), {1.0f, 0.0f, 0.0f});
    const Groom alike = wave(before, settings, 1);
    EXPECT_TRUE(std::ranges::equal(alike.strand(0), alike.strand(1)));
    settings.phase_variation = 1.0f;
    const Groom unlike = wave(before, settings, 1);
    EXPECT_FALSE(std::ranges::equal(unlike.strand(0), unlike.strand(1)));
}

// Roots are 1 mm apart, clumps 8 mm or more. Swings are alike within a clump, so there are few
// different ones. Without clumps each strand has its own.
TEST(Wave, SharesPhasesWithinAClump) {
    WaveSettings settings{.amplitude = 0.005f, .frequency = 20.0f, .phase_variation = 1.0f};
    const Groom before = withNormals(verticalStrands(64, 17, 0.2, 0.001), {0.0f, 0.0f, 1.0f});
    const auto swings = [&] {
        const Groom after = wave(before, settings, 1);
        std::set<float> found;
        for (std::uint32_t i = 0; i < 64; ++i) found.insert(after.strand(i)[9].z);
        return found.size();
    };
    EXPECT_EQ(swings(), 64u);
    settings.spacing = 0.008f;
    // Centres at least 8 mm apart on a line of 63 mm, and no place left for another.
    EXPECT_LE(swings(), 8u);
    EXPECT_GE(swings(), 4u);
}

// The phase drifts by up to a quarter of a wave, so the zero may be shifted by up to an eighth of a
// strand with two waves; the swing stays within the amplitude.
TEST(Wave, DriftsAlongTheStrand) {
    WaveSettings settings{.amplitude = 0.005f, .frequency = 20.0f, .start = 0.0f};
    const Groom before = withNormals(verticalStrands(50, 65, 0.2, 0.01), {0.0f, 0.0f, 1.0f});
    const Groom steady = wave(before, settings, 1);
    settings.drift = 0.25f;
    const Groom drifting = wave(before, settings, 1);
    double most = 0.0;
    for (std::size_t i = 0; i < before.points.size(); ++i) {
        EXPECT_LE(std::abs(drifting.points[i].z), 0.005 + kRounding);
        const double arc = before.points[i].y;
        // sin changes by at most the largest change of its argument.
        const double bound = 0.005 * std::min(2.0, 2.0 * pi * 0.25);
        EXPECT_LE(std::abs(drifting.points[i].z - steady.points[i].z), bound + kRounding) << arc;
        most = std::max(most, double{std::abs(drifting.points[i].z - steady.points[i].z)});
    }
    EXPECT_GT(most, 0.001);
}

}  // namespace
}  // namespace hair::groom
