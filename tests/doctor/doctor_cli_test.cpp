#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/reports.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace benchmarks::doctor {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kNoDevice = 77;

// Whether timings can be trusted here depends on the machine. The table, the report and the status
// must agree.
TEST(DoctorCommand, SaysTheSameInItsTableItsReportAndItsStatus) {
    const TemporaryFolder folder;
    const std::string out = folder.file("new/doctor.json").string();
    const Outcome outcome =
        hairbench("doctor -o '" + out + "'", "cd '" + folder.path().string() + "' && ");
    if (outcome.status == kNoDevice) return skipWithout(Need::device, outcome.output);
    ASSERT_TRUE(outcome.status == 0 || outcome.status == 3) << outcome.output;
    const std::string text = textOf(out);
    EXPECT_THAT(
        report::schemaErrors(textOf(HAIRBENCH_SOURCE_DIR "/results/doctor.schema.json"), text),
        IsEmpty());
    const auto report = nlohmann::json::parse(text);
    EXPECT_EQ(report["trusted"], outcome.status == 0);
    ASSERT_EQ(report["findings"].size(), doctorChecks().size());
    bool bad = false;
    for (std::size_t i = 0; i < doctorChecks().size(); ++i) {
        const auto& finding = report["findings"][i];
        EXPECT_EQ(finding["check"], doctorChecks()[i].name);
        EXPECT_THAT(outcome.output, HasSubstr(finding["seen"].get<std::string>()));
        if (finding.contains("advice")) {
            EXPECT_THAT(outcome.output, HasSubstr(finding["advice"].get<std::string>()));
        }
        bad = bad || finding["verdict"] == "bad";
    }
    EXPECT_EQ(outcome.status == 3, bad);
    // The doctor needs no file and leaves only the requested one.
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(DoctorCommand, FindsTheValidationLayerBad) {
    const Outcome outcome = hairbench("doctor --validate");
    if (outcome.status == kNoDevice) return skipWithout(Need::device, outcome.output);
    if (outcome.output.find("is not installed") != std::string::npos)
        return skipWithout(Need::validation, outcome.output);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.output, HasSubstr("the validation layer is on"));
}

TEST(DoctorCommand, SaysBeforeItStartsThatItCannotWrite) {
    const TemporaryFolder folder;
    folder.write("file", "");
    const std::string out = (folder.file("file") / "doctor.json").string();
    const Outcome outcome = hairbenchErrors("doctor -o '" + out + "'");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr(folder.file("file").string()));
}

TEST(DoctorCommand, PlantsNothingWithoutKnowingHowMuch) {
    const Outcome outcome = hairbench("doctor --planted");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("--pairs"));
}

}  // namespace
}  // namespace benchmarks::doctor
