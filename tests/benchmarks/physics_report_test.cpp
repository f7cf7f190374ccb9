#include "benchmarks/physics/checks.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/reports.h"
#include "tests/benchmarks/sample_report.h"
#include "tests/temporary_folder.h"

namespace benchmarks::physics {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::filesystem::path kSchemaFile =
    std::filesystem::path(HAIRBENCH_SCENES_DIR) / "../results/physics.schema.json";
const double kNan = std::nan("");

// One outcome of each verdict, a hash, and a curve with a gap.
Findings sampleFindings() {
    Findings findings("cantilever", hair::Solver::rod);
    findings.compare({"H / W", "1", {{"gamma", 10.0, "1"}}}, 1.0, 1.25, 0.25);
    findings.compare({"H / W", "1", {{"gamma", 50.0, "1"}}}, 1.0, 4.0, 0.02);
    findings.compare({"H / W", "1", {}}, kNan, 4.0).reason = "hangs straight down";
    findings.skip("no stiffness");
    findings.deviation({"bits", "count", {}}, 0.0, 0.0).state_hash = "00000000000000ff";
    findings.curve(
        "H / W", {{"gamma", "1"}, {"measured", "1"}}, {{10.0, 1.0}, {20.0, kNan}, {50.0, 1.5}});
    return findings;
}

PhysicsReport samplePhysics() {
    const Findings findings = sampleFindings();
    return {
        .environment = sampleReport().environment,
        .outcomes = findings.outcomes(),
        .curves = findings.curves()};
}

scene::Json written() { return scene::Json::parse(physicsReportText(samplePhysics())); }

TEST(Findings, PassUpToTheTolerance) {
    const Findings findings = sampleFindings();
    const auto& outcomes = findings.outcomes();
    EXPECT_EQ(outcomes[0].verdict, Verdict::pass);
    EXPECT_DOUBLE_EQ(*outcomes[0].error, 0.2);
    EXPECT_EQ(outcomes[1].verdict, Verdict::fail);
    EXPECT_EQ(outcomes[2].verdict, Verdict::reported);
    EXPECT_EQ(outcomes[3].verdict, Verdict::skipped);
    EXPECT_EQ(outcomes[4].verdict, Verdict::pass);
}

TEST(Findings, DoNotPassWhatCouldNotBeMeasured) {
    Findings findings("x", hair::Solver::shape);
    EXPECT_EQ(findings.compare({"f", "Hz", {}}, kNan, 1.0, 10.0).verdict, Verdict::fail);
    EXPECT_EQ(
        findings.deviation({"d", "1", {}}, std::numeric_limits<double>::infinity(), 1.0).verdict,
        Verdict::fail);
}

TEST(PhysicsReport, KeepsTheContractsNames) {
    const scene::Json report = written();
    EXPECT_EQ(report["schema"], "hairbench-physics/1.0.0");
    EXPECT_EQ(report["environment"]["device"]["driver"], "llvmpipe");
    EXPECT_EQ(
        report["outcomes"][1].dump(),
        R"({"check":"cantilever","solver":"rod","quantity":"H / W","unit":"1",)"
        R"("parameters":{"gamma":{"value":50.0,"unit":"1"}},"measured":1.0,"expected":4.0,)"
        R"("error":0.75,"tolerance":0.02,"verdict":"fail"})");
    EXPECT_EQ(
        report["outcomes"][3].dump(),
        R"({"check":"cantilever","solver":"rod","verdict":"skipped","reason":"no stiffness"})");
    EXPECT_EQ(report["outcomes"][4]["state_hash"], "00000000000000ff");
    EXPECT_EQ(report["curves"][0]["columns"][1].dump(), R"({"name":"measured","unit":"1"})");
}

TEST(PhysicsReport, LeavesOutWhatIsNotKnown) {
    const scene::Json report = written();
    EXPECT_FALSE(report["outcomes"][2].contains("measured"));
    EXPECT_FALSE(report["outcomes"][2].contains("error"));
    EXPECT_EQ(report["curves"][0]["rows"].dump(), "[[10.0,1.0],[50.0,1.5]]");
    EXPECT_THAT(report.dump(), Not(HasSubstr("null")));
}

TEST(PhysicsSchema, DescribesTheReport) {
    EXPECT_THAT(
        report::schemaErrors(textOf(kSchemaFile), physicsReportText(samplePhysics())), IsEmpty());
}

TEST(PhysicsSchema, FindsWhatIsWrong) {
    const std::string schema = textOf(kSchemaFile);
    for (const char* pointer :
         {"/schema", "/environment/device", "/outcomes/0/verdict", "/outcomes/0/unit",
          "/outcomes/3/reason", "/outcomes/0/parameters/gamma/value", "/curves/0/rows"}) {
        scene::Json report = written();
        const scene::Json::json_pointer place(pointer);
        report[place.parent_pointer()].erase(place.back());
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
    const std::pair<const char*, scene::Json> replaced[] = {
        {"/schema", "hairbench-report/1.0.0"}, {"/outcomes/0/verdict", "great"},
        {"/outcomes/0/measured", nullptr},     {"/outcomes/0/error", -1.0},
        {"/outcomes/4/state_hash", "FF"},      {"/curves/0/rows/0/1", nullptr}};
    for (const auto& [pointer, value] : replaced) {
        scene::Json report = written();
        report[scene::Json::json_pointer(pointer)] = value;
        EXPECT_THAT(report::schemaErrors(schema, report.dump()), Not(IsEmpty())) << pointer;
    }
}

TEST(PhysicsReport, CommittedOnesFitTheSchema) {
    const std::string schema = textOf(kSchemaFile);
    for (const auto& entry : std::filesystem::directory_iterator(kSchemaFile.parent_path())) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("physics-") || !name.ends_with(".json")) continue;
        EXPECT_THAT(report::schemaErrors(schema, textOf(entry.path())), IsEmpty()) << name;
    }
}

