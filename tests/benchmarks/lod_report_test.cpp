#include "benchmarks/lod/walk.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/reports.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/temporary_folder.h"

namespace benchmarks {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kSchemaFile =
    std::filesystem::path(HAIRBENCH_SCENES_DIR) / "../results/lod.schema.json";

// Two steps. The first has no step before it and unknown strands.
lod::LodReport sampleLod() {
    return {
        .environment = sampleReport().environment,
        .scene = sampleReport().scene,
        .frame = 60,
        .steps =
            {{.distance = 0.5,
              .drawn = {.error = 0.0, .coverage = 0.3, .time = {10.0, 20.0}},
              .clusters = lod::LodDrawn{.strands = 8704, .coverage = 0.3, .time = {11.0, 21.0}},
              .full_strands = 8704,
              .full_segments = 487424,
              .full_coverage = 0.3,
              .full_time = {10.0, 20.0}},
             {.distance = 20.0,
              .drawn =
                  {.mean_level = 4.0,
                   .strands = 1000,
                   .error = 0.01,
                   .flip = 0.02,
                   .popping = 0.002,
                   .coverage = 0.09,
                   .time = {2.0, 10.0}},
              .clusters =
                  lod::LodDrawn{
                      .mean_level = 5.0,
                      .strands = 500,
                      .segments = 24371,
                      .error = 0.02,
                      .flip = 0.03,
                      .popping = 0.004,
                      .coverage = 0.12,
                      .time = {1.0, 9.0}},
              .full_strands = 8704,
              .full_segments = 487424,
              .full_coverage = 0.1,
              .full_time = {14.0, 20.0}}},
        .truth = lod::LodTruth{
            .samples = 64,
            .levels = {
                {.level = 0.0,
                 .strands = 8704,
                 .coverage = 0.3,
                 .full_coverage = 0.3,
                 .lights = {{.angle = 180.0, .flip = 0.2, .rmse = 0.1}}},
                {.level = 4.0,
                 .strands = 544,
                 .coverage = 0.29,
                 .full_coverage = 0.3,
                 .popping = 0.01,
                 .lights = {{.angle = 0.0, .flip = 0.25, .rmse = 0.12, .light_ratio = 0.9}}}}}};
}

scene::Json written() { return scene::Json::parse(lod::lodReportText(sampleLod())); }

TEST(LodTotals, AreThoseOfAllSteps) {
    const lod::LodTotals totals = lod::totalsOf(sampleLod().steps);
    EXPECT_EQ(totals.worst_popping, 0.002);
    EXPECT_NEAR(totals.mean_coverage_change, -0.05, 1e-15);
    EXPECT_NEAR(totals.worst_coverage_change, -0.1, 1e-15);
    EXPECT_DOUBLE_EQ(totals.strands_speed_up, 2.0);  // 24 ms / 12 ms
    EXPECT_DOUBLE_EQ(totals.frame_speed_up, 40.0 / 30.0);
    const lod::LodTotals clusters = lod::totalsOf(sampleLod().steps, lod::LodKind::cluster);
    EXPECT_EQ(clusters.worst_popping, 0.004);
    EXPECT_NEAR(clusters.worst_coverage_change, 0.2, 1e-15);
    EXPECT_DOUBLE_EQ(clusters.strands_speed_up, 2.0);  // 24 ms / 12 ms
    EXPECT_DOUBLE_EQ(clusters.frame_speed_up, 40.0 / 30.0);
}

TEST(LodReport, LeavesOutWhatIsNotKnown) {
    const scene::Json report = written();
    EXPECT_FALSE(report["steps"][0].contains("popping"));
    EXPECT_FALSE(report["steps"][0].contains("strands"));
    EXPECT_EQ(report["steps"][1]["strands"], 1000);
    EXPECT_EQ(report["steps"][1]["full_time"]["strands"], 14.0);
    EXPECT_EQ(report["steps"][1]["clusters"]["strands"], 500);
    EXPECT_EQ(report["steps"][1]["clusters"]["segments"], 24371);
    EXPECT_EQ(report["steps"][1]["full_segments"], 487424);
    EXPECT_FALSE(report["steps"][1].contains("segments"));
    EXPECT_EQ(report["cluster_totals"]["worst_popping"], 0.004);
    lod::LodReport interrupted = sampleLod();
    interrupted.steps.clear();
    interrupted.interrupted = true;
    EXPECT_FALSE(scene::Json::parse(lod::lodReportText(interrupted)).contains("totals"));
    EXPECT_THAT(
        report::schemaErrors(textOf(kSchemaFile), lod::lodReportText(interrupted)), IsEmpty());
}

TEST(LodSchema, DescribesTheReport) {
    EXPECT_THAT(
        report::schemaErrors(textOf(kSchemaFile), lod::lodReportText(sampleLod())), IsEmpty());
}

TEST(LodSchema, FindsWhatIsWrong) {
    const std::string schema = textOf(kSchemaFile);
    for (const char* pointer :
         {"/schema", "/environment/device", "/scene/hash", "/frame", "/steps/0/distance",
          "/steps/0/time/frame", "/totals/strands_speed_up", "/reference/samples",
          "/reference/levels/1/lights/0/flip"}) {
        scene::Json report = written();
        const scene::Json::json_pointer place(pointer);
        report[place.parent_pointer()].erase(place.back());
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
    const std::pair<const char*, scene::Json> replaced[] = {
        {"/schema", "hairbench-report/1.0.0"},
        {"/steps/1/strands", -1},
        {"/steps/1/popping", nullptr},
        {"/steps/1/coverage", 1.5},
        {"/reference/levels/1/popping", nullptr},
        {"/reference/levels/0/lights/0/light_ratio", -1.0},
        {"/steps/1/distance", 0.0}};
    for (const auto& [pointer, value] : replaced) {
        scene::Json report = written();
        report[scene::Json::json_pointer(pointer)] = value;
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
}

TEST(LodTable, HasALinePerStepAndTheTotals) {
    const std::string table = lod::lodTable(sampleLod());
    EXPECT_THAT(table, HasSubstr("0.500"));
    EXPECT_THAT(table, HasSubstr("20.000"));
    EXPECT_THAT(table, HasSubstr("  5.0  ")) << "segments of clusters, in hundredths";
    EXPECT_THAT(table, HasSubstr("-10.00"));
    EXPECT_THAT(table, HasSubstr("coverage change: mean -5.00 %, worst -10.00 %"));
    EXPECT_THAT(table, HasSubstr("against level 0 path-traced with 64 samples per pixel"));
    EXPECT_THAT(table, HasSubstr("0.900"));
}

}  // namespace
}  // namespace benchmarks
