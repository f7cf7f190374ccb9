// Frozen values are exported as a report that every reader of reports accepts.
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/doctor/reports.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/table.h"
#include "benchmarks/report/text.h"
#include "benchmarks/viewer/timings_panel.h"
#include "tests/gpu_fixture.h"
#include "tests/printed_text.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/made_up_frames.h"

namespace benchmarks::viewer {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using Samples = std::vector<double>;

class TimingsReport : public GpuTest {
protected:
    scene::Json saved(const report::CaseResult& result) {
        hair::Settings settings;
        settings.seed = 7;
        const ReportOrigin origin{
            .scene = "scenes/made_up.json",
            .name = "made_up",
            .command = {"hairbench", "view", "scenes/made_up.json"}};
        saveReport(viewerReport(device(), origin, settings, result), settings.render, {}, file_);
        return report::readReport(file_);
    }

    static report::CaseResult frozen(const report::CaseResult& statistics = {}) {
        return frozenResult(
            {.shown = shownTimings(madeUpHistory(), engine::DeviceType::cpu), .settings = {}},
            statistics);
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.file("results/made_up-frozen.json");
};

TEST_F(TimingsReport, FitsTheSchema) {
    report::CaseResult statistics;
    statistics.statistics = {
        {.name = "geometry_primitives", .measured = 6, .expected = 6, .note = ""}};
    saved(frozen(statistics));
    const std::string schema =
        textOf(std::filesystem::path(HAIRBENCH_SOURCE_DIR) / "results/report.schema.json");
    EXPECT_THAT(report::schemaErrors(schema, textOf(file_)), IsEmpty());
}

TEST_F(TimingsReport, HasTheSamplesThatWentIn) {
    const scene::Json report = saved(frozen());
    const scene::Json& metrics = report.at("cases").at(0).at("metrics");
    EXPECT_EQ(metrics.at("pass.wind.time").at("samples").get<Samples>(), (Samples{1, 3, 2}));
    EXPECT_EQ(metrics.at("pass.wind.time").at("mode"), "isolated");
    EXPECT_EQ(
        metrics.at("frame.isolated.time").at("samples").get<Samples>(), (Samples{12, 25, 63}));
    EXPECT_EQ(metrics.at("frame.device.time").at("samples").get<Samples>(), (Samples{22, 17, 18}));
    EXPECT_EQ(metrics.at("frame.device.time").at("mode"), "overlapped");
    EXPECT_EQ(metrics.at("frame.device.time").at("median"), 18.0);
    EXPECT_EQ(metrics.size(), 7u);
    EXPECT_EQ(report.at("scene").at("document").at("seed"), 7);
    EXPECT_EQ(report.at("environment").at("seed"), 7);
    EXPECT_EQ(report.at("environment").at("device").at("name"), device().info().name);
    EXPECT_EQ(report.at("cases").at(0).at("name"), "made_up");
}

TEST_F(TimingsReport, SaysThatItIsTheViewers) {
    report::CaseResult statistics;
    statistics.trust.warnings = {"geometry_primitives: measured 6, expected 7"};
    const report::CaseResult result = frozen(statistics);
    EXPECT_THAT(
        result.trust.warnings,
        Contains(HasSubstr(
            "taken in the viewer: 3 isolated frames and 3 overlapped frames between 4 and 9")));
    EXPECT_THAT(result.trust.warnings, Contains(statistics.trust.warnings.front()));
}

TEST_F(TimingsReport, IsReadByTheOtherCommands) {
    EXPECT_THAT(report::table(saved(frozen())), HasSubstr("made_up"));
    const std::string printed = printedText(Printed::to_stdout, [&] {
        EXPECT_EQ(
            commands::compareReports({.a = file_, .b = file_, .baseline = {}, .verdict = {}}),
            report::kOk);
        EXPECT_EQ(
            commands::writeReportPage({.reports = {file_}, .out = folder_.file("page.html")}),
            report::kOk);
    });
    EXPECT_THAT(printed, testing::Not(IsEmpty()));
    EXPECT_THAT(textOf(folder_.file("page.html")), HasSubstr("made_up"));
}

TEST_F(TimingsReport, SaysWhereItCantBeWritten) {
    const auto folder = folder_.write("file", "");
    file_ = folder / "report.json";
    EXPECT_THROW(saved(frozen()), engine::Error);
}

TEST(TimingsReportPath, IsBesideTheRunners) {
    const ReportOrigin origin{.scene = "a/rest.json", .name = "rest", .command = {}};
    EXPECT_EQ(reportPath(origin, "viewer"), "results/local/rest-viewer.json");
}

}  // namespace
}  // namespace benchmarks::viewer
