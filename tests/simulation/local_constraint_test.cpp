#include <array>
#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include "hair/reference/constraints.h"
#include "tests/largest_difference.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

constexpr double kPositionRounding = 1e-13;  // rounding of double, m

double difference(const glm::dmat3& a, const glm::dmat3& b) {
    return largestDifference(std::array{a[0], a[1], a[2]}, std::array{b[0], b[1], b[2]});
}

glm::dmat3 rotation(double angle, const glm::dvec3& axis) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis));
}

std::vector<glm::dvec3> turned(std::vector<glm::dvec3> points, const glm::dmat3& by) {
    const glm::dvec3 root = points.front();
    for (glm::dvec3& point : points) point = root + by * (point - root);
    return points;
}

TEST(LocalConstraint, LeavesTheRestShapeAlone) {
    const auto rest = toDouble(wavyGroom(1, 12).points);
    auto points = rest;
    for (int i = 0; i < 100; ++i) reference::pullToShape(points, rest, 0.95);
    EXPECT_LT(largestDifference(points, rest), kPositionRounding);
}

// If the whole head turns, the frames are its rotation, including twist, and nothing is pulled.
TEST(LocalConstraint, LeavesAStrandThatTurnsWithItsRootAlone) {
    const auto rest = toDouble(wavyGroom(1, 12).points);
    const glm::dmat3 head = rotation(1.9, glm::normalize(glm::dvec3(1, 2, -1)));
    const auto points = turned(rest, head);
    for (const glm::dmat3& frame : reference::segmentFrames(points, rest, head))
        EXPECT_LT(difference(frame, head), kPositionRounding);
    auto pulled = points;
    reference::pullToShape(pulled, rest, 0.95, head);
    EXPECT_LT(largestDifference(pulled, points), kPositionRounding);
}

// The strand is bent at the root without twist, so only its first segment is out of place.
TEST(LocalConstraint, PullsOnlyTheFirstSegmentOfAStrandBentAtItsRoot) {
    const auto rest = toDouble(wavyGroom(1, 12).points);
    const glm::dvec3 first = glm::normalize(rest[1] - rest[0]);
    const glm::dvec3 axis = glm::normalize(glm::cross(first, glm::dvec3(0.3, 0.5, 0.1)));
    const glm::dmat3 bend = rotation(0.8, axis);
    const auto points = turned(rest, bend);
    const auto frames = reference::segmentFrames(points, rest);
    EXPECT_LT(difference(frames[0], glm::dmat3(1.0)), kPositionRounding);
    for (std::size_t i = 1; i < frames.size(); ++i)
        EXPECT_LT(difference(frames[i], bend), kPositionRounding);
}

// In a plane, parallel transport adds angles: a frame turns by the tangent's present angle minus
// its angle at rest.
TEST(LocalConstraint, TurnsFramesByTheAngleOfTheTangentInAPlane) {
    std::vector<glm::dvec3> rest{glm::dvec3(0.0)};
    std::vector<glm::dvec3> points = rest;
    std::vector<double> angles{0.0};
    for (int i = 1; i < 10; ++i) {
        const double at_rest = 0.2 * i;
        const double now = 0.5 * std::sin(1.7 * i) - 0.1 * i;
        rest.push_back(rest.back() + glm::dvec3(std::cos(at_rest), std::sin(at_rest), 0.0));
        points.push_back(points.back() + 0.9 * glm::dvec3(std::cos(now), std::sin(now), 0.0));
        angles.push_back(now - at_rest);
    }
    const auto frames = reference::segmentFrames(points, rest);
    for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_LT(difference(frames[i], rotation(angles[i], {0, 0, 1})), kPositionRounding) << i;
}

