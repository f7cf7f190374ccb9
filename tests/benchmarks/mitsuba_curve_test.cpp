// The curves for Mitsuba: through the strands' points, from root to tip.
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "benchmarks/reference/mitsuba.h"

namespace benchmarks {
namespace {

// The Cox-de Boor recursion: the basis function of knots i to i + degree + 1, all integers.
double basis(int i, int degree, double at) {
    if (degree == 0) return i <= at && at < i + 1 ? 1.0 : 0.0;
    return (at - i) / degree * basis(i, degree - 1, at) +
           (i + degree + 1 - at) / degree * basis(i + 1, degree - 1, at);
}

// Control point i has knots i - 3 to i + 1, so the curve is defined from 0 on.
glm::dvec4 curveAt(const std::vector<glm::dvec4>& control, double at) {
    glm::dvec4 sum(0.0);
    for (std::size_t i = 0; i < control.size(); ++i)
        sum += basis(static_cast<int>(i) - 3, 3, at) * control[i];
    return sum;
}

std::vector<glm::dvec4> somePoints(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    std::vector<glm::dvec4> points;
    for (std::size_t i = 0; i < count; ++i)
        points.emplace_back(
            coordinate(random), coordinate(random), coordinate(random), coordinate(random));
    return points;
}

// Rounding of coordinates near 1; the system's condition number is below 3.
constexpr double kRounding = 1e-14;

TEST(CurveControlPoints, GoThroughEveryPointAtItsKnot) {
    for (const std::size_t count : {2u, 3u, 4u, 5u, 17u, 77u}) {
        const auto points = somePoints(count);
        const auto control = reference::interpolatingControlPoints(points);
        ASSERT_EQ(control.size(), count + 2);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_LT(glm::distance(curveAt(control, double(i)), points[i]), kRounding) << i;
    }
}

TEST(CurveControlPoints, KeepAStraightEvenLineEven) {
    const glm::dvec4 root(0.1, 1.0, -2.0, 0.003);
    const glm::dvec4 step(0.01, -0.02, 0.005, -0.0001);
    std::vector<glm::dvec4> points;
    for (int i = 0; i < 9; ++i) points.push_back(root + double(i) * step);
    const auto control = reference::interpolatingControlPoints(points);
    for (std::size_t i = 0; i < control.size(); ++i)
        EXPECT_LT(glm::distance(control[i], root + (double(i) - 1.0) * step), kRounding);
    EXPECT_LT(glm::distance(curveAt(control, 3.25), root + 3.25 * step), kRounding);
}

// Returns the file's contents, in m.
std::vector<std::vector<glm::dvec4>> written(const hair::groom::StrandSet& strands) {
    std::stringstream file;
    reference::writeMitsubaCurves(file, strands);
    std::vector<std::vector<glm::dvec4>> curves(1);
    for (std::string line; std::getline(file, line);) {
        if (line.empty()) {
            curves.emplace_back();
            continue;
        }
        std::istringstream numbers(line);
        glm::dvec4& point = curves.back().emplace_back();
        numbers >> point.x >> point.y >> point.z >> point.w;
        EXPECT_FALSE(numbers.fail()) << line;
        point /= 100.0;
    }
    curves.pop_back();  // each curve ends with an empty line
    return curves;
}

TEST(MitsubaCurves, HaveRootAndTipAndRadiiOfTheStrands) {
    hair::groom::StrandSet strands;
    strands.points = {{0, 0, 0}, {0, 1, 0}, {0.5f, 2, 0}, {9, 9, 9}, {1, 0, 0}, {2, 0, 0}};
    strands.widths.values = {0.4f, 0.3f, 0.2f, 1.0f, 0.2f, 0.0f};
    strands.ends = {3, 4, 6};  // the strand with one point has no curve
    const auto curves = written(strands);
    ASSERT_EQ(curves.size(), 2u);
    // Float precision for coordinates up to 2.
    constexpr double kFloat = 5e-7;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4 expected(glm::dvec3(strands.points[i]), strands.widths.values[i] / 2.0);
        EXPECT_LT(glm::distance(curveAt(curves[0], i), expected), kFloat) << i;
    }
    // The second strand narrows to nothing at its tip, but its radius does not become negative.
    for (const glm::dvec4& control : curves[1]) EXPECT_GE(control.w, 0.0);
    EXPECT_NEAR(curveAt(curves[1], 0.0).w, 0.1, kFloat);
}

// Straight strands in a lattice, turned about their middles by angles of a normal distribution in
// two planes. Two such directions differ by the root of two times its deviation.
TEST(OrientationSpread, IsTheDeviationOfNeighboursDirections) {
    constexpr int kSide = 60;
    for (const double degrees : {0.0, 4.0, 12.0}) {
        std::mt19937 random(3);
        std::normal_distribution<double> angle(0.0, glm::radians(degrees) / std::sqrt(2.0));
        hair::groom::StrandSet strands;
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::vec3 middle(0.0f, 0.0007f * float(i % kSide), 0.0007f * float(i / kSide));
            const glm::vec3 half =
                0.0002f * glm::vec3(1.0, std::tan(angle(random)), std::tan(angle(random)));
            strands.points.insert(strands.points.end(), {middle - half, middle + half});
            strands.ends.push_back(static_cast<std::uint32_t>(strands.points.size()));
        }
        // 3,600 directions give a deviation to 1 %; sines of 12 degrees are 2 % below their angles.
        EXPECT_NEAR(reference::orientationSpread(strands), degrees, 0.04 * degrees + 0.05);
    }
}

TEST(OrientationSpread, IsNoneWithoutNeighbours) {
    hair::groom::StrandSet strands;
    EXPECT_EQ(reference::orientationSpread(strands), 0.0);
    strands.points = {{0, 0, 0}, {0, 0.001f, 0}, {0.01f, 0, 0}, {0.011f, 0, 0}};
    strands.ends = {2, 4};
    EXPECT_EQ(reference::orientationSpread(strands), 0.0);
}

}  // namespace
}  // namespace benchmarks
