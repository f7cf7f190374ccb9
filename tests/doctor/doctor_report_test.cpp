#include "benchmarks/doctor/reports.h"

#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/sample_report.h"
#include "tests/temporary_folder.h"

namespace benchmarks::doctor {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const char* const kSchemaFile = HAIRBENCH_SOURCE_DIR "/results/doctor.schema.json";

DoctorReport sampleDoctor() {
    return {
        .environment = sampleReport().environment,
        .findings =
            {{"timestamps", Health::ok, "64 bits", ""},
             {"power", Health::unknown, "no power supply is listed", ""},
             {"clocks", Health::warn, "1500 MHz", "lock them"}},
        .sensitivities =
            {{report::ofFrame(report::Measured::time), 0.02, 0.031},
             {report::ofPass("wind", report::Measured::time), 0.2,
              std::numeric_limits<double>::infinity()}},
        .planted = {{"strands", 0.05, true, false}, {"strands", 0.05, false, true}}};
}

TEST(DoctorReport, IsWhatItsSchemaSays) {
    const std::string schema = textOf(kSchemaFile);
    EXPECT_THAT(report::schemaErrors(schema, doctorReportText(sampleDoctor())), IsEmpty());
    DoctorReport least;
    least.findings = {{"power", Health::unknown, "nothing", ""}};
    EXPECT_THAT(report::schemaErrors(schema, doctorReportText(least)), IsEmpty());
}

TEST(DoctorReport, IsMoreThanItsSchemaAllowsWithoutFindings) {
    EXPECT_THAT(
        report::schemaErrors(textOf(kSchemaFile), doctorReportText(DoctorReport())),
        Not(IsEmpty()));
}

TEST(DoctorReport, LeavesOutWhatIsNotKnown) {
    const auto report = nlohmann::json::parse(doctorReportText(sampleDoctor()));
    EXPECT_FALSE(report["findings"][0].contains("advice"));
    EXPECT_EQ(report["findings"][2]["advice"], "lock them");
    EXPECT_EQ(report["sensitivities"][0]["smallest_slowdown"], 0.031);
    EXPECT_FALSE(report["sensitivities"][1].contains("smallest_slowdown"));
    EXPECT_FALSE(nlohmann::json::parse(doctorReportText(DoctorReport())).contains("planted"));
}

TEST(DoctorReport, IsTrustedUnlessSomethingIsBad) {
    DoctorReport report = sampleDoctor();
    EXPECT_TRUE(isTrusted(report));
    EXPECT_THAT(doctorText(report), HasSubstr("timings can be used with care: 1 warning\n"));
    report.findings.push_back({"build", Health::bad, "Debug", "use Release"});
    EXPECT_FALSE(isTrusted(report));
    EXPECT_EQ(nlohmann::json::parse(doctorReportText(report))["trusted"], false);
    EXPECT_THAT(doctorText(report), HasSubstr("timings can't be trusted: 1 check is bad\n"));
    report.findings = {{"build", Health::ok, "Release", ""}};
    EXPECT_THAT(doctorText(report), HasSubstr("timings can be trusted\n"));
}

TEST(DoctorText, ListsWhatToFixWorstFirst) {
    DoctorReport report = sampleDoctor();
    report.findings.push_back({"build", Health::bad, "Debug", "use Release"});
    EXPECT_THAT(
        doctorText(report),
        HasSubstr("\nwhat to fix:\n  build: use Release\n  clocks: lock them\n\n"));
    report.findings = {{"build", Health::ok, "Release", ""}};
    EXPECT_THAT(doctorText(report), Not(HasSubstr("what to fix")));
}

TEST(DoctorText, ShowsWhatCanBeFound) {
    const std::string text = doctorText(sampleDoctor());
    EXPECT_THAT(text, HasSubstr("frame.time                   2.0 %          3.1 %\n"));
    EXPECT_THAT(text, HasSubstr("pass.wind.time              20.0 %              -\n"));
    EXPECT_THAT(text, HasSubstr("strands         5.0 %  yes\n"));
    EXPECT_THAT(text, HasSubstr("strands         5.0 %  no, and in another pass\n"));
}

TEST(JudgePlanted, WantsEachFoundInItsPassAlone) {
    const PlantedGate right{"strands", 0.05, true, false};
    const PlantedGate missed{"strands", 0.05, false, false};
    const PlantedGate astray{"strands", 0.05, true, true};
    EXPECT_EQ(judgePlanted({right, right}).health, Health::ok);
    EXPECT_THAT(judgePlanted({right, right}).seen, HasSubstr("2 of 2 found"));
    EXPECT_EQ(judgePlanted({right, missed}).health, Health::bad);
    EXPECT_THAT(judgePlanted({right, missed}).seen, HasSubstr("1 of 2 found"));
    EXPECT_EQ(judgePlanted({right, astray}).health, Health::bad);
}

}  // namespace
}  // namespace benchmarks::doctor
