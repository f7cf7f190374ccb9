#include "benchmarks/measure/case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks {
namespace {

using testing::ElementsAre;

// One triangle with two strands of two segments of two pieces. A point's x and width are its index.
hair::rendering::StrandPoints numbered() {
    hair::rendering::StrandPoints points;
    points.plan = {
        .triangles = 1,
        .segments = 2,
        .density = 2,
        .tessellation = 2,
        .forced_density = 2,
        .forced_tessellation = 2};
    for (int i = 0; i < 12; ++i) {
        const auto x = static_cast<float>(i);
        points.records.push_back({.position = {x, 0.0f, 0.0f}, .width = x});
    }
    return points;
}

TEST(DrawnStrands, HaveJointsOfSegmentsOnce) {
    const hair::groom::StrandSet set = measure::drawnStrands(numbered());
    EXPECT_THAT(set.ends, ElementsAre(5u, 10u));
    EXPECT_THAT(set.widths.values, ElementsAre(0, 1, 2, 4, 5, 6, 7, 8, 10, 11));
    for (std::size_t i = 0; i < set.points.size(); ++i)
        EXPECT_EQ(set.points[i].x, set.widths.values[i]);
    EXPECT_EQ(set.metres_per_unit, 1.0);
}

// The result of level of detail by distance: the first strand has half the pieces, and the second
// is gone.
TEST(DrawnStrands, LackWhatIsNotDrawn) {
    hair::rendering::StrandPoints points = numbered();
    for (const std::size_t i : {2, 5, 6, 7, 8, 9, 10, 11}) points.records[i].width = -1.0f;
    const hair::groom::StrandSet set = measure::drawnStrands(points);
    EXPECT_THAT(set.ends, ElementsAre(3u));
    EXPECT_THAT(set.widths.values, ElementsAre(0, 1, 4));
}

TEST(GuideStrands, AreTheGroomsAtOtherPlaces) {
    hair::groom::Groom groom;
    groom.strand_count = 3;
    groom.vertices_per_strand = 2;
    groom.root_triangles = {{0, 1, 2}};
    const hair::groom::StrandSet set =
        measure::guideStrands(groom, std::vector<glm::vec3>(6, glm::vec3(4.0f)));
    EXPECT_THAT(set.ends, ElementsAre(2u, 4u, 6u));
    EXPECT_EQ(set.points[5], glm::vec3(4.0f));
    EXPECT_THAT(set.root_triangles, ElementsAre(std::array{0u, 1u, 2u}));
    EXPECT_FALSE(set.widths.known());
}

}  // namespace
}  // namespace benchmarks
