// Tests which reports may be kept beside others.
#include "benchmarks/doctor/reports.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/files.h"
#include "tests/cli/run_hairbench.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace benchmarks::doctor {
namespace {

namespace fs = std::filesystem;

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

const fs::path kResults = HAIRBENCH_SOURCE_DIR "/results";

class KeptReport : public testing::Test {
protected:
    // Examines two cases of a trusted report on a software device after `change`.
    ReportExamination examine(const std::function<void(json&)>& change) {
        json report = json::parse(engine::readFile(kResults / "thesis-llvmpipe-f49352ebe7ae.json"));
        json& cases = report.at("cases");
        cases.erase(cases.begin() + 2, cases.end());
        change(report);
        return examineReport(folder_.write("report.json", report.dump()));
    }

    std::string refusal(const std::function<void(json&)>& change) {
        const ReportExamination examination = examine(change);
        EXPECT_FALSE(isAccepted(examination));
        return examinationText(examination);
    }

    TemporaryFolder folder_;
};

TEST_F(KeptReport, IsAcceptedAsItIs) {
    const ReportExamination examination = examine([](json&) {});
    EXPECT_TRUE(isAccepted(examination));
    EXPECT_EQ(examination.verdicts, "1 trusted, 1 doubtful");
    // The first case drifts, and its interval is wider than 5 %.
    ASSERT_EQ(examination.findings.size(), 2u);
    EXPECT_EQ(examination.findings[0].check, "drift");
    EXPECT_EQ(examination.findings[1].check, "noise");
    EXPECT_THAT(examinationText(examination), StartsWith("ok, 2 cases on llvmpipe"));
    EXPECT_THAT(examinationText(examination), HasSubstr(": 1 trusted, 1 doubtful; drift: "));
}

TEST_F(KeptReport, HasTheFormThatItsSchemaSays) {
    EXPECT_THAT(
        refusal([](json& report) { report["cases"][1]["status"] = "fine"; }),
        StartsWith("/cases/1/status: "));
    // The mark "untrusted" excuses times but not a wrong form.
    EXPECT_THAT(
        refusal([](json& report) {
            report["untrusted"] = "why not";
            report["cases"][0].erase("name");
        }),
        StartsWith("/cases/0: "));
}

// The bounds are from docs/measuring.md.
TEST_F(KeptReport, IsRefusedForWhatTheDoctorWouldNotTrust) {
    const auto first = [](json& report) -> json& { return report["cases"][0]; };
    EXPECT_THAT(
        refusal([](json& report) { report["environment"]["build"]["type"] = "Debug"; }),
        StartsWith("build: Debug"));
    EXPECT_THAT(
        refusal([](json& report) { report["environment"]["validation"] = true; }),
        StartsWith("layers: the validation layer is on"));
    EXPECT_THAT(
        refusal([&](json& report) { first(report)["trust"]["pass_sum_over_wall"] = 0.85; }),
        testing::AllOf(
            StartsWith("pass sum: "), HasSubstr("85.0 %"), HasSubstr("in 1 of 2 cases")));
    EXPECT_THAT(
        refusal([&](json& report) { first(report)["trust"]["timestamps"] = "wrong"; }),
        StartsWith("pass times: "));
    EXPECT_THAT(
        refusal([&](json& report) { first(report)["conditions"]["other_load"] = 0.3; }),
        StartsWith("other load: 30.0 %"));
    EXPECT_THAT(
        refusal([&](json& report) { first(report)["conditions"]["steal"] = 0.2; }),
        StartsWith("steal: 20.0 %"));
}

TEST_F(KeptReport, IsAcceptedWithAWarningForWhatNeedsCare) {
    const ReportExamination examination = examine([](json& report) {
        report["environment"]["build"]["dirty"] = true;
        report["cases"][1]["conditions"]["steal"] = 0.05;
    });
    EXPECT_TRUE(isAccepted(examination));
    ASSERT_GE(examination.findings.size(), 2u);
    EXPECT_EQ(examination.findings[0].check, "build");
    EXPECT_EQ(examination.findings[1].check, "steal");
    EXPECT_THAT(examination.findings[1].seen, HasSubstr("in 1 of 2 cases"));
    EXPECT_THAT(examinationText(examination), HasSubstr("5.0 %"));
}

// Only the host's clock shows timestamps of a wrong rate.
TEST_F(KeptReport, OfAGpuIsRefusedWhereItsPassesAreNotTheWallClock) {
    const std::string text = refusal([](json& report) {
        report["environment"]["device"]["type"] = "discrete";
        report["cases"][0]["trust"] = {
            {"pass_sum_over_device", 1.0},
            {"pass_sum_over_work", 0.5},
            {"timestamps", "unchecked"},
            {"warnings", {"the passes add up to 1.00 of the device's time for the frame"}}};
    });
    EXPECT_THAT(text, StartsWith("pass sum: "));
    EXPECT_THAT(text, HasSubstr("50.0 % of the wall clock minus a submission (in 1 of 2 cases)"));
}

// Load by other processes disturbs only frames of a software device.
TEST_F(KeptReport, OfAGpuMayHaveBusyProcessors) {
    EXPECT_TRUE(isAccepted(examine([](json& report) {
        report["environment"]["device"]["type"] = "discrete";
        report["cases"][0]["conditions"]["other_load"] = 0.9;
    })));
}

TEST_F(KeptReport, IsAcceptedWhereAMarkSaysWhyItIsKept) {
    const ReportExamination examination = examine([](json& report) {
        report["untrusted"] = "a film ran beside it";
        report["cases"][0]["conditions"]["other_load"] = 0.3;
    });
    EXPECT_TRUE(isAccepted(examination));
    EXPECT_THAT(examinationText(examination), HasSubstr("a film ran beside it"));
}

TEST_F(KeptReport, IsOneOfHairbench) {
    const fs::path file = folder_.write("other.json", R"({"schema": "other/1.0.0"})");
    EXPECT_THAT(errorText([&] { examineReport(file); }), HasSubstr("is not a report of hairbench"));
}

// Checks them like the pull request that adds a report.
TEST(CommittedReports, AreAllAccepted) {
    std::string files;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(kResults))
        if (entry.path().extension() == ".json" &&
            !entry.path().string().ends_with(".schema.json")) {
            files += " '" + entry.path().string() + "'";
            ++count;
        }
    ASSERT_GT(count, 0u);
    const Outcome outcome = hairbench("doctor --reports" + files);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    std::size_t accepted = 0;
    for (std::size_t at = 0; (at = outcome.output.find(": ok, ", at)) != std::string::npos; ++at)
        ++accepted;
    EXPECT_EQ(accepted, count) << outcome.output;
}

