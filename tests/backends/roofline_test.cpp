#include "benchmarks/run/backends.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"

namespace benchmarks::measure {
namespace {

using hair::Backend;

// Returns 10 strands of 7 segments of 4 pieces. A strand has 29 points, or 35 if segments share
// none.
StrandCounts fewStrands() {
    return {
        .guide_vertices = 24,
        .root_triangles = 5,
        .strands = 10,
        .segments = 7,
        .pieces = 4,
        .covered_samples = 400,
        .covered_pixels = 100,
        .lights = 2,
        .color_bytes = 4};
}

// From the table of docs/measuring.md. Operations: 81 + 84 per point, 22 per end, 34 per corner, 75
// per pixel, and 60 per pixel and light. Bytes: 16 per guide vertex, 12 per triangle and 12 per
// sample.
TEST(StrandWork, IsThatOfTheTable) {
    EXPECT_EQ(fewStrands().points(), 290u);
    const auto work = strandWork(Backend::tessellation, fewStrands());
    ASSERT_TRUE(work);
    EXPECT_EQ(work->bytes, 16 * 24 + 12 * 5 + 12 * 400);
    EXPECT_EQ(work->operations.size(), 2u);
    EXPECT_EQ(work->operations.at(StageKind::vertex), 350 * (81 + 84) + 2 * 280 * (22 + 2 * 34));
    EXPECT_EQ(work->operations.at(StageKind::fragment), 100 * (75 + 2 * 60));

    const auto expanded = strandWork(Backend::expanded, fewStrands());
    ASSERT_TRUE(expanded);
    EXPECT_EQ(expanded->bytes, work->bytes + 2 * 16 * 290 + 5 * 4 * 10);
    EXPECT_EQ(expanded->operations.at(StageKind::compute), 10 * 7 * 81 + 290 * (84 + 100));
    EXPECT_EQ(expanded->operations.at(StageKind::vertex), 2 * 290 * (22 + 34));

    const auto mesh = strandWork(Backend::mesh, fewStrands());
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->bytes, work->bytes);
    EXPECT_EQ(mesh->operations.at(StageKind::compute), 10 * 7 * 81 + 290 * (84 + 22 + 2 * 34));
    EXPECT_EQ(mesh->operations.at(StageKind::fragment), 100 * (75 + 2 * 60));
    EXPECT_EQ(mesh->operations.size(), 2u);

    const auto software = strandWork(Backend::software, fewStrands());
    ASSERT_TRUE(software);
    EXPECT_EQ(software->operations.size(), 1u);
    EXPECT_EQ(
        software->operations.at(StageKind::compute), 10 * 7 * 81 + 290 * (84 + 100) + 290 * 100 +
                                                         280 * 60 + 400 * 8 +
                                                         400 * (2 * 100 + 60 + 75 + 2 * 60));
    EXPECT_EQ(
        software->bytes, 16 * 24 + 12 * 5 + 2 * 16 * 290 + 2 * 4 * 10 + 400 * (4 + 6 * 8 + 4 + 4));

    // Two corners of 12 bytes for each point, written and read.
    const auto rays = strandWork(Backend::rays, fewStrands());
    ASSERT_TRUE(rays);
    EXPECT_EQ(rays->operations.size(), 1u);
    EXPECT_EQ(
        rays->operations.at(StageKind::compute),
        10 * 7 * 81 + 290 * (84 + 100) + 290 * 22 + 400 * (2 * 100 + 60 + 75 + 2 * 60));
    EXPECT_EQ(rays->bytes, software->bytes + 2 * 24 * 290);
}

TEST(StrandWork, GrowsWithEvaluationsThatABackEndRepeats) {
    const auto vertex = [](Backend backend) {
        return strandWork(backend, fewStrands())->operations.at(StageKind::vertex);
    };
    EXPECT_GT(vertex(Backend::pulling), vertex(Backend::pulling_geometry));
    EXPECT_GT(vertex(Backend::pulling_geometry), vertex(Backend::tessellation));
    EXPECT_GT(vertex(Backend::tessellation), vertex(Backend::expanded));
}

TEST(LeastTime, IsThatOfTheSlowestPart) {
    DeviceLimits limits;
    limits.copy_bandwidth = {1.0, 10.0, 100.0};  // GB/s, the median 10
    limits.arithmetic = {{StageKind::vertex, {2.0}}, {StageKind::fragment, {4.0}}};
    StrandWork work{.bytes = 1e9, .operations = {{StageKind::vertex, 1e6}}};
    EXPECT_DOUBLE_EQ(leastTime(work, limits), 100.0);  // 1 GB at 10 GB/s
    work.operations[StageKind::vertex] = 1e9;
    EXPECT_DOUBLE_EQ(leastTime(work, limits), 500.0);
    work.operations[StageKind::fragment] = 4e9;
    EXPECT_DOUBLE_EQ(leastTime(work, limits), 1000.0);
}

class LimitsTest : public GpuTest {};

// No machine moves a byte in less than 10 fs or takes a second for a megabyte.
TEST_F(LimitsTest, AreMeasuredOfEveryStage) {
    const DeviceLimits limits = measureLimits(device());
    ASSERT_EQ(limits.copy_bandwidth.size(), 5u);
    for (const double rate : limits.copy_bandwidth) {
        EXPECT_GT(rate, 1e-3);
        EXPECT_LT(rate, 1e5);
    }
    for (const StageKind kind : {StageKind::compute, StageKind::vertex, StageKind::fragment}) {
        ASSERT_EQ(limits.arithmetic.at(kind).size(), 5u) << stageName(kind);
        for (const double rate : limits.arithmetic.at(kind)) {
            EXPECT_GT(rate, 1e-3) << stageName(kind);
            EXPECT_LT(rate, 1e6) << stageName(kind);
        }
    }
}

}  // namespace
}  // namespace benchmarks::measure
