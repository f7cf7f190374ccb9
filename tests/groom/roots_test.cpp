#include "hair/groom/growth/roots.h"

#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/groom/surface_meshes.h"
#include "tests/groom/test_meshes.h"
#include "tests/largest_difference.h"

namespace hair::groom {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Roots rootsOf(const Mesh& mesh, const RootOptions& options) {
    const Scalp scalp = extractScalp(mesh);
    return placeRoots(scalp, NearestSurface(scalp.positions, scalp.triangles), options);
}

// The grid's x and z over its width as texture coordinates.
Mesh texturedGrid(std::uint32_t size) {
    Mesh mesh = makeGrid(size, size, [](auto, auto) { return false; });
    for (const glm::vec3& position : mesh.positions)
        mesh.texture_coordinates.emplace_back(glm::vec2(position.x, position.z) / float(size));
    return mesh;
}

// Four grey columns; near x = 1/8, 3/8, ... of the width they are as given.
Texture columns(const std::array<float, 4>& brightness) {
    return Texture(4, 1, {brightness.begin(), brightness.end()});
}

double smallestDistance(const Roots& roots) {
    Extremes distances;
    for (std::size_t i = 0; i < roots.points.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
            distances.add(
                double{glm::distance(roots.points[i].position, roots.points[j].position)});
    }
    return distances.least();
}

// Bins of equal area on a sphere: 6 of its height (Archimedes) times 8 of its azimuth. Chi-square
// with 47 degrees of freedom exceeds 87.8 once in 3,000 times, and for two of four seeds once in
// 10^6 times. The mesh, of 96 by 48 pieces, has the sphere's area to 0.1 %.
TEST(PlaceRoots, IsUniformInAreaAtRandom) {
    int high = 0;
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        const Roots roots = rootsOf(
            makeSphere(1.0, 96, 48),
            {.guides = 2400, .seed = seed, .placement = RootPlacement::random});
        std::array<double, 48> bins{};
        for (const SurfacePoint& root : roots.points) {
            const glm::dvec3 d = glm::normalize(glm::dvec3(root.position));
            const double turn = std::atan2(d.x, d.z) / (2.0 * std::numbers::pi) + 0.5;
            const auto row = std::min(static_cast<std::size_t>(3.0 * (d.y + 1.0)), std::size_t{5});
            const auto column = std::min(static_cast<std::size_t>(8.0 * turn), std::size_t{7});
            bins[8 * row + column] += 1.0;
        }
        double chi_square = 0.0;
        for (const double bin : bins) chi_square += (bin - 50.0) * (bin - 50.0) / 50.0;
        high += chi_square > 87.8 ? 1 : 0;
    }
    EXPECT_LT(high, 2);
}

// See sample_elimination_test: 1.07 sqrt(A / n) is the maximum; independent points have 0.66
// sqrt(A) / n.
TEST(PlaceRoots, KeepsADistanceOnAnySurface) {
    for (const Mesh& mesh : {makeSphere(0.1, 48, 24), makeTorus(0.1, 0.04, 48, 24)}) {
        const double area = extractScalp(mesh).area();
        const Roots roots = rootsOf(mesh, {.guides = 500, .seed = 3});
        EXPECT_EQ(roots.boundary_count, 0u);
        EXPECT_GT(smallestDistance(roots), 0.6 * 1.07 * std::sqrt(area / 500.0));
        EXPECT_EQ(topologyOf(roots.triangles).vertices, 500u);
    }
}

// Random roots on a disc don't lie in rows.
TEST(PlaceRoots, HasAHairlineForSpreadRootsOfADiscAlone) {
    EXPECT_EQ(rootsOf(makeCap(), {.guides = 86}).boundary_count, 34u);
    EXPECT_EQ(
        rootsOf(makeCap(), {.guides = 86, .placement = RootPlacement::random}).boundary_count, 0u);
    const Texture white(1, 1, {1.0f});
    EXPECT_EQ(rootsOf(texturedGrid(8), {.guides = 86, .mask = &white}).boundary_count, 0u);
    const auto ring = [](std::uint32_t x, std::uint32_t z) { return x == 1 && z == 1; };
    EXPECT_EQ(rootsOf(makeGrid(3, 3, ring), {.guides = 86}).boundary_count, 0u);
}

// The brightness is linear between the middles of pixels, so a quarter of the width has the mean
// of its two halves. With columns 0, 0.5, 1, 1 (continued at the edges) that is 1/16, 1/2, 15/16
// and 1. A count of n p has the standard deviation sqrt(n p (1 - p)) or less; four are allowed.
TEST(PlaceRoots, FollowsTheMask) {
    const Texture mask = columns({0.0f, 0.5f, 1.0f, 1.0f});
    const std::array<double, 4> means{1.0 / 16, 0.5, 0.9375, 1.0};
    for (const auto placement : {RootPlacement::poisson_disc, RootPlacement::random}) {
        const Roots roots = rootsOf(
            texturedGrid(8), {.guides = 2000, .seed = 2, .placement = placement, .mask = &mask});
        ASSERT_EQ(roots.points.size(), 2000u);
        std::array<double, 4> counts{};
        for (const SurfacePoint& root : roots.points)
            counts[std::min(static_cast<std::size_t>(root.position.x / 2.0f), std::size_t{3})] +=
                1.0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double p = means[i] / (means[0] + means[1] + means[2] + means[3]);
            EXPECT_NEAR(counts[i], 2000.0 * p, 4.0 * std::sqrt(2000.0 * p * (1.0 - p)))
                << "column " << i;
        }
    }
}

