// One case has the same verdict wherever it is shown.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/reports.h"
#include "benchmarks/report/exporters.h"
#include "benchmarks/report/page.h"
#include "benchmarks/report/table.h"
#include "benchmarks/report/verdict.h"
#include "engine/instance.h"
#include "tests/benchmarks/judged_report.h"
#include "tests/doctor/sample_facts.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {
namespace {

using testing::HasSubstr;

struct Judged {
    const char* name;
    void (*change)(Report& report);
    Trusted level;
    const char* check;  // the doctor's row; empty for a trusted case
    const char* text;   // in a table
};

// Levels are those of the table of `hairbench doctor` in docs/measuring.md: bad is untrusted, and
// warn is doubtful.
const Judged kJudged[] = {
    {"quiet", [](Report&) {}, Trusted::trusted, "", "trusted"},
    {"disturbed", [](Report& r) { r.cases[0].conditions.other_load = 0.2; }, Trusted::doubtful,
     "other load", "doubtful (other load 20 %)"},
    {"busy", [](Report& r) { r.cases[0].conditions.other_load = 0.73; }, Trusted::untrusted,
     "other load", "untrusted (other load 73 %)"},
    {"stolen", [](Report& r) { r.cases[0].conditions.steal = 0.12; }, Trusted::untrusted, "steal",
     "untrusted (steal 12 %)"},
    {"hot",
     [](Report& r) {
         r.environment.device.type = engine::DeviceType::discrete;
         r.cases[0].conditions.clock_mhz = 900.0;
         r.cases[0].conditions.throttle_reasons = {"thermal slowdown"};
     },
     Trusted::untrusted, "clocks", "untrusted (throttled)"},
    {"stamps", [](Report& r) { r.cases[0].trust.timestamps = "wrong"; }, Trusted::untrusted,
     "pass times", "untrusted (timestamps)"},
    {"sum", [](Report& r) { r.cases[0].trust.pass_sum_over_wall = 0.85; }, Trusted::untrusted,
     "pass sum", "untrusted (pass sum 85 %)"},
    {"drifting", [](Report& r) { r.cases[0].sampling[0].steady = false; }, Trusted::doubtful,
     "drift", "doubtful (drift)"},
    {"noisy", [](Report& r) { r.cases[0].metrics[0].samples = spreadTimes(0.9); },
     Trusted::doubtful, "noise", "doubtful (noise "},
    {"short", [](Report& r) { r.cases[0].metrics[0].samples = {10.0, 10.1}; }, Trusted::doubtful,
     "noise", "doubtful (no interval)"},
    {"debug", [](Report& r) { r.environment.build.type = "Debug"; }, Trusted::untrusted, "build",
     "untrusted (build)"},
    {"validated", [](Report& r) { r.environment.validation = true; }, Trusted::untrusted, "layers",
     "untrusted (validation)"},
};

class VerdictOfACase : public testing::TestWithParam<Judged> {
protected:
    scene::Json report_ = judgedReport(GetParam().change);
    std::string level_ = trustedName(GetParam().level);
    std::string text_ = GetParam().text;
};

TEST_P(VerdictOfACase, IsInTheTable) {
    const std::string table = report::table(report_);
    EXPECT_THAT(table, HasSubstr("  " + text_));
    EXPECT_THAT(table, HasSubstr("  trust"));
}

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

TEST_P(VerdictOfACase, IsInCsv) {
    std::istringstream text(exportReport(report_, "csv"));
    std::string titles, row;
    std::getline(text, titles);
    std::getline(text, row);
    const std::vector<std::string> names = cellsOf(titles);
    const auto column = std::ranges::find(names, "verdict") - names.begin();
    EXPECT_EQ(cellsOf(row).at(static_cast<std::size_t>(column)), level_);
    EXPECT_THAT(row, HasSubstr(GetParam().check));
}

TEST_P(VerdictOfACase, IsInMarkdown) {
    EXPECT_THAT(exportReport(report_, "markdown"), HasSubstr("| " + text_));
}

TEST_P(VerdictOfACase, IsInTheFormatsOfOtherTools) {
    const auto document = [&](const char* format) {
        return scene::Json::parse(exportReport(report_, format));
    };
    EXPECT_THAT(document("gbench")["benchmarks"][0]["label"].get<std::string>(), HasSubstr(text_));
    EXPECT_EQ(document("gbench")["context"]["trust"], "1 " + level_);
    EXPECT_THAT(document("customSmallerIsBetter")[0]["extra"].get<std::string>(), HasSubstr(text_));
    const std::string benchmark = report_["cases"][0]["name"].get<std::string>() + "/trust";
    EXPECT_EQ(document("bmf")[benchmark]["doubt"]["value"], static_cast<int>(GetParam().level));
    EXPECT_THAT(exportReport(report_, "perfetto"), HasSubstr(text_));
}

TEST_P(VerdictOfACase, IsOnThePage) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("a.json");
    writeReport(report_, file);
    const scene::Json data = pageData({{file}});
    const scene::Json& verdict = data.at("reports")[0].at("cases")[0].at("verdict");
    EXPECT_EQ(verdict.at("level"), level_);
    EXPECT_THAT(verdict.at("text").get<std::string>(), HasSubstr(text_));
    EXPECT_EQ(verdict.at("reasons").size(), *GetParam().check ? 1u : 0u);
}

