#include "benchmarks/ablate/ablation.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/reports.h"
#include "tests/ablate/made_up_times.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/temporary_folder.h"

namespace benchmarks::ablate {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kSchemaFile =
    std::filesystem::path(HAIRBENCH_SCENES_DIR) / "../results/ablation.schema.json";

CaseAblation sampleCase(std::size_t laps) {
    CaseAblation result{
        .name = "rest",
        .axes = {{"/render/msaa", scene::Document(4)}},
        .frame = 13,
        .timing = "isolated",
        .counts = {{"strands", 8704}},
        .image_hash = "00000000000000ff",
        .warnings = {"the fan fell off"}};
    for (const StopTimes& times : steadyTimes(sampleTimes(), laps))
        result.stops.push_back(
            {.times = times,
             .tessellation = times.stop == Stop::tessellation_1 ? 1u : 4u,
             .samples = times.stop == Stop::msaa ? 4u : 1u,
             .statistics = {
                 {"vertex_invocations", 952, 952, ""},
                 {"fragment_invocations", 7, {}, "approximate"}}});
    result.attribution = attribute(steadyTimes(sampleTimes(), laps));
    result.unit_costs = unitCosts(
        result.attribution->rungs,
        {.strands = 1000, .evaluations_1 = 2000, .evaluations = 5000, .fragments = 100000});
    return result;
}

AblationReport sampleAblation(std::size_t laps = 8) {
    return {
        .environment = sampleReport().environment,
        .scene = sampleReport().scene,
        .laps = 8,
        .cases =
            {sampleCase(laps),
             {.name = "rest/backend:pulling",
              .axes = {{"/strands/backend", scene::Document("pulling_geometry")}},
              .status = report::Status::skipped,
              .reason = "/strands/backend: only tessellation"}},
        .notes = {"stages overlap"}};
}

scene::Json written() { return scene::Json::parse(ablationText(sampleAblation())); }

TEST(AblationText, KeepsEveryFrame) {
    const scene::Json rung = written()["cases"][0]["rungs"][3];
    EXPECT_EQ(rung["name"], "tessellation");
    EXPECT_EQ(rung["tessellation"], 4);
    EXPECT_EQ(rung["time"]["median"], 10.0);
    EXPECT_EQ(rung["time"]["laps"].size(), 8u);
    EXPECT_EQ(rung["time"]["laps"][7]["down"], scene::Json::array({10.0}));
    EXPECT_EQ(rung["marginal"]["estimate"], 4.0);
    EXPECT_EQ(rung["marginal"]["interval"]["upper"], 4.0);
    EXPECT_DOUBLE_EQ(rung["per"]["evaluation"]["value"].get<double>(), 4e6 / 3000);
    EXPECT_EQ(rung["statistics"]["vertex_invocations"]["expected"], 952);
}

TEST(AblationText, SetsChecksApartFromRungs) {
    const scene::Json found = written()["cases"][0];
    EXPECT_EQ(written()["notes"][0], "stages overlap");
    EXPECT_EQ(found["rungs"].size(), 8u);
    EXPECT_EQ(found["checks"].size(), 6u);
    EXPECT_FALSE(found["checks"][0].contains("marginal"));
    EXPECT_EQ(found["residual"]["multisampling"]["estimate"], 2.0);
    EXPECT_EQ(found["watching"]["watched_evaluation"]["estimate"], 0.25);
}

TEST(AblationText, LeavesOutWhatIsNotKnown) {
    const scene::Json found = scene::Json::parse(ablationText(sampleAblation(2)))["cases"];
    EXPECT_FALSE(found[0]["rungs"][3]["marginal"].contains("interval"));
    EXPECT_FALSE(found[1].contains("rungs"));
    EXPECT_FALSE(found[0]["rungs"][3]["statistics"]["fragment_invocations"].contains("expected"));
}

TEST(AblationSchema, DescribesTheReport) {
    const std::string schema = textOf(kSchemaFile);
    EXPECT_THAT(report::schemaErrors(schema, ablationText(sampleAblation())), IsEmpty());
    EXPECT_THAT(report::schemaErrors(schema, ablationText(sampleAblation(2))), IsEmpty());
}

TEST(AblationSchema, FindsWhatIsWrong) {
    const std::string schema = textOf(kSchemaFile);
    for (const char* pointer :
         {"/schema", "/scene/hash", "/laps", "/cases/0/rungs", "/cases/0/image_hash",
          "/cases/0/rungs/1/name", "/cases/0/rungs/1/time/laps", "/cases/0/residual/closure",
          "/cases/0/rungs/2/marginal/estimate", "/cases/1/reason"}) {
        scene::Json report = written();
        const scene::Json::json_pointer place(pointer);
        report[place.parent_pointer()].erase(place.back());
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
    const std::pair<const char*, scene::Json> replaced[] = {
        {"/schema", "hairbench-report/1.0.0"},
        {"/cases/0/rungs/0/name", "pass"},
        {"/cases/0/checks/0/name", "empty"},
        {"/cases/0/rungs/1/time/laps/0/up", scene::Json::array()},
        {"/cases/0/rungs/1/marginal/estimate", nullptr},
        {"/cases/0/rungs/1/samples", 3},
        {"/cases/0/timing", "overlapped"}};
    for (const auto& [pointer, value] : replaced) {
        scene::Json report = written();
        report[scene::Json::json_pointer(pointer)] = value;
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
}

TEST(AblationTable, HasALinePerRungAndTheRest) {
    const std::string table = ablationTable(sampleCase(8));
    EXPECT_THAT(table, HasSubstr("tessellation 1"));
    EXPECT_THAT(table, HasSubstr("tessellation 4"));
    EXPECT_THAT(table, HasSubstr("msaa 4"));
    EXPECT_THAT(table, HasSubstr("1333 / evaluation"));
    EXPECT_THAT(table, HasSubstr("interaction residual, the sum of these: 1.50 ms (1.50 .. 1.50)"));
    EXPECT_THAT(table, HasSubstr("warning: the fan fell off"));
    EXPECT_EQ(
        ablationTable(sampleAblation().cases[1]),
        "rest/backend:pulling\nskipped: /strands/backend: only tessellation\n");
}

}  // namespace
}  // namespace benchmarks::ablate
