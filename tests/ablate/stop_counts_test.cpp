#include "benchmarks/ablate/stops.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/ablate/ladder_walk.h"
#include "engine/instance.h"

namespace benchmarks::ablate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// 2 triangles of 3 segments give 6 patches. With 5 strands of 4 pieces each they have 150 ends and
// 120 lines.
hair::rendering::StrandPlan smallPlan() {
    return hair::rendering::planStrands(2, 3, {.density = 5, .tessellation = 4}, {}, 64);
}

engine::StatisticCounts
countsWith(std::initializer_list<std::pair<std::string_view, std::uint64_t>> values) {
    engine::StatisticCounts counts{};
    for (const auto& [name, value] : values) {
        const auto at = std::ranges::find(engine::kStatisticNames, name);
        counts[static_cast<std::size_t>(at - engine::kStatisticNames.begin())] = value;
    }
    return counts;
}

StopPlan stopOf(Stop wanted) {
    hair::Settings settings;
    settings.render.msaa = 4;
    for (StopPlan& plan : planStops(settings, 1))
        if (plan.stop == wanted) return plan;
    return {};
}

StopCounts allRan() {
    return {
        .statistics = countsWith(
            {{"input_assembly_vertices", 6},
             {"vertex_invocations", 6},
             {"tessellation_control_patches", 6},
             {"tessellation_evaluation_invocations", 150},
             {"geometry_invocations", 120},
             {"geometry_primitives", 240},
             {"fragment_invocations", 77}}),
        .samples_passed = 70,
        .watched_invocations = 120};
}

std::vector<std::string> warningsOf(
    Stop stop, const StopCounts& counts, engine::DeviceType device_type = engine::DeviceType::cpu) {
    const StopPlan plan = stopOf(stop);
    engine::DeviceInfo device;
    device.type = device_type;
    return countWarnings(plan, stopStatistics(plan, smallPlan(), counts, false), device);
}

TEST(StopCounts, AreRightWhereAllRan) {
    EXPECT_THAT(warningsOf(Stop::fragment, allRan()), IsEmpty());
    EXPECT_THAT(warningsOf(Stop::watched_geometry, allRan()), IsEmpty());
}

TEST(StopCounts, FindAStageThatDidNotRun) {
    StopCounts counts = allRan();
    counts.samples_passed = 0;
    EXPECT_THAT(warningsOf(Stop::geometry, counts), IsEmpty());
    counts.statistics = countsWith(
        {{"vertex_invocations", 6},
         {"tessellation_control_patches", 6},
         {"tessellation_evaluation_invocations", 150},
         {"geometry_primitives", 240}});
    counts.watched_invocations = 0;
    EXPECT_THAT(
        warningsOf(Stop::geometry, counts),
        ElementsAre(
            "geometry: geometry_invocations: 0, expected 120", "geometry: seen: 0, expected 120"));
}

TEST(StopCounts, FindAStageThatRanTooMuch) {
    StopCounts counts = allRan();
    EXPECT_THAT(
        warningsOf(Stop::geometry, counts),
        ElementsAre("geometry: samples_passed: 70, expected 0"));
    EXPECT_THAT(
        warningsOf(Stop::clipped, counts), ElementsAre(
                                               "clipped: fragment_invocations: 77, expected 0",
                                               "clipped: samples_passed: 70, expected 0"));
    EXPECT_THAT(
        warningsOf(Stop::empty, counts), ElementsAre(
                                             "empty: input_assembly_vertices: 6, expected 0",
                                             "empty: samples_passed: 70, expected 0"));
    counts.samples_passed = 0;
    EXPECT_THAT(
        warningsOf(Stop::raster, counts), ElementsAre("raster: samples_passed: 0, expected some"));
}

