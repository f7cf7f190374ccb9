#include "hair/rendering/strand_points.h"

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/expect_near_reference.h"

namespace hair {
namespace {

class StrandPointsTest : public GpuTest {
protected:
    static StrandPoints evaluate(const Groom& groom, const Settings& settings) {
        const DeviceHair hair(device(), groom, settings);
        return evaluateStrandPoints(device(), settings, hair.view());
    }

    static void expectReference(const Groom& groom, const Settings& settings) {
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
    Groom groom = tangledGroom(2);
    groom.root_normals.clear();
    expectReference(groom, {.strands = {.density = 7, .tessellation = 1}});
}

// 2^k pieces a segment, so that t of the coarse points is exactly that of fine ones.
TEST_F(StrandPointsTest, LowerLevelKeepsTheFirstStrandsAndWidensThem) {
    const Groom groom = tangledGroom(8);
    const StrandSettings strands{.density = 100, .tessellation = 4};
    const StrandPoints fine = evaluate(groom, {.strands = strands});
    for (const auto& [level, density, tessellation] :
         {std::tuple{1.0f, 50u, 2u}, {1.5f, 35u, 1u}, {2.0f, 25u, 1u}}) {
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
                // The same total width.
                ASSERT_FLOAT_EQ(kept.width * static_cast<float>(density), same.width * 100.0f);
            }
        }
    }
}

// near 1 m, far 16 m, level 4 there: level log2(distance). The centres of the triangles are
// 0.5, 1.8, 4 and 50 m away: levels 0, 0.85, 2 and 4.
TEST_F(StrandPointsTest, LevelFollowsTheLogarithmOfTheDistance) {
    struct Row {
        float distance;
        std::uint32_t density, tessellation;
    };
    constexpr Row kRows[] = {
        {0.5f, 64, 8},
        {1.8f, 36, 4},  // 64 / 1.8 = 35.6, 8 / 1.8 = 4.4
        {4.0f, 16, 2},
        {50.0f, 4, 1}};  // 64 / 16, 8 / 16 rounds up
    Groom groom;
    groom.vertices_per_strand = 3;
    for (const Row& row : kRows) {
        groom.root_triangles.push_back(
            {groom.strand_count, groom.strand_count + 1, groom.strand_count + 2});
        groom.strand_count += 3;
        // The corners add up to zero in x and y.
        for (const glm::vec2 corner : {glm::vec2{0.1f, 0.0f}, {0.0f, 0.1f}, {-0.1f, -0.1f}}) {
            for (int v = 0; v < 3; ++v) {
                groom.points.emplace_back(corner, -row.distance + static_cast<float>(v) * 0.1f);
            }
        }
    }
    const Settings settings{
        .strands = {.density = 64, .tessellation = 8, .root_width = 1.0f, .tip_width = 1.0f},
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
                const bool drawn = strand < row.density && point <= row.tessellation;
                const float width = drawn ? 64.0f / static_cast<float>(row.density) : -1.0f;
                ASSERT_FLOAT_EQ(points.at(triangle, strand, 1, point).width, width)
                    << triangle << " " << strand << " " << point;
            }
        }
    }
}

TEST_F(StrandPointsTest, NoTrianglesHaveNoPoints) {
    Groom groom = tangledGroom(4);
    groom.root_triangles.clear();
    EXPECT_TRUE(evaluate(groom, {}).records.empty());
}

TEST_F(StrandPointsTest, MorePointsThanABufferHoldsAreUnsupported) {
    Groom groom = unitTriangles(100000);
    EXPECT_THROW(
        evaluate(groom, {.strands = {.density = 4096, .tessellation = 64}}), engine::Unsupported);
}

}  // namespace
}  // namespace hair
