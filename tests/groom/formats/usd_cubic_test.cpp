// Cubic curves and curves with knots, written by usd-core, against constructions of their points.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/formats/usd_files.h"

namespace hair::groom {
namespace {

using UsdCubic = UsdFiles;
using UsdNurbs = UsdFiles;

struct Cubic {
    const char* prim;
    std::vector<int> control_vertices;  // of each curve
    int step;  // control vertices from a segment to the next
    int between;  // points between two segments' ends
    bool pinned;
    bool varying;  // widths: k + 1 at the ends of segments; otherwise at the control vertices
    glm::dvec3 (*curve)(const std::array<glm::dvec3, 4>& p, double t);
};

// De Casteljau's construction.
glm::dvec3 bezier(const std::array<glm::dvec3, 4>& p, double t) {
    std::array<glm::dvec3, 4> q = p;
    for (int n = 3; n > 0; --n)
        for (int i = 0; i < n; ++i) q[i] = (1 - t) * q[i] + t * q[i + 1];
    return q[0];
}

// De Boor's, with knots at the whole numbers and the segment in [0, 1].
glm::dvec3 bspline(const std::array<glm::dvec3, 4>& p, double t) {
    std::array<glm::dvec3, 4> q = p;
    for (int n = 1; n <= 3; ++n) {
        for (int i = 3; i >= n; --i) {
            const double a = (t - (i - 3)) / (4 - n);
            q[i] = (1 - a) * q[i - 1] + a * q[i];
        }
    }
    return q[3];
}

// A cubic Hermite curve with tangents of half the chord between the neighbours (Catmull, Rom
// 1974).
glm::dvec3 catmullRom(const std::array<glm::dvec3, 4>& p, double t) {
    const glm::dvec3 from = 0.5 * (p[2] - p[0]);
    const glm::dvec3 to = 0.5 * (p[3] - p[1]);
    const double s = 1 - t;
    return (1 + 2 * t) * s * s * p[1] + t * t * (1 + 2 * s) * p[2] + t * s * s * from -
           t * t * s * to;
}

// The prims of cubics.usda. Each curve gets at least as many points as control vertices. In
// "bspline" the curve of 4 vertices has one segment, so it sets `between`.
const Cubic kCubics[] = {
    {"bezier", {4, 7}, 3, 2, false, false, bezier},
    {"bspline", {4, 6}, 1, 2, false, true, bspline},
    {"bspline_pinned", {2, 4}, 1, 0, true, true, bspline},
    {"catmull_rom", {5, 6}, 1, 1, false, false, catmullRom},
    {"catmull_rom_pinned", {3, 4}, 1, 0, true, true, catmullRom}};

// Adds 2 P0 - P1 before the first and its counterpart after the last.
void pin(std::vector<glm::dvec3>& values) {
    values.insert(values.begin(), 2.0 * values[0] - values[1]);
    values.push_back(2.0 * values.back() - values.rbegin()[1]);
}

// The strands from `strand` on, one for each curve of the prim.
void expectOnCurves(const Cubic& made, const StrandSet& set, std::uint32_t strand) {
    int next_vertex = 0;
    int next_end = 0;
    for (const int count : made.control_vertices) {
        std::vector<glm::dvec3> controls;
        std::vector<glm::dvec3> widths;
        for (int k = 0; k < count; ++k) {
            controls.emplace_back(glm::vec3(madePoint(next_vertex)));
            widths.emplace_back(++next_vertex);
        }
        if (made.pinned) {
            pin(controls);
            pin(widths);
        }
        const int segments = (static_cast<int>(controls.size()) - 4) / made.step + 1;
        const int points = segments * (made.between + 1) + 1;
        ASSERT_EQ(set.size(strand), static_cast<std::uint32_t>(points));
        for (int k = 0; k < points; ++k) {
            const int segment = std::min(k / (made.between + 1), segments - 1);
            const double t = static_cast<double>(k) / (made.between + 1) - segment;
            const auto at = [&](const std::vector<glm::dvec3>& values) {
                const auto* first = values.data() + made.step * segment;
                return made.curve({first[0], first[1], first[2], first[3]}, t);
            };
            const double width = made.varying ? next_end + segment + t + 1 : at(widths).x;
            const std::uint32_t point = set.first(strand) + static_cast<std::uint32_t>(k);
            // Numbers below 16, rounded once to float.
            EXPECT_LT(glm::distance(glm::dvec3(set.points[point]), at(controls)), 16 * 0x1p-24);
            EXPECT_NEAR(set.widths.at(point), width, 16 * 0x1p-24);
        }
        next_end += segments + 1;
        ++strand;
    }
}

TEST_F(UsdCubic, SampledPointsLieOnTheCurves) {
    const StrandSet set = read("cubics.usda");
    ASSERT_EQ(set.strandCount(), 10u);
    for (std::uint32_t i = 0; i < 5; ++i) {
        SCOPED_TRACE(kCubics[i].prim);
        expectOnCurves(kCubics[i], set, 2 * i);
    }
}

// ---- Curves with knots --------------------------------------------------------------------------

// De Boor's construction (de Boor 1972, On calculating with B-splines).
glm::dvec3
deBoor(const std::vector<glm::dvec3>& p, const std::vector<double>& knots, int degree, double t) {
    int span = degree;
    while (span + 1 < static_cast<int>(p.size()) && knots[span + 1] <= t) ++span;
    std::vector<glm::dvec3> q(p.begin() + (span - degree), p.begin() + span + 1);
    for (int n = 1; n <= degree; ++n) {
        for (int i = degree; i >= n; --i) {
            const double from = knots[span - degree + i];
            const double a = (t - from) / (knots[span + 1 + i - n] - from);
            q[i] = (1 - a) * q[i - 1] + a * q[i];
        }
    }
    return q[degree];
}

std::vector<glm::dvec3> madeVertices(int first, int count) {
    std::vector<glm::dvec3> vertices;
    for (int k = first; k < first + count; ++k) vertices.emplace_back(glm::vec3(madePoint(k)));
    return vertices;
}

void expectPoints(
    const StrandSet& set, std::uint32_t strand, const std::vector<glm::dvec3>& expected) {
    ASSERT_EQ(set.size(strand), expected.size());
    // Numbers below 16, rounded once to float.
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_LT(glm::distance(glm::dvec3(set.strand(strand)[i]), expected[i]), 16 * 0x1p-24) << i;
}

std::vector<glm::dvec3> alongKnots(
    const std::vector<glm::dvec3>& vertices, const std::vector<double>& knots, int degree,
    const std::vector<double>& parameters) {
    std::vector<glm::dvec3> expected;
    for (const double t : parameters) expected.push_back(deBoor(vertices, knots, degree, t));
    return expected;
}

TEST_F(UsdNurbs, FollowTheirKnots) {
    const StrandSet set = read("nurbs.usda");
    ASSERT_EQ(set.strandCount(), 8u);
    EXPECT_TRUE(std::ranges::none_of(set.warnings, [](const std::string& warning) {
        return warning.find("NurbsCurves") != std::string::npos;
    }));
    // Two segments of two pieces.
    const std::vector<double> knots{0, 0, 0, 1, 3, 3, 3};
    expectPoints(set, 0, alongKnots(madeVertices(0, 4), knots, 2, {0, 0.5, 1, 2, 3}));
    // Curves of one prim have as many pieces of a segment: 2, because of the first one.
    expectPoints(
        set, 1,
        alongKnots(
            madeVertices(0, 6), {0, 0, 0, 0, 1, 1.5, 4, 4, 4, 4}, 3,
            {0, 0.5, 1, 1.25, 1.5, 2.75, 4}));
    expectPoints(set, 2, alongKnots(madeVertices(6, 2), {0, 0, 1, 1}, 1, {0, 0.5, 1}));
    expectPoints(set, 3, alongKnots(madeVertices(8, 3), {-1, 0, 2, 3, 7, 9}, 2, {2, 2.5, 3}));
    // With a range, the curve is its part from 0.5 to 2.
    expectPoints(set, 7, alongKnots(madeVertices(0, 4), knots, 2, {0.5, 0.75, 1, 1.5, 2}));
}

// The curves have 1, 3, 0 and 3 vertices.
TEST_F(UsdNurbs, OfOneVertexOrNoneAreLeftOut) {
    const StrandSet set = usableStrands(read("nurbs_short.usda"));
    ASSERT_EQ(set.strandCount(), 2u);
    const std::vector<double> knots{0, 0, 0, 1, 1, 1};
    expectPoints(set, 0, alongKnots(madeVertices(1, 3), knots, 2, {0, 0.5, 1}));
    expectPoints(set, 1, alongKnots(madeVertices(4, 3), knots, 2, {0, 0.5, 1}));
    EXPECT_EQ(set.widths.values, (std::vector<float>{2, 3, 4, 8, 12, 16}));
    EXPECT_THAT(
        set.warnings, testing::IsSupersetOf(
                          {"1 strand of a single point (strand 0, counted from 0) is left out",
                           "1 strand without points (strand 2, counted from 0) is left out"}));
}

TEST_F(UsdNurbs, AreUniformBsplinesWithKnotsAtWholeNumbers) {
    const StrandSet set = read("nurbs.usda");
    const auto bspline = set.strand(5);
    expectPoints(set, 4, {bspline.begin(), bspline.end()});
}

// With a weight of cos 45 degrees in the middle, three vertices make a quarter of a circle.
TEST_F(UsdNurbs, FollowTheirWeights) {
    const StrandSet set = read("nurbs.usda");
    ASSERT_EQ(set.size(6), 3u);
    for (const glm::vec3& point : set.strand(6)) EXPECT_NEAR(glm::length(point), 1.0f, 1e-6f);
    EXPECT_NEAR(set.strand(6)[1].x, set.strand(6)[1].y, 1e-6f);
}

}  // namespace
}  // namespace hair::groom
