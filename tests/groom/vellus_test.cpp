#include "hair/groom/growth/grow.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/groom/test_meshes.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

// A square of 20 x 20 m in the plane y = 0; the 10 x 10 m in the middle are scalp.
Mesh squareScalp() {
    Mesh mesh = makeGrid(20, 20, kNoHole);
    mesh.materials = {{.name = "skin"}, {.name = "scalp"}};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        glm::vec3 middle(0.0f);
        for (const std::uint32_t corner : mesh.triangles[i])
            middle += mesh.positions[corner] / 3.0f;
        const bool inside = std::abs(middle.x - 10.0f) < 5.0f && std::abs(middle.z - 10.0f) < 5.0f;
        mesh.triangle_materials[i] = inside ? 1 : 0;
    }
    return mesh;
}

GrowSettings settingsOf(std::uint32_t hairs) {
    GrowSettings settings;
    settings.strands = hairs;
    settings.comb = {0.0f, 0.0f, 1.0f};
    settings.vellus = {.share = 1.0f, .length = 0.03f, .width = 0.00003f, .band = 0.1f};
    return settings;
}

// The distance from the square's edge, m; positive inside.
double insideBy(const glm::vec3& point) {
    const double x = 5.0 - std::abs(point.x - 10.0);
    const double z = 5.0 - std::abs(point.z - 10.0);
    if (x < 0.0 && z < 0.0) return -std::hypot(x, z);
    return std::min(x, z);
}

TEST(Vellus, IsNoneWithoutAShare) {
    GrowSettings settings = settingsOf(100);
    settings.vellus.share = 0.0f;
    EXPECT_EQ(growVellus(squareScalp(), settings, 1).strandCount(), 0u);
}

// The part of 1 - smoothstep(0, 1, x) below 1/2 is 13/16; the tolerance is four standard
// deviations for this number of hairs. The corners, one band wide, have a hundredth of the edge's
// weight.
TEST(Vellus, ThinsOutOnEitherSideOfTheEdge) {
    static constexpr std::uint32_t kHairs = 4000;
    const StrandSet hairs = growVellus(squareScalp(), settingsOf(kHairs), 3);
    ASSERT_EQ(hairs.strandCount(), kHairs);
    double inside = 0.0;
    double near = 0.0;
    Extremes apart;
    for (std::uint32_t i = 0; i < kHairs; ++i) {
        const double depth = insideBy(hairs.strand(i)[0]);
        inside += depth > 0.0 ? 1.0 / kHairs : 0.0;
        near += std::abs(depth) < 0.05 ? 1.0 / kHairs : 0.0;
        apart.add(std::abs(depth));
    }
    EXPECT_NEAR(inside, 0.5, 0.032 + 0.01);
    EXPECT_NEAR(near, 13.0 / 16.0, 0.025 + 0.01);
    EXPECT_LT(apart.greatest(), 0.1 + 1e-6);
}

// The comb leads along +z. Hairs deviate from it by at most 25 degrees, and are longer on the
// scalp.
TEST(Vellus, LiesDownTheWayHairIsCombed) {
    const StrandSet hairs = growVellus(squareScalp(), settingsOf(2000), 3);
    EXPECT_EQ(hairs.widths.at(0), 0.00003f);
    Extremes heights;
    Extremes turns;
    Extremes lengths;
    for (std::uint32_t i = 0; i < hairs.strandCount(); ++i) {
        const auto hair = hairs.strand(i);
        for (const glm::vec3& point : hair) heights.add(point.y);
        const glm::dvec3 way = glm::dvec3(hair.back()) - glm::dvec3(hair.front());
        turns.add(std::atan2(way.x, way.z));
        const double longest = 0.03 * (1.0 + std::max(insideBy(hair[0]), 0.0) / 0.1);
        lengths.add(std::hypot(way.x, way.z) / longest);
    }
    EXPECT_GE(heights.least(), 0.0);
    EXPECT_LT(heights.greatest(), 0.15 * 0.06 * 1.0001);
    EXPECT_LT(std::max(turns.greatest(), -turns.least()), 25.0 * 3.14159266 / 180.0 + 1e-4);
    // A float at 10 m is off by a millionth of a metre, compared with a hair of 0.01 m.
    EXPECT_GT(lengths.least(), 1.0 / 3.0 - 1e-3);
    EXPECT_LT(lengths.greatest(), 1.0 + 1e-3);
}

TEST(Vellus, NeedsAnEdge) {
    Mesh closed;
    closed.materials = {{.name = "scalp"}};
    closed.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    closed.normals.assign(4, glm::vec3(0.0f, 1.0f, 0.0f));
    closed.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    closed.triangle_materials.assign(4, 0);
    EXPECT_THAT(
        errorText([&] { growVellus(closed, settingsOf(10), 1); }),
        testing::HasSubstr("the scalp has no edge"));
}

}  // namespace
}  // namespace hair::groom
