#include "hair/rendering/renderer.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/expect_near_reference.h"

namespace hair::rendering {
namespace {

class StrandPointsTest : public GpuTest {
protected:
    static StrandPoints evaluate(const groom::Groom& groom, const Settings& settings) {
        const DeviceHair hair(device(), groom, settings);
        return evaluateStrandPoints(device(), settings, hair.view());
    }

    static void expectReference(const groom::Groom& groom, const Settings& settings) {
        expectNearReference(evaluate(groom, settings), groom, settings);
    }
};

TEST_F(StrandPointsTest, AgreeWithTheThesissEquations) {
    expectReference(tangledGroom(8), {.seed = 5, .strands = {.density = 16, .tessellation = 4}});
}

TEST_F(StrandPointsTest, AgreeWhereATriangleTakesSeveralPatches) {
    expectReference(tangledGroom(3), {.strands = {.density = 201, .tessellation = 3}});
}

TEST_F(StrandPointsTest, AgreeForThePublishedProgramsOptions) {
    expectReference(
        tangledGroom(5), {.strands = {
                              .density = 20,
                              .tessellation = 5,
                              .curve = Curve::bspline_unpinned,
                              .taper = Taper::segment}});
}

TEST_F(StrandPointsTest, AgreeOnGuidesOfOneSegmentAndFlatRoots) {
    groom::Groom groom = tangledGroom(2);
    groom.root_normals.clear();
    expectReference(groom, {.strands = {.density = 7, .tessellation = 1}});
}

// 2^k pieces per segment, so that the coarse points' t are exactly those of fine points.
TEST_F(StrandPointsTest, LowerLevelKeepsTheFirstStrandsAndWidensThem) {
    const groom::Groom groom = tangledGroom(8);
    const StrandSettings strands{.density = 100, .tessellation = 4};
    const StrandPoints fine = evaluate(groom, {.strands = strands});
    for (const auto& [level, density, tessellation] :
         {std::tuple{1.0f, 50u, 2u}, {2.0f, 25u, 1u}}) {
        const StrandPoints coarse = evaluate(groom, {.strands = strands, .lod = {.level = level}});
        ASSERT_EQ(coarse.plan.forced_density, density);
        ASSERT_EQ(coarse.plan.forced_tessellation, tessellation);
        const std::uint32_t step = 4 / tessellation;
        for (std::uint32_t strand = 0; strand < density; ++strand) {
            for (std::uint32_t point = 0; point <= tessellation; ++point) {
                const auto& kept = coarse.at(1, strand, 3, point);
                const auto& same = fine.at(1, strand, 3, step * point);
                ASSERT_EQ(kept.position, same.position);
                ASSERT_EQ(kept.tangent, same.tangent);
                // The total width is the same.
                ASSERT_FLOAT_EQ(kept.width * static_cast<float>(density), same.width * 100.0f);
            }
        }
    }
}

// near is 1 m and far 16 m, with level 4 there: level log2(distance). The centres of the triangles
// are
// 0.5, 1.8, 4 and 50 m away: levels 0, 0.85, 2 and 4.
TEST_F(StrandPointsTest, LevelFollowsTheLogarithmOfTheDistance) {
    struct Row {
        float distance;
        float density;
        std::uint32_t tessellation;
    };
    constexpr Row kRows[] = {
        {0.5f, 64.0f, 8},
        {1.8f, 64.0f / 1.8f, 8},  // 35.6; 8 / 1.8 = 4.4, of the nested sets 8 and 4
        {4.0f, 16.0f, 2},
        {50.0f, 4.0f, 1}};  // 64 / 16, 8 / 16 and at least 1
    groom::Groom groom;
    groom.vertices_per_strand = 3;
    for (const Row& row : kRows) {
        groom.root_triangles.push_back(
            {groom.strand_count, groom.strand_count + 1, groom.strand_count + 2});
        groom.strand_count += 3;
        // The corners' coordinates add up to zero in x and y.
        for (const glm::vec2 corner : {glm::vec2{0.1f, 0.0f}, {0.0f, 0.1f}, {-0.1f, -0.1f}}) {
            for (int v = 0; v < 3; ++v) {
                groom.points.emplace_back(corner, -row.distance + static_cast<float>(v) * 0.1f);
            }
        }
    }
    const Settings settings{
        .strands = {.density = 64, .tessellation = 8, .root_width = 0.01f, .tip_width = 0.01f},
        .lod =
            {.mode = LodMode::distance,
             .near_distance = 1.0f,
             .far_distance = 16.0f,
             .maximum_level = 4.0f},
        .camera = {.position = {0.0f, 0.0f, 0.0f}}};
    const StrandPoints points = evaluate(groom, settings);
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
        const Row& row = kRows[triangle];
        for (std::uint32_t strand = 0; strand < 64; ++strand) {
            for (std::uint32_t point = 0; point <= 8; ++point) {
                // The last strand has the fraction's part.
                const float share = std::min(row.density - static_cast<float>(strand), 1.0f);
                const bool drawn = share > 0.0f && point <= row.tessellation;
                const float width = drawn ? 0.01f * share * 64.0f / row.density : -1.0f;
                // The level by logarithms is off by about 2^-20.
                ASSERT_NEAR(points.at(triangle, strand, 1, point).width, width, 1e-6f)
                    << triangle << " " << strand << " " << point;
            }
        }
    }
}

TEST_F(StrandPointsTest, NoTrianglesHaveNoPoints) {
    groom::Groom groom = tangledGroom(4);
    groom.root_triangles.clear();
    EXPECT_TRUE(evaluate(groom, {}).records.empty());
}

// 4 triangles x 5 strands x 7 segments x 4 points: several whole parts and a rest, none of whole
// strands. The other tests compare the points of a single part with the reference. Offsets are on
// too, because the device makes their frames once.
TEST_F(StrandPointsTest, AreTheSameInParts) {
    const groom::Groom groom = tangledGroom(8);
    const Settings settings{
        .strands = {.density = 5, .tessellation = 3, .curl = {.radius = 0.01f}}};
    const DeviceHair hair(device(), groom, settings);
    const StrandPoints whole = evaluateStrandPoints(device(), settings, hair.view());
    ASSERT_EQ(whole.records.size(), 560u);
    for (const std::uint32_t most : {99u, 280u, 559u}) {
        const StrandPoints parts = evaluateStrandPoints(device(), settings, hair.view(), most);
        ASSERT_EQ(parts.records.size(), whole.records.size()) << most;
        EXPECT_EQ(
            std::memcmp(
                parts.records.data(), whole.records.data(),
                whole.records.size() * sizeof(whole.records[0])),
            0)
            << most;
    }
}

TEST_F(StrandPointsTest, MorePointsThanShadersNumberAreUnsupported) {
    groom::Groom groom = unitTriangles(100000);
    EXPECT_THROW(
        evaluate(groom, {.strands = {.density = 4096, .tessellation = 64}}), engine::Unsupported);
}

}  // namespace
}  // namespace hair::rendering
