#include "hair/groom/style/displace.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/style/sample_strands.h"

namespace hair::groom {
namespace {

using std::numbers::pi;

void expectOrthonormal(const StrandFrame& frame) {
    EXPECT_NEAR(glm::length(frame.tangent), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(frame.normal), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(frame.tangent, frame.normal), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(glm::cross(frame.tangent, frame.normal), frame.binormal), 0.0, 1e-12);
}

TEST(StrandFrames, StandStillOnAStraightStrand) {
    const glm::vec3 normal(1.0f, 1.0f, 0.0f);  // its component along the strand has no effect
    for (const StrandFrame& frame : strandFrames(verticalStrands(1, 5, 0.2, 0.0).points, &normal)) {
        expectOrthonormal(frame);
        EXPECT_NEAR(glm::distance(frame.normal, glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-12);
    }
}

// In a plane curve the frame turns with the tangent, in the plane.
TEST(StrandFrames, StayInThePlaneOfAPlaneCurve) {
    const Groom arc = sampleGroom(1, 33, [](std::uint32_t, double t) {
        return glm::dvec3(1.0 - std::cos(pi * t), std::sin(pi * t), 0.0);
    });
    const glm::vec3 across_plane(0.0f, 0.0f, 1.0f);
    for (const StrandFrame& frame : strandFrames(arc.points, &across_plane))
        EXPECT_NEAR(frame.normal.z, 1.0, 1e-12);
    for (const StrandFrame& frame : strandFrames(arc.points, nullptr)) {
        expectOrthonormal(frame);
        EXPECT_NEAR(frame.normal.z, 0.0, 1e-7);  // the points are floats
    }
}

// A rotation-minimising frame turns against the Frenet frame by the integral of the torsion
// (Bishop 1975, There is more than one way to frame a curve): a helix of radius r and rise h per
// radian has the torsion h / (r^2 + h^2), so over the angle A it turns by -h A / sqrt(r^2 + h^2).
TEST(StrandFrames, TurnAgainstTheFrenetFrameByTheTorsion) {
    constexpr double kRadius = 0.5;
    constexpr double kRise = 0.1;
    constexpr double kAngle = 4.0 * pi;
    const Groom helix = sampleGroom(1, 2001, [](std::uint32_t, double t) {
        return glm::dvec3(
            kRadius * std::cos(kAngle * t), kRadius * std::sin(kAngle * t), kRise * kAngle * t);
    });
    const std::vector<StrandFrame> frames = strandFrames(helix.points, nullptr);
    const auto angle = [&](std::size_t i, double at) {
        const glm::dvec3 frenet_normal(-std::cos(at), -std::sin(at), 0.0);
        const glm::dvec3 frenet_binormal = glm::cross(frames[i].tangent, frenet_normal);
        return std::atan2(
            glm::dot(frames[i].normal, frenet_binormal), glm::dot(frames[i].normal, frenet_normal));
    };
    const double turned = angle(2000, kAngle) - angle(0, 0.0);
    const double expected = -kRise * kAngle / std::hypot(kRadius, kRise);
    // The tangent at either end is a chord's, off by half a step of 2 pi / 1000.
    EXPECT_NEAR(std::remainder(turned - expected, 2.0 * pi), 0.0, 0.01);
}

TEST(StrandFrames, AreFiniteOnStrandsWithoutLength) {
    const Groom groom = awkwardStrands();
    for (std::uint32_t strand = 0; strand < groom.strand_count; ++strand)
        for (const StrandFrame& frame : strandFrames(groom.strand(strand), nullptr))
            expectOrthonormal(frame);
    const std::vector<glm::vec3> point{{1, 2, 3}};
    for (const StrandFrame& frame : strandFrames(point, nullptr)) expectOrthonormal(frame);
}

TEST(StrandFrames, TakeTheStrandsOwnPlaneWhereTheNormalIsAlongIt) {
    const Groom arc = sampleGroom(1, 33, [](std::uint32_t, double t) {
        return glm::dvec3(0.0, std::sin(t), 1.0 - std::cos(t));  // in x = 0, up at the root
    });
    const glm::dvec3 along = rootDirection(arc.points);
    const glm::vec3 normal(along);
    EXPECT_NEAR(strandFrames(arc.points, &normal).front().normal.z, 1.0, 0.02);
    EXPECT_NEAR(strandFrames(arc.points, &normal).front().normal.x, 0.0, 1e-9);
}

}  // namespace
}  // namespace hair::groom