TEST_P(VerdictOfACase, IsThatOfTheDoctor) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("a.json");
    writeReport(report_, file);
    const doctor::ReportExamination examination = doctor::examineReport(file);
    EXPECT_EQ(doctor::isAccepted(examination), GetParam().level != Trusted::untrusted);
    EXPECT_EQ(examination.verdicts, "1 " + level_);
    if (!*GetParam().check) {
        EXPECT_TRUE(examination.findings.empty());
        return;
    }
    ASSERT_EQ(examination.findings.size(), 1u);
    EXPECT_EQ(examination.findings[0].check, GetParam().check);
    EXPECT_EQ(examination.findings[0].health, doctor::healthOf(GetParam().level));
}

// The doctor judges the same machine.
TEST_P(VerdictOfACase, IsThatOfTheDoctorsRow) {
    const Report report = [] {
        Report changed = quietReport();
        GetParam().change(changed);
        return changed;
    }();
    const CaseResult& result = report.cases[0];
    const bool software = report.environment.device.type == engine::DeviceType::cpu;
    doctor::Facts facts = software ? doctor::softwareFacts() : doctor::goodFacts();
    facts.build.build = report.environment.build;
    facts.layers.validation = report.environment.validation.value();
    facts.load = {.steal = result.conditions.steal, .others = result.conditions.other_load};
    if (software) facts.passes.sum.over_wall = result.trust.pass_sum_over_wall;
    if (result.trust.timestamps == "wrong") facts.passes.faults = {"pass.wind: off"};
    if (facts.clocks) facts.clocks->conditions = result.conditions;
    const std::string check = GetParam().check;
    // Steadiness and intervals are a case's own.
    if (check == "drift" || check == "noise") return;
    for (const doctor::Finding& finding : doctor::judgeAll(facts))
        EXPECT_EQ(
            finding.health,
            finding.check == check ? doctor::healthOf(GetParam().level) : doctor::Health::ok)
            << finding.check;
}

TEST_P(VerdictOfACase, IsInAReportThatIsWritten) {
    putVerdict(report_.at("environment"), report_["cases"][0]);
    const scene::Json& trust = report_["cases"][0]["trust"];
    EXPECT_EQ(trust["verdict"], level_);
    EXPECT_EQ(trust["reasons"].size(), *GetParam().check ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Made, VerdictOfACase, testing::ValuesIn(kJudged),
    [](const testing::TestParamInfo<Judged>& made) { return std::string(made.param.name); });

}  // namespace
}  // namespace benchmarks::report
