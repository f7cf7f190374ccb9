#include "hair/groom/style/style.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

using std::numbers::pi;

const glm::vec3 kSideways(1.0f, 0.0f, 0.0f);

// The strands go straight up, and the radius has its full size from the second vertex on. The helix
// starts towards the normal, +x, and is right-handed: with y up it turns from +x towards y x x =
// -z.
TEST(Curl, PutsAStraightStrandOnARightHandedHelix) {
    const CurlSettings settings{.radius = 0.01f, .frequency = 40.0f, .start = 0.0f};
    const Groom before = withNormals(verticalStrands(1, 65, 0.2, 0.0), kSideways);
    const Groom after = curl(before, settings, 1);
    EXPECT_EQ(after.points[0], before.points[0]);
    for (std::size_t i = 1; i < after.points.size(); ++i) {
        const double turn = 2.0 * pi * 40.0 * 0.2 * static_cast<double>(i) / 64.0;
        EXPECT_NEAR(after.points[i].x, 0.01 * std::cos(turn), kRounding) << i;
        EXPECT_NEAR(after.points[i].z, -0.01 * std::sin(turn), kRounding) << i;
        EXPECT_NEAR(after.points[i].y, before.points[i].y, kRounding) << i;
    }
}

TEST(Curl, GrowsOverItsStart) {
    const CurlSettings settings{.radius = 0.01f, .frequency = 0.0f, .start = 0.5f};
    const Groom after = curl(withNormals(verticalStrands(1, 9, 0.2, 0.0), kSideways), settings, 1);
    // 3 t^2 - 2 t^3 at t = 0, 1/4, 1/2, 3/4, 1, 1, ...
    const double growth[] = {0.0, 0.15625, 0.5, 0.84375, 1.0, 1.0, 1.0, 1.0, 1.0};
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_NEAR(after.points[i].x, 0.01 * growth[i], kRounding) << i;
}

// On a bent strand, too, each point is one radius away from its old place, perpendicular to the
// strand.
TEST(Curl, KeepsItsRadiusRoundABentStrand) {
    const Groom before = sampleGroom(1, 200, [](std::uint32_t, double t) {
        return glm::dvec3(0.3 * std::sin(3.0 * t), 0.3 * t, 0.2 * t * t);
    });
    const Groom after = curl(before, {.radius = 0.02f, .frequency = 30.0f, .start = 0.0f}, 1);
    for (std::size_t i = 1; i + 1 < after.points.size(); ++i) {
        const glm::dvec3 offset = glm::dvec3(after.points[i]) - glm::dvec3(before.points[i]);
        const glm::dvec3 along =
            glm::normalize(glm::dvec3(before.points[i + 1]) - glm::dvec3(before.points[i - 1]));
        EXPECT_NEAR(glm::length(offset), 0.02, kRounding) << i;
        EXPECT_NEAR(glm::dot(offset, along), 0.0, kRounding) << i;
    }
}

// Independent phases, uniform in a quarter of a turn: their mean and their correlation from strand
// to strand. Four standard errors of 10,000 numbers each.
TEST(Curl, GivesEveryStrandAPhaseOfItsOwn) {
    constexpr std::uint32_t kStrands = 10000;
    const CurlSettings settings{
        .radius = 0.01f, .frequency = 0.0f, .phase_variation = 0.25f, .start = 0.0f};
    const Groom after =
        curl(withNormals(verticalStrands(kStrands, 2, 0.1, 0.0), kSideways), settings, 7);
    std::vector<double> phases;  // 0 to 1
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        const glm::vec3 tip = after.strand(i)[1];
        phases.push_back(std::atan2(-tip.z, tip.x) / (0.5 * pi));
        EXPECT_GT(phases.back(), -1e-5);
        EXPECT_LT(phases.back(), 1.0 + 1e-5);
    }
    double mean = 0.0;
    double product = 0.0;
    for (std::uint32_t i = 0; i < kStrands; ++i) {
        mean += phases[i] / kStrands;
        product += (phases[i] - 0.5) * (phases[(i + 1) % kStrands] - 0.5) / kStrands;
    }
    EXPECT_NEAR(mean, 0.5, 4.0 * std::sqrt(1.0 / 12.0) / 100.0);
    EXPECT_NEAR(product, 0.0, 4.0 * (1.0 / 12.0) / 100.0);
}

TEST(Curl, HasThePhaseOfItsSeed) {
    const CurlSettings settings{.radius = 0.01f, .phase_variation = 1.0f};
    const Groom before = withNormals(verticalStrands(3, 9, 0.2, 0.1), kSideways);
    EXPECT_EQ(curl(before, settings, 3).points, curl(before, settings, 3).points);
    EXPECT_NE(curl(before, settings, 3).points, curl(before, settings, 4).points);
}

}  // namespace
}  // namespace hair::groom
