#include "hair/groom/growth/parting.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "hair/groom/growth/roots.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/groom/surface_meshes.h"
#include "tests/groom/test_meshes.h"

namespace hair::groom {
namespace {

using testing::HasSubstr;

struct Parted {
    Scalp scalp;
    NearestSurface surface;
    PartingLine line;
    double spacing;
    Roots roots;
};

Parted part(
    const Mesh& mesh, const PartingSettings& settings, std::uint32_t guides,
    RootPlacement placement = RootPlacement::poisson_disc, std::uint32_t seed = 1) {
    Scalp scalp = extractScalp(mesh);
    NearestSurface surface(scalp.positions, scalp.triangles);
    PartingLine line(scalp, surface, settings);
    Roots roots = placeRoots(
        scalp, surface, {.guides = guides, .seed = seed, .placement = placement, .parting = &line});
    const double spacing = 0.8 * std::sqrt(scalp.area() / guides);
    return {std::move(scalp), std::move(surface), std::move(line), spacing, std::move(roots)};
}

// On a sphere the line lies in the plane through the middle with this normal. On its mesh it is
// within a fifth of a millimetre of the plane, less than the least gap. It covers all z from
// z_from to z_to.
void expectNothingCrosses(const Parted& parted, const glm::vec3& normal, float z_from, float z_to) {
    for (const auto& triangle : parted.roots.triangles) {
        int left = 0;
        int right = 0;
        for (const std::uint32_t root : triangle) {
            const glm::vec3& p = parted.roots.points[root].position;
            const float side = glm::dot(p, glm::normalize(normal));
            if (p.y < 0.0f || p.z < z_from || p.z > z_to || std::abs(side) < 0.0002f) continue;
            (side < 0.0f ? left : right) += 1;
        }
        EXPECT_TRUE(left == 0 || right == 0);
    }
}

// 0.05 times 0.1 / |from| is 0.038, and -0.03 times it is -0.024.
const glm::vec3 kInsidePlane{0.12f, -0.02f, 0.0f};
constexpr float kInsideFrom = -0.0239f;
constexpr float kInsideTo = 0.0379f;
const PartingSettings kInside{
    .from = {0.02f, 0.12f, 0.05f}, .to = {0.02f, 0.12f, -0.03f}, .strength = 1.0f};

// A disc with a slit is a ring in any triangulation.
TEST(Parting, IsASlitWithinADisc) {
    for (const std::uint32_t guides : {86u, 344u, 1376u}) {
        for (std::uint32_t seed = 0; seed < 2; ++seed) {
            const Parted parted =
                part(makeCap(), kInside, guides, RootPlacement::poisson_disc, seed);
            ASSERT_EQ(parted.roots.points.size(), guides);
            expectNothingCrosses(parted, kInsidePlane, kInsideFrom, kInsideTo);
            const Topology topology = topologyOf(parted.roots.triangles);
            EXPECT_TRUE(topology.is_manifold);
            EXPECT_EQ(topology.vertices, guides);
            EXPECT_EQ(topology.pieces, 1u);
            EXPECT_EQ(topology.loops, 2u) << guides << " " << seed;
            EXPECT_EQ(topology.euler, 0);
        }
    }
}

// A parting from the hairline leaves one disc, and one across the whole scalp leaves two.
TEST(Parting, ReachesTheHairline) {
    const PartingSettings half{
        .from = {0.0f, 0.0f, 0.15f}, .to = {0.0f, 0.12f, -0.02f}, .strength = 1.0f};
    const PartingSettings whole{
        .from = {0.0f, 0.05f, 0.2f}, .to = {0.0f, 0.05f, -0.2f}, .strength = 1.0f};  // to 1.33 rad
    for (const std::uint32_t guides : {86u, 344u, 1376u}) {
        const Parted one = part(makeCap(), half, guides);
        EXPECT_TRUE(one.line.endsAtBoundary()[0]);
        EXPECT_FALSE(one.line.endsAtBoundary()[1]);
        expectNothingCrosses(one, {1.0f, 0.0f, 0.0f}, -0.016f, 0.2f);
        const Topology slit = topologyOf(one.roots.triangles);
        EXPECT_TRUE(slit.is_manifold);
        EXPECT_EQ(slit.vertices, guides);
        EXPECT_EQ(slit.loops, 1u);
        EXPECT_EQ(slit.euler, 1);

        const Parted two = part(makeCap({.hairline = 1.2f}), whole, guides);
        expectNothingCrosses(two, {1.0f, 0.0f, 0.0f}, -0.2f, 0.2f);
        const Topology halves = topologyOf(two.roots.triangles);
        EXPECT_TRUE(halves.is_manifold);
        EXPECT_EQ(halves.vertices, guides);
        EXPECT_EQ(halves.pieces, 2u);
        EXPECT_EQ(halves.euler, 2);
    }
}

TEST(Parting, CutsASphere) {
    for (const auto placement : {RootPlacement::poisson_disc, RootPlacement::random}) {
        const Parted parted = part(makeSphere(0.1, 48, 24), kInside, 800, placement);
        expectNothingCrosses(parted, kInsidePlane, kInsideFrom, kInsideTo);
        const Topology topology = topologyOf(parted.roots.triangles);
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_EQ(topology.vertices, 800u);
        EXPECT_EQ(topology.loops, 1u);
        EXPECT_EQ(topology.euler, 1);  // a sphere with a slit is a disc
    }
}

TEST(Parting, CutsTheHead) {
    const Mesh head = importMesh(std::string(HAIRBENCH_SCENES_DIR) + "/assets/head.glb");
    // With fewer roots, the hairline would be within a triangle of the slit's end, 1 cm away.
    for (const std::uint32_t guides : {500u, 1376u}) {
        const Parted parted = part(head, {.strength = 1.0f}, guides);
        expectNothingCrosses(parted, {1.0f, 0.0f, 0.0f}, -0.01f, 0.055f);
        const Topology topology = topologyOf(parted.roots.triangles);
        EXPECT_TRUE(topology.is_manifold);
        EXPECT_EQ(topology.vertices, guides);
        EXPECT_EQ(topology.loops, 2u);
        EXPECT_EQ(topology.euler, 0);
    }
}

// On the line there are two roots every `spacing` or less. They are 4 % of it or half a millimetre
// from the line; the others are farther away than half of it.
TEST(Parting, HasTwoRows) {
    for (const std::uint32_t guides : {86u, 1376u}) {
        const Parted parted = part(makeCap(), kInside, guides);
        std::vector<double> left;
        std::vector<double> right;
        const double gap = std::max(0.04 * parted.spacing, 0.0005);
        for (const SurfacePoint& root : parted.roots.points) {
            const PartingLine::Place place = parted.line.place(glm::dvec3(root.position));
            if (place.distance > 1.01 * gap) {
                EXPECT_GT(place.distance, 0.4 * parted.spacing);
            } else {
                EXPECT_NEAR(std::abs(place.across), gap, 0.01 * gap);
                (place.across > 0.0 ? left : right).push_back(place.along);
            }
        }
        EXPECT_EQ(left.size(), right.size());
        std::ranges::sort(left);
        ASSERT_GE(left.size(), 2u);
        EXPECT_NEAR(left.front(), 0.0, 1e-6);
        EXPECT_NEAR(left.back(), parted.line.length(), 1e-6);
        for (std::size_t i = 1; i < left.size(); ++i)
            EXPECT_LE(left[i] - left[i - 1], parted.spacing + 1e-6);
    }
}

// The line on a sphere is an arc of a great circle: the plane through the ends and the middle.
TEST(Parting, LiesOnTheSurface) {
    const Parted parted = part(
        makeSphere(0.1, 96, 48),
        {.from = {0.0f, 0.2f, 0.2f}, .to = {0.0f, 0.2f, -0.2f}, .strength = 1.0f}, 100);
    EXPECT_NEAR(parted.line.length(), 0.1 * 0.5 * std::numbers::pi, 1e-3);  // a mesh of 96 columns
    for (const double part : {0.0, 0.3, 0.5, 1.0}) {
        const glm::dvec3 at = parted.line.position(part * parted.line.length());
        EXPECT_NEAR(glm::length(at), 0.1, 2e-4);
        EXPECT_NEAR(at.x, 0.0, 1e-9);
    }
    // From +z to -z over the top, the left is +y cross -z: -x.
    EXPECT_LT(glm::distance(parted.line.left(0.08), glm::dvec3(-1.0, 0.0, 0.0)), 1e-6);
}

TEST(Parting, IsLeftOutWithFewGuides) {
    const Parted parted = part(makeCap(), kInside, 5);
    EXPECT_EQ(parted.roots.points.size(), 5u);
    EXPECT_EQ(topologyOf(parted.roots.triangles).vertices, 5u);
}

TEST(Parting, NeedsALineOnTheScalp) {
    const Scalp scalp = extractScalp(makeCap());
    const NearestSurface surface(scalp.positions, scalp.triangles);
    const auto error = [&](const glm::vec3& from, const glm::vec3& to) {
        return errorText([&] { PartingLine(scalp, surface, {.from = from, .to = to}); });
    };
    EXPECT_THAT(error({0, -0.2f, 0.2f}, {0, -0.3f, 0.2f}), HasSubstr("is not over the scalp"));
    EXPECT_THAT(error({0, 0.1f, 0}, {0, 0.1f, 0}), HasSubstr("no length"));
}

}  // namespace
}  // namespace hair::groom