TEST(PhysicsTable, HasALinePerOutcomeAndCountsThem) {
    const std::string table = physicsTable(samplePhysics());
    EXPECT_THAT(table, HasSubstr("fail\n"));
    EXPECT_THAT(table, HasSubstr("reported: hangs straight down\n"));
    EXPECT_THAT(table, HasSubstr("skipped: no stiffness\n"));
    EXPECT_THAT(table, HasSubstr("2 pass, 1 fail, 1 reported, 1 skipped\n"));
}

// Errors c^p - finest^p, by hand: p = 2 has (16 - 1) / (4 - 1) = 5, p = 1 has (4 - 1) / (2 - 1)
// = 3.
TEST(Invariance, FindsTheOrderOfErrors) {
    EXPECT_NEAR(observedOrder({4.0, 2.0}, {15.0, 3.0}, 1.0).value_or(0.0), 2.0, 1e-9);
    EXPECT_NEAR(observedOrder({4.0, 2.0}, {3.0, 1.0}, 1.0).value_or(0.0), 1.0, 1e-9);
    EXPECT_FALSE(observedOrder({4.0, 2.0}, {1.0, 1.0}, 1.0));
    EXPECT_FALSE(observedOrder({4.0, 2.0}, {kNan, 1.0}, 1.0));
}

TEST(Invariance, HasALineForEachSolverAtRestAndInMotion) {
    Findings findings("step_invariance", hair::Solver::rod);
    findings.deviation(
        {"at rest, difference from the finest / length",
         "1",
         {{"time_step", 0.04, "s"}, {"finest time_step", 0.01, "s"}}},
        0.003, 0.01);
    findings.curve(
        "at rest, difference from the finest", {{"time_step", "s"}, {"difference / length", "1"}},
        {{0.04, 0.003}, {0.02, 0.001}});
    const std::string tables =
        invarianceTables({.outcomes = findings.outcomes(), .curves = findings.curves()});
    EXPECT_THAT(tables, HasSubstr("| time_step | 1/25 | 1/50 | order | promise |"));
    EXPECT_THAT(tables, HasSubstr("| rod, at rest | 0.00300 | 0.00100 | 1 | 1.0 %: pass |"));
}

TEST(WorkPrecision, RecommendsTheCheapestForAnError) {
    const std::vector<Series> columns{
        {"substeps", "count"}, {"iterations", "count"}, {"error", "1"}, {"time", "us"}};
    Findings dear("work_precision", hair::Solver::rod);
    dear.curve(
        "hair", columns, {{1.0, 2.0, 0.3, 1.0}, {8.0, 2.0, 0.04, 8.0}, {9.0, 2.0, 0.04, 9.0}});
    Findings cheap("work_precision", hair::Solver::ftl);
    cheap.curve("hair", columns, {{1.0, 0.0, 0.15, 0.5}});
    PhysicsReport report;
    report.curves = {dear.curves()[0], cheap.curves()[0]};
    recommendSolvers(report);
    ASSERT_EQ(report.outcomes.size(), 2u);  // nothing reaches 1 %
    EXPECT_EQ(report.outcomes[0].solver, "rod");
    EXPECT_EQ(report.outcomes[0].measured, 8.0);
    EXPECT_EQ(report.outcomes[1].solver, "ftl");
    EXPECT_EQ(report.outcomes[1].quantity.parameters[0].value, 0.2);
    EXPECT_THAT(workTables(report), HasSubstr("| rod | 4.0 % | | 8.00 (8 x 2) | 8.00 (8 x 2) |"));
}

}  // namespace
}  // namespace benchmarks::physics