// Counted by the table of docs/measuring.md with another program.
TEST(CommittedReports, HaveTheseVerdicts) {
    const std::pair<const char*, const char*> kVerdicts[] = {
        {"backends-llvmpipe-ff656b85a1cb", "62 doubtful"},
        {"simulation_scale-llvmpipe-0cec23f6b53c", "5 trusted, 17 doubtful, 2 untrusted"},
        {"solvers_scale-llvmpipe-c7aafeacbd09", "1 trusted, 11 doubtful"},
        {"thesis-h200-bbe05d81e193", "9 trusted, 5 doubtful"},
        {"thesis-llvmpipe-0cec23f6b53c", "108 doubtful"},
        {"thesis-llvmpipe-f49352ebe7ae", "3 trusted, 13 doubtful"}};
    for (const auto& [report, verdicts] : kVerdicts)
        EXPECT_EQ(examineReport(kResults / (std::string(report) + ".json")).verdicts, verdicts)
            << report;
}

TEST(CommittedReports, AreRefusedByStatusThree) {
    const TemporaryFolder folder;
    folder.write("a.json", R"({"schema": "hairbench-report/1.5.0"})");
    folder.write("b.schema.json", "{}");  // skipped
    const Outcome outcome = hairbenchErrors(
        "doctor --reports '" + folder.file("a.json").string() + "' '" +
        folder.file("b.schema.json").string() + "' '" + folder.file("none.json").string() + "'");
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.output, HasSubstr("a.json: "));
    EXPECT_THAT(outcome.output, HasSubstr("none.json"));
}

}  // namespace
}  // namespace benchmarks::doctor
