#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "hair/reference/constraints.h"
#include "tests/largest_difference.h"
#include "tests/simulation/strands.h"

namespace hair::simulation {
namespace {

// Returns the largest |length / rest length - 1| of the strand's segments.
double lengthError(std::span<const glm::dvec3> points, std::span<const glm::dvec3> rest) {
    Extremes errors;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double ratio =
            glm::distance(points[i], points[i - 1]) / glm::distance(rest[i], rest[i - 1]);
        errors.add(std::abs(ratio - 1.0));
    }
    return errors.greatest();
}

TEST(LengthConstraint, LeavesRestAndPinnedRootInPlace) {
    const groom::Groom groom = wavyGroom(1, 9);
    const auto rest = toDouble(groom.points);
    auto points = rest;
    reference::projectLengths(points, rest);
    EXPECT_LT(largestDifference(points, rest), 1e-15);

    points = toDouble(disturbed(groom, 0.02, 2));
    for (int i = 0; i < 100; ++i) reference::projectLengths(points, rest);
    EXPECT_EQ(points[0], rest[0]);
}

// Worked out by hand, (12): the first segment is 3 long instead of 1 and moves vertex 1 to 1. Then
// the second is 5 long instead of 1, and each of its ends moves by 2.
TEST(LengthConstraint, MovesRedThenBlackSegments) {
    const std::vector<glm::dvec3> rest{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    std::vector<glm::dvec3> points{{0, 0, 0}, {3, 0, 0}, {6, 0, 0}};
    reference::projectLengths(points, rest);
    EXPECT_LT(glm::distance(points[1], glm::dvec3(3, 0, 0)), 1e-15);
    EXPECT_LT(glm::distance(points[2], glm::dvec3(4, 0, 0)), 1e-15);
}

// On a straight strand a segment passes its stretch on to its neighbours, half to each. At the root
// all of it goes away from the root, and at the tip half is lost. That is a random walk between a
// mirror and a sink N steps apart. So Jacobi's slowest mode shrinks by cos(pi / 2N) and red-black
// Gauss-Seidel's by the square of that.
TEST(LengthConstraint, ConvergesAtTheRateOfTheory) {
    for (const std::size_t segments : {2u, 3u, 7u, 15u}) {
        std::vector<glm::dvec3> rest;
        std::vector<glm::dvec3> points;
        for (std::size_t i = 0; i <= segments; ++i) {
            rest.emplace_back(0.0, -0.02 * static_cast<double>(i), 0.0);
            points.push_back(1.2 * rest.back());
        }
        const double theory =
            std::pow(std::cos(std::numbers::pi / (2.0 * static_cast<double>(segments))), 2.0);
        // Skips time until only the slowest mode is left, and stays far above rounding.
        const int skipped = static_cast<int>(std::log(1e-3) / std::log(theory));
        for (int i = 0; i < skipped; ++i) reference::projectLengths(points, rest);
        for (int i = 0; i < 5; ++i) {
            const double before = lengthError(points, rest);
            reference::projectLengths(points, rest);
            EXPECT_NEAR(lengthError(points, rest) / before, theory, 1e-4) << segments;
        }
    }
}

TEST(LengthConstraint, ConvergesFromADisturbedStrand) {
    const groom::Groom groom = wavyGroom(1, 8);
    const auto rest = toDouble(groom.points);
    auto points = toDouble(disturbed(groom, 0.01, 4));
    for (int i = 0; i < 500; ++i) reference::projectLengths(points, rest);
    EXPECT_LT(lengthError(points, rest), 1e-6);
}

TEST(LengthConstraint, PartsVerticesThatCoincide) {
    const std::vector<glm::dvec3> rest{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    std::vector<glm::dvec3> points(3, glm::dvec3(0.0));
    for (int i = 0; i < 100; ++i) reference::projectLengths(points, rest);
    EXPECT_LT(lengthError(points, rest), 1e-12);
}

// Returns how far the positions are from the nearest ones to `predicted` with the same lengths, m.
// At the nearest positions, tensions along the segments equal (predicted - position) / w; from the
// tip up they give one tension for each segment.
double notNearest(
    std::span<const glm::dvec3> points, std::span<const glm::dvec3> predicted,
    std::span<const double> inverse_masses) {
    Extremes errors;
    glm::dvec3 below{0.0};  // tension of the segment below
    for (std::size_t i = points.size() - 1; i > 0; --i) {
        const glm::dvec3 needed = (predicted[i] - points[i]) / inverse_masses[i] + below;
        const glm::dvec3 direction = glm::normalize(points[i] - points[i - 1]);
        const double tension = glm::dot(needed, direction);
        errors.add(glm::length(needed - tension * direction));
        below = tension * direction;
    }
    return errors.greatest();
}

TEST(LengthSolve, LeavesRestAndPinnedRootInPlace) {
    const groom::Groom groom = wavyGroom(1, 9);
    const auto rest = toDouble(groom.points);
    auto points = rest;
    reference::solveLengths(points, rest, 3);
    EXPECT_LT(largestDifference(points, rest), 1e-15);
    points = toDouble(disturbed(groom, 0.02, 2));
    reference::solveLengths(points, rest, 3);
    EXPECT_EQ(points[0], rest[0]);
}

TEST(LengthSolve, KeepsEveryLengthInOnePass) {
    for (const std::uint32_t vertices : {2u, 3u, 8u, 33u}) {
        const groom::Groom groom = wavyGroom(1, vertices);
        const auto rest = toDouble(groom.points);
        for (const double disturbance : {1e-4, 0.01, 1.0}) {
            auto points = toDouble(disturbed(groom, static_cast<float>(disturbance), 4));
            reference::solveLengths(points, rest, 1);
            EXPECT_LT(lengthError(points, rest), 1e-12) << vertices << ' ' << disturbance;
        }
        std::vector<glm::dvec3> nowhere(vertices, rest[0]);
        reference::solveLengths(nowhere, rest, 1);
        EXPECT_LT(lengthError(nowhere, rest), 1e-12) << vertices;
    }
}

// A stretched straight strand keeps its direction with any masses.
TEST(LengthSolve, TakesBackStretch) {
    const std::vector<glm::dvec3> rest{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    std::vector<glm::dvec3> points{{0, 0, 0}, {3, 0, 0}, {6, 0, 0}};
    reference::solveLengths(points, rest, 1, std::vector<double>{1.0, 0.25, 1.0});
    EXPECT_LT(largestDifference(points, rest), 1e-15);
}

TEST(LengthSolve, FindsTheNearestPlaces) {
    for (const std::uint32_t vertices : {2u, 3u, 8u, 33u}) {
        const groom::Groom groom = wavyGroom(1, vertices);
        const auto rest = toDouble(groom.points);
        const auto predicted = toDouble(disturbed(groom, 0.002f, 5));
        std::vector<double> inverse_masses(vertices);
        for (std::uint32_t i = 0; i < vertices; ++i)
            inverse_masses[i] = 1.0 / (1.0 + 0.3 * (i % 4));
        auto points = predicted;
        reference::solveLengths(points, rest, 200, inverse_masses);
        EXPECT_LT(lengthError(points, rest), 1e-12) << vertices;
        EXPECT_LT(notNearest(points, predicted, inverse_masses), 1e-9) << vertices;
    }
}

}  // namespace
}  // namespace hair::simulation