// A GPU may evaluate a vertex more than once. A CPU device evaluates it once. Every device counts
// lines once.
TEST(StopCounts, MayBeMoreOnGpusInStagesThatMakeVertices) {
    StopCounts counts = allRan();
    counts.samples_passed = 0;
    counts.watched_invocations = 190;
    counts.statistics = countsWith(
        {{"vertex_invocations", 8},
         {"tessellation_control_patches", 6},
         {"tessellation_evaluation_invocations", 190}});
    EXPECT_THAT(warningsOf(Stop::tessellation, counts, engine::DeviceType::discrete), IsEmpty());
    EXPECT_THAT(
        warningsOf(Stop::tessellation, counts, engine::DeviceType::cpu),
        ElementsAre(
            "tessellation: vertex_invocations: 8, expected 6",
            "tessellation: tessellation_evaluation_invocations: 190, expected 150",
            "tessellation: seen: 190, expected 150"));

    counts.watched_invocations = 149;
    counts.statistics = countsWith(
        {{"vertex_invocations", 6},
         {"tessellation_control_patches", 5},
         {"tessellation_evaluation_invocations", 149}});
    EXPECT_THAT(
        warningsOf(Stop::tessellation, counts, engine::DeviceType::integrated),
        ElementsAre(
            "tessellation: tessellation_control_patches: 5, expected at least 6",
            "tessellation: tessellation_evaluation_invocations: 149, expected at least 150",
            "tessellation: seen: 149, expected at least 150"));

    StopCounts lines = allRan();
    lines.samples_passed = 0;
    lines.watched_invocations = 121;
    EXPECT_THAT(
        warningsOf(Stop::geometry, lines, engine::DeviceType::discrete),
        ElementsAre("geometry: seen: 121, expected 120"));
    StopCounts empty = allRan();
    EXPECT_THAT(
        warningsOf(Stop::empty, empty, engine::DeviceType::discrete),
        ElementsAre(
            "empty: input_assembly_vertices: 6, expected 0",
            "empty: samples_passed: 70, expected 0"));
}

// The counters of absent stages are undefined, so their values do not matter.
TEST(StopCounts, LeaveOutStagesThatAreNotThere) {
    StopCounts counts = allRan();
    counts.samples_passed = 0;
    counts.watched_invocations = 6;
    EXPECT_THAT(warningsOf(Stop::vertex, counts), IsEmpty());
    const StopPlan vertex = stopOf(Stop::vertex);
    for (const report::Statistic& each : stopStatistics(vertex, smallPlan(), counts, false))
        EXPECT_THAT(each.name, testing::AnyOf("vertex_invocations", "samples_passed", "seen"));
}

TEST(StopCounts, SayNothingOfWhatTheDeviceDoesNotCount) {
    const StopPlan fragment = stopOf(Stop::fragment);
    EXPECT_THAT(stopStatistics(fragment, smallPlan(), {}, false), IsEmpty());
}

TEST(CoverageCheck, ComparesWithAndWithoutFragmentShader) {
    const auto record = [](Stop stop, std::uint64_t samples) {
        StopRecord stop_record;
        stop_record.times.stop = stop;
        stop_record.statistics = {{"samples_passed", samples, {}, ""}};
        return stop_record;
    };
    const std::vector<StopRecord> alike{record(Stop::raster, 7), record(Stop::fragment, 7)};
    EXPECT_THAT(coverageWarnings(alike), IsEmpty());
    const std::vector<StopRecord> other{record(Stop::raster_msaa, 7), record(Stop::msaa, 8)};
    EXPECT_THAT(coverageWarnings(other), ElementsAre("raster_msaa: covers 7 samples, msaa 8"));
}

TEST(UnitCosts, AreMarginalCostsOverCounts) {
    const auto rung = [](Stop stop, double marginal) {
        return RungCost{.stop = stop, .marginal = {.estimate = marginal, .interval = {}}};
    };
    const std::vector<UnitCost> costs = unitCosts(
        {rung(Stop::empty, 1.0), rung(Stop::tessellation_1, 2.0), rung(Stop::tessellation, 3.0),
         rung(Stop::fragment, 4.0)},
        {.strands = 10, .evaluations_1 = 60, .evaluations = 150, .fragments_note = "approximate"});
    const auto text = [](const UnitCost& cost) {
        return std::string(stopName(cost.rung)) + '/' + cost.unit + ' ' +
               std::to_string(cost.count);
    };
    std::vector<std::string> texts;
    for (const UnitCost& cost : costs) texts.push_back(text(cost));
    EXPECT_THAT(
        texts, ElementsAre(
                   "tessellation_1/strand 10", "tessellation_1/evaluation 60",
                   "tessellation/strand 10", "tessellation/evaluation 90", "fragment/strand 10"));
    EXPECT_DOUBLE_EQ(costs[0].nanoseconds, 2e6 / 10);
    EXPECT_DOUBLE_EQ(costs[3].nanoseconds, 3e6 / 90);
}

}  // namespace
}  // namespace benchmarks::ablate