// In space, too, frames are rotations that turn rest tangents into present ones.
TEST(LocalConstraint, TurnsRestTangentsIntoCurrentOnes) {
    const groom::Groom groom = wavyGroom(1, 20);
    const auto rest = toDouble(groom.points);
    const auto points = toDouble(disturbed(groom, 0.01, 5));
    const auto frames = reference::segmentFrames(points, rest);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 s = glm::normalize(rest[i] - rest[i - 1]);
        const glm::dvec3 t = glm::normalize(points[i] - points[i - 1]);
        EXPECT_LT(glm::distance(frames[i] * s, t), kPositionRounding);
        EXPECT_NEAR(glm::determinant(frames[i]), 1.0, kPositionRounding);
    }
}

// A segment at the root gets the whole correction: an error shrinks by 1 - k in each iteration.
TEST(LocalConstraint, PullsASegmentAtThePinnedRootByTheWholeFactor) {
    const std::vector<glm::dvec3> rest{{0, 0, 0}, {0, 1, 0}};
    std::vector<glm::dvec3> points{{0, 0, 0}, {2, 0, 1}};
    for (int i = 0; i < 3; ++i) reference::pullToShape(points, rest, 0.25);
    const glm::dvec3 expected = rest[1] + 0.421875 * (glm::dvec3(2, 0, 1) - rest[1]);
    EXPECT_LT(glm::distance(points[1], expected), kPositionRounding);
    EXPECT_EQ(points[0], rest[0]);
}

// Worked out by hand: the rest shape is straight along y, and the second segment is bent to x. The
// first segment stays. The goal of the second is y, so d = (0, 1, 0) - (1, 0, 0), and k d / 2 moves
// both of its ends.
TEST(LocalConstraint, SharesTheCorrectionBetweenFreeVertices) {
    const std::vector<glm::dvec3> rest{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    std::vector<glm::dvec3> points{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    reference::pullToShape(points, rest, 0.5);
    EXPECT_LT(glm::distance(points[1], glm::dvec3(0.25, 0.75, 0)), kPositionRounding);
    EXPECT_LT(glm::distance(points[2], glm::dvec3(0.75, 1.25, 0)), kPositionRounding);
}

TEST(LocalConstraint, TurnsHalfRoundWhereTangentsAreOpposite) {
    const std::vector<glm::dvec3> rest{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {1, 2, 0}};
    const std::vector<glm::dvec3> folded{{0, 0, 0}, {0, -1, 0}, {0, 0, 0}, {0, -1, 0}};
    const auto frames = reference::segmentFrames(folded, rest);
    for (std::size_t i = 1; i < 4; ++i) {
        const glm::dvec3 s = glm::normalize(rest[i] - rest[i - 1]);
        const glm::dvec3 t = glm::normalize(folded[i] - folded[i - 1]);
        EXPECT_LT(glm::distance(frames[i] * s, t), kPositionRounding) << i;
        EXPECT_NEAR(glm::determinant(frames[i]), 1.0, kPositionRounding) << i;
    }
}

// A vertex that is repeated, at rest and now, changes nothing for the rest of the strand.
TEST(LocalConstraint, SeesThroughSegmentsWithoutLength) {
    const groom::Groom groom = wavyGroom(1, 8);
    auto rest = toDouble(groom.points);
    auto points = toDouble(disturbed(groom, 0.01, 5));
    const auto frames = reference::segmentFrames(points, rest);
    for (const std::ptrdiff_t at : {0, 3, 7}) {
        auto longer_rest = rest;
        auto longer = points;
        longer_rest.insert(longer_rest.begin() + at, rest[static_cast<std::size_t>(at)]);
        longer.insert(longer.begin() + at, points[static_cast<std::size_t>(at)]);
        const auto more = reference::segmentFrames(longer, longer_rest);
        for (std::size_t i = static_cast<std::size_t>(at) + 1; i < 8; ++i) {
            const glm::dvec3 s = glm::normalize(rest[i] - rest[i - 1]);
            const glm::dvec3 t = glm::normalize(points[i] - points[i - 1]);
            EXPECT_LT(glm::distance(more[i + 1] * s, t), kPositionRounding);
            if (at > 0) {
                EXPECT_LT(difference(more[i + 1], frames[i]), kPositionRounding);
            }
        }
    }
}

}  // namespace
}  // namespace hair::simulation