// Columns 6 to 9 of sixteen are black: no roots from x = 6.5 to 9.5.
TEST(PlaceRoots, LeavesBlackBare) {
    std::vector<float> stripe(16, 1.0f);
    for (std::size_t i = 6; i < 10; ++i) stripe[i] = 0.0f;
    const Texture mask(16, 1, stripe);
    for (const auto placement : {RootPlacement::poisson_disc, RootPlacement::random}) {
        const Roots roots = rootsOf(
            texturedGrid(16), {.guides = 600, .seed = 1, .placement = placement, .mask = &mask});
        for (const SurfacePoint& root : roots.points)
            EXPECT_TRUE(root.position.x <= 6.5f || root.position.x >= 9.5f) << root.position.x;
        for (const auto& triangle : roots.triangles) {
            int left = 0;
            for (const std::uint32_t root : triangle)
                left += roots.points[root].position.x < 8.0f ? 1 : 0;
            EXPECT_TRUE(left == 0 || left == 3);
        }
        EXPECT_EQ(topologyOf(roots.triangles).pieces, 2u);
    }
}

TEST(PlaceRoots, KeepsADistanceUnderAMask) {
    const Texture mask = columns({0.3f, 0.5f, 0.7f, 1.0f});
    const Roots roots = rootsOf(texturedGrid(8), {.guides = 300, .seed = 1, .mask = &mask});
    // The roots are chosen from at least as many candidates, spread over the whole area.
    EXPECT_EQ(roots.points.size(), 300u);
    const double mean = 0.625;  // of the mask; its maximum is 1
    EXPECT_GT(smallestDistance(roots), 0.5 * 1.07 * std::sqrt(64.0 * mean / 300.0));
}

// One pixel in 4,096 is white and the others are nearly black. There are still as many roots as
// requested.
TEST(PlaceRoots, TakesAVeryUnevenMask) {
    std::vector<float> pixels(64 * 64, 0.02f);
    pixels[32 * 64 + 32] = 1.0f;
    const Texture mask(64, 64, pixels);
    for (const auto placement : {RootPlacement::poisson_disc, RootPlacement::random}) {
        const Roots roots = rootsOf(
            texturedGrid(8), {.guides = 500, .seed = 1, .placement = placement, .mask = &mask});
        EXPECT_EQ(roots.points.size(), 500u);
    }
}

TEST(PlaceRoots, RefusesMasksThatLeaveNothing) {
    const Texture black(1, 1, {0.0f});
    EXPECT_EQ(
        errorText([&] { rootsOf(texturedGrid(4), {.guides = 10, .mask = &black}); }),
        "the mask is black all over the scalp");
    const Texture white(1, 1, {1.0f});
    EXPECT_THAT(
        errorText([&] { rootsOf(makeCap(), {.guides = 10, .mask = &white}); }),
        HasSubstr("no texture coordinates"));
}

TEST(PlaceRoots, TakesAnyNumberOfGuides) {
    const Texture white(1, 1, {1.0f});
    for (const Mesh& mesh : {makeCap(), makeSphere(0.1, 24, 12), texturedGrid(2)}) {
        const bool has_texture = !mesh.texture_coordinates.empty();
        for (const auto placement : {RootPlacement::poisson_disc, RootPlacement::random}) {
            for (std::uint32_t guides = 1; guides < 60; guides += guides < 8 ? 1 : 13) {
                const Roots roots = rootsOf(
                    mesh, {.guides = guides,
                           .seed = guides,
                           .placement = placement,
                           .mask = has_texture ? &white : nullptr});
                ASSERT_EQ(roots.points.size(), guides);
                EXPECT_FALSE(roots.triangles.empty());
                const std::array triangle{0u, guides - 1, guides - 1};
                if (guides < 3) {
                    EXPECT_THAT(roots.triangles, ElementsAre(triangle));
                }
            }
        }
    }
}

TEST(HairlineLengths, AreEvenWithoutCuts) {
    EXPECT_THAT(hairlineLengths(10.0, 4, {}, 0.1), ElementsAre(0.0, 2.5, 5.0, 7.5));
}

TEST(HairlineLengths, HaveARootOnBothSidesOfACut) {
    // Three steps from 3.5 to 12.5.
    EXPECT_THAT(hairlineLengths(10.0, 4, {3.0}, 0.5), ElementsAre(3.5, 6.5, 9.5, 12.5));
    // From 1.5 to 3.5 and from 4.5 to 10.5 there are 6 roots on a length of 8: a quarter of them on
    // the first part, the rest on the second.
    EXPECT_THAT(
        hairlineLengths(10.0, 6, {4.0, 1.0}, 0.5), ElementsAre(1.5, 3.5, 4.5, 6.5, 8.5, 10.5));
    EXPECT_THAT(hairlineLengths(10.0, 4, {4.0, 1.0}, 0.5), ElementsAre(1.5, 3.5, 4.5, 10.5));
}

}  // namespace
}  // namespace hair::groom
