#include "hair/rendering/strand_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace hair::rendering {
namespace {

constexpr std::uint32_t kIsolines = 64;       // the limit of every device
constexpr std::uint32_t kLavapipe = 65536;    // vertices of a draw
constexpr std::uint32_t kUnlimited = std::numeric_limits<std::uint32_t>::max();

StrandPlan plan(
    const StrandSettings& strands, const LodSettings& lod = {}, std::uint32_t triangles = 136,
    std::uint32_t segments = 7) {
    return planStrands(triangles, segments, strands, lod, kIsolines);
}

// Counts how often the draws name each patch; a patch that does not exist fails.
std::vector<int> visits(const StrandPlan& plan, const std::vector<engine::Draw>& draws) {
    std::vector<int> count(plan.patches(), 0);
    for (const engine::Draw& draw : draws) {
        for (std::uint32_t i = 0; i < draw.instances; ++i) {
            for (std::uint32_t v = 0; v < draw.vertices; ++v) {
                // tessellation.vert
                const std::uint32_t patch =
                    (draw.first_instance + i) * plan.segments + draw.first_vertex + v;
                if (patch < count.size()) {
                    ++count[patch];
                } else {
                    ADD_FAILURE() << "patch " << patch << " of " << count.size();
                }
            }
        }
    }
    return count;
}

void expectEveryPatchOnceWithin(std::uint32_t limit, const StrandPlan& plan) {
    for (const Submission submission : {Submission::instanced, Submission::batched}) {
        const std::vector<engine::Draw> draws = planDraws(plan, submission, limit);
        EXPECT_TRUE(std::ranges::all_of(visits(plan, draws), [](int n) { return n == 1; }));
        for (const engine::Draw& draw : draws) {
            EXPECT_LE(std::uint64_t{draw.vertices} * plan.verticesPerPatch(), limit);
        }
    }
}

// 136 triangles, 7 segments, 64 strands per triangle, 4 pieces per segment: thesis sections 2.3.5
// and 6.
TEST(StrandPlan, HasTheThesissCounts) {
    const StrandPlan thesis = plan({.density = 64, .tessellation = 4});
    EXPECT_EQ(thesis.patches(), 952u);            // 136 * 7
    EXPECT_EQ(thesis.strands(), 8704u);           // 136 * 64
    EXPECT_EQ(thesis.drawnSegments(), 243712u);   // 8704 * 7 * 4
    EXPECT_EQ(thesis.verticesPerPatch(), 320u);   // 64 * 5
    const ExpectedCounts counts = expectedCounts(thesis);
    EXPECT_EQ(counts.tessellation_control_patches, 952u);
    EXPECT_EQ(counts.tessellation_evaluation_invocations, 304640u);  // 952 * 64 * 5
    EXPECT_EQ(counts.geometry_invocations, 243712u);
    EXPECT_EQ(counts.geometry_primitives, 487424u);  // two triangles per line
}

TEST(StrandPlan, CountsAreTheDevicesToSayWhereDistanceDecides) {
    const ExpectedCounts counts =
        expectedCounts(plan({.density = 64}, {.mode = LodMode::distance}));
    EXPECT_EQ(counts.tessellation_control_patches, 952u);
    EXPECT_FALSE(counts.tessellation_evaluation_invocations);
    EXPECT_FALSE(counts.geometry_invocations);
    EXPECT_FALSE(counts.geometry_primitives);
}

TEST(StrandPlan, SplitsADensityBeyondTheIsolines) {
    const StrandPlan hundred = plan({.density = 100});
    EXPECT_EQ(hundred.patches_per_triangle, 2u);
    EXPECT_EQ(hundred.strands_per_patch, 50u);
    EXPECT_EQ(hundred.patches(), 1904u);
    EXPECT_EQ(hundred.strands(), 13600u);
    const StrandPlan most = plan({.density = 4096});
    EXPECT_EQ(most.patches_per_triangle, 64u);
    EXPECT_EQ(most.strands_per_patch, 64u);
    const StrandPlan fits = plan({.density = 64});
    EXPECT_EQ(fits.patches_per_triangle, 1u);
    EXPECT_EQ(fits.strands_per_patch, 64u);
}

// The parts are strands [part * strands_per_patch, … + strands_per_patch), cut at the density.
TEST(StrandPlan, PartsHoldEveryStrandOnceAndAreNeverEmpty) {
    for (std::uint32_t density = 1; density <= 4096; ++density) {
        const StrandPlan p = plan({.density = density});
        ASSERT_LE(p.strands_per_patch, kIsolines) << density;
        ASSERT_GE(p.patches_per_triangle * p.strands_per_patch, density);
        ASSERT_LT((p.patches_per_triangle - 1) * p.strands_per_patch, density);
    }
}

float scaleOf(float level) { return std::exp2(-level); }

TEST(StrandPlan, LevelsOfDetailHalveTheStrandsAndDrawThePartOfOne) {
    EXPECT_EQ(drawnStrands(64, scaleOf(0.0f)), 64u);
    EXPECT_EQ(drawnStrands(64, scaleOf(1.0f)), 32u);
    EXPECT_EQ(drawnStrands(64, scaleOf(0.5f)), 46u);   // 45.25
    EXPECT_EQ(drawnStrands(100, scaleOf(0.5f)), 71u);  // 70.71
    EXPECT_EQ(drawnStrands(100, scaleOf(2.0f)), 25u);
    EXPECT_EQ(drawnStrands(3, scaleOf(1.0f)), 2u);  // 1.5
    EXPECT_EQ(drawnStrands(5, scaleOf(2.0f)), 2u);  // 1.25
    EXPECT_EQ(drawnStrands(1, scaleOf(8.0f)), 1u);  // never 0
    EXPECT_EQ(drawnStrands(4096, scaleOf(8.0f)), 16u);
}

TEST(StrandPlan, PiecesFallThroughNestedSets) {
    struct Row {
        std::uint32_t tessellation;
        float level;
        std::uint32_t pieces;
        bool morphs;
    };
    for (const Row& row :
         {Row{8, 0.0f, 8, false},
          {8, 0.99f, 8, true},  // 4.03 are needed
          {8, 1.0f, 4, false},
          {8, 1.01f, 4, true},  // 3.97
          {8, 3.0f, 1, false},
          {8, 8.0f, 1, false},
          {6, 1.0f, 3, false},
          {6, 1.1f, 3, true},  // 2.8 are needed: 3 has no divisor except itself
          {12, 0.9f, 12, true},  // 6.4
          {12, 1.5f, 6, true},   // 4.2
          {7, 2.0f, 7, true},    // 1.75
          {7, 3.0f, 1, false},
          {1, 0.5f, 1, false}}) {
        const DrawnPieces pieces = drawnPieces(row.tessellation, scaleOf(row.level));
        EXPECT_EQ(pieces.count, row.pieces) << row.tessellation << " at " << row.level;
        EXPECT_EQ(pieces.morphs, row.morphs) << row.tessellation << " at " << row.level;
    }
}

TEST(StrandPlan, ForcedLevelScalesBothCountsAndKeepsTheFinestOnes) {
    const StrandPlan p = plan({.density = 200, .tessellation = 8}, {.level = 1.0f});
    EXPECT_EQ(p.density, 200u);
    EXPECT_EQ(p.tessellation, 8u);
    EXPECT_EQ(p.forced_density, 100u);
    EXPECT_EQ(p.forced_tessellation, 4u);
    EXPECT_EQ(p.patches_per_triangle, 2u);
    EXPECT_EQ(p.strands(), 13600u);
    EXPECT_EQ(p.verticesPerPatch(), 250u);  // 50 * 5
}

TEST(StrandPlan, DistanceIgnoresTheForcedLevel) {
    const StrandPlan p =
        plan({.density = 64, .tessellation = 4}, {.mode = LodMode::distance, .level = 3.0f});
    EXPECT_EQ(p.forced_density, 64u);
    EXPECT_EQ(p.forced_tessellation, 4u);
}

TEST(PlanDraws, InstancedIsOneDrawOfTheThesissCase) {
    const auto draws =
        planDraws(plan({.density = 64, .tessellation = 4}), Submission::instanced, kLavapipe);
    ASSERT_EQ(draws.size(), 1u);
    EXPECT_EQ(draws[0].vertices, 7u);
    EXPECT_EQ(draws[0].instances, 136u);
}

// 65,536 / 320 = 204.8: 204 patches a draw, 952 = 4 * 204 + 136.
TEST(PlanDraws, BatchedFillsDrawsUpToTheLimit) {
    const auto draws =
        planDraws(plan({.density = 64, .tessellation = 4}), Submission::batched, kLavapipe);
    ASSERT_EQ(draws.size(), 5u);
    EXPECT_EQ(draws[0].vertices, 204u);
    EXPECT_EQ(draws[3].first_vertex, 612u);
    EXPECT_EQ(draws[4].vertices, 136u);
    for (const engine::Draw& draw : draws) EXPECT_EQ(draw.instances, 1u);
}

TEST(PlanDraws, UnlimitedDevicesTakeOneDraw) {
    for (const Submission submission : {Submission::instanced, Submission::batched}) {
        EXPECT_EQ(planDraws(plan({.density = 64}), submission, kUnlimited).size(), 1u);
        EXPECT_EQ(
            planDraws(plan({.density = 4096, .tessellation = 64}), submission, kUnlimited).size(),
            1u);
    }
}

TEST(PlanDraws, NamesEveryPatchOnceWithinTheLimit) {
    for (const std::uint32_t limit : {kLavapipe, kUnlimited}) {
        for (const std::uint32_t density : {1u, 63u, 64u, 65u, 100u, 1000u}) {
            for (const std::uint32_t tessellation : {1u, 4u, 64u}) {
                SCOPED_TRACE(testing::Message() << density << " x " << tessellation);
                expectEveryPatchOnceWithin(
                    limit, plan({.density = density, .tessellation = tessellation}));
            }
        }
    }
}

// 64 * 65 = 4,160 vertices a patch, 15 patches a draw, 63 segments = 4 * 15 + 3.
TEST(PlanDraws, SplitsTheSegmentsOfLongGuides) {
    const StrandPlan p = plan({.density = 64, .tessellation = 64}, {}, 3, 63);
    const auto draws = planDraws(p, Submission::instanced, kLavapipe);
    ASSERT_EQ(draws.size(), 5u);
    EXPECT_EQ(draws[0].vertices, 15u);
    EXPECT_EQ(draws[4].vertices, 3u);
    EXPECT_EQ(draws[4].first_vertex, 60u);
    EXPECT_EQ(draws[4].instances, 3u);
    expectEveryPatchOnceWithin(kLavapipe, p);
}

}  // namespace
}  // namespace hair::rendering
