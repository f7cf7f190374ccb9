// Cubic curves written by usd-core, against constructions of their points.
#include <algorithm>
#include <array>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/groom/formats/usd_files.h"

namespace hair::groom {
namespace {

using UsdCubic = UsdFiles;

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

}  // namespace
}  // namespace hair::groom
