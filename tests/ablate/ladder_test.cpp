#include "benchmarks/ablate/stops.h"

#include <gmock/gmock.h>

namespace benchmarks::ablate {
namespace {

using hair::rendering::StrandStage;
using testing::ElementsAre;
using testing::StartsWith;

std::vector<Stop> stopsOf(const hair::Settings& settings) {
    std::vector<Stop> stops;
    for (const StopPlan& plan : planStops(settings, 1)) stops.push_back(plan.stop);
    return stops;
}

StopPlan stopOf(const hair::Settings& settings, Stop stop) {
    for (const StopPlan& plan : planStops(settings, 1))
        if (plan.stop == stop) return plan;
    ADD_FAILURE() << "no " << stopName(stop);
    return {};
}

TEST(Ladder, HasARungPerStage) {
    EXPECT_THAT(
        stopsOf({}), ElementsAre(
                         Stop::empty, Stop::vertex, Stop::tessellation_1, Stop::tessellation,
                         Stop::geometry, Stop::raster, Stop::fragment, Stop::pass, Stop::clipped,
                         Stop::watched_vertex, Stop::watched_evaluation, Stop::watched_geometry));
}

TEST(Ladder, AddsSamplesLast) {
    hair::Settings settings;
    settings.render.msaa = 4;
    for (const StopPlan& plan : planStops(settings, 1)) {
        const bool multisampled =
            plan.stop == Stop::msaa || plan.stop == Stop::raster_msaa || plan.stop == Stop::pass;
        EXPECT_EQ(plan.settings.render.msaa, multisampled ? 4u : 1u) << stopName(plan.stop);
    }
    EXPECT_EQ(stopOf(settings, Stop::msaa).stages, hair::rendering::StrandStages{});
}

// Level of detail 2 turns 4 segments into 1.
TEST(Ladder, LeavesOutOneSegmentWhereThereIsNoMore) {
    hair::Settings settings;
    settings.strands.tessellation = 1;
    EXPECT_THAT(stopsOf(settings), testing::Not(testing::Contains(Stop::tessellation_1)));
    settings.strands.tessellation = 4;
    settings.lod.level = 2.0f;
    EXPECT_THAT(stopsOf(settings), testing::Not(testing::Contains(Stop::tessellation_1)));
    settings.lod.mode = hair::LodMode::distance;
    EXPECT_THAT(stopsOf(settings), testing::Contains(Stop::tessellation_1));
}

TEST(Ladder, WatchesTheLastStageOfWhatIsDiscarded) {
    EXPECT_EQ(
        stopOf({}, Stop::geometry).stages, (hair::rendering::StrandStages{
                                               .last = hair::rendering::StrandStage::geometry,
                                               .watched = hair::rendering::StrandStage::geometry,
                                               .watch = 1}));
    EXPECT_EQ(
        stopOf({}, Stop::raster).stages,
        (hair::rendering::StrandStages{.last = hair::rendering::StrandStage::raster}));
    EXPECT_EQ(stopOf({}, Stop::pass).stages, hair::rendering::StrandStages{});
}

TEST(Ladder, SaysWhatItIsNotFor) {
    EXPECT_EQ(ablationObstacle({}), "");
    hair::Settings settings;
    settings.strands.backend = hair::Backend::pulling_geometry;
    EXPECT_THAT(ablationObstacle(settings), StartsWith("/strands/backend: "));
    settings = {};
    settings.render.hair = false;
    EXPECT_THAT(ablationObstacle(settings), StartsWith("/render/hair: "));
    settings = {};
    settings.render.transparency = hair::Transparency::fragment_list;
    EXPECT_THAT(ablationObstacle(settings), StartsWith("/render/transparency: "));
}

}  // namespace
}  // namespace benchmarks::ablate
