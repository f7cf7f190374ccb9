#include "benchmarks/report/methods.h"

#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/benchmarks/sample_report.h"

namespace benchmarks::report {
namespace {

using testing::HasSubstr;
using testing::Not;

// Describes the sample report (sample_report.h) in words.
TEST(Methods, NamesDeviceClocksSamplesAndWhatWasLeftOut) {
    const std::string text = methodsText(reportJson(sampleReport()));
    EXPECT_THAT(text, HasSubstr(" on " + sampleReport().environment.device.name));
    EXPECT_THAT(text, HasSubstr("1 case of scene"));
    EXPECT_THAT(text, HasSubstr("1 skipped because the machine lacks something, 1 failed"));
    EXPECT_THAT(text, HasSubstr("Under load the device's shaders ran at 1500 MHz"));
    EXPECT_THAT(text, HasSubstr("at 61.5 degrees Celsius"));
    EXPECT_THAT(text, HasSubstr("95 % intervals by order statistics"));
    EXPECT_THAT(text, HasSubstr("1 round at the start of a mode was left out"));
    EXPECT_THAT(
        text, HasSubstr("2 rounds were left out because heat or power throttled the device"));
    EXPECT_THAT(text, HasSubstr("1 case has warnings in the report."));
    EXPECT_THAT(text, Not(HasSubstr("without a pause")));
}

TEST(Methods, SaysHowOftenAndHowLongRoundsWerePlayed) {
    scene::Json report = reportJson(sampleReport());
    report["scene"]["document"]["run"] = {
        {"warmup", 3}, {"frames", 10}, {"precision", 0.01}, {"max_time", 10}, {"warmup_time", 0.1}};
    report["cases"][0]["sampling"][0]["plays"] = 120;
    const std::string text = methodsText(report);
    EXPECT_THAT(text, HasSubstr("rounds of 3 frames to warm up and 10 measured frames"));
    EXPECT_THAT(text, HasSubstr("120 times without a pause"));
    EXPECT_THAT(text, HasSubstr("at least 0.100 s of load"));
    EXPECT_THAT(text, HasSubstr("below 1.00 % of it"));
    EXPECT_THAT(text, HasSubstr("or 10.0 s had passed"));
}

// A report of three cases with these timestamps; empty: the report does not say.
std::string withStamps(const std::vector<std::string>& stamps) {
    Report report = sampleReport();
    report.cases.resize(1);
    report.cases.resize(3, report.cases[0]);
    for (std::size_t i = 0; i < 3; ++i) report.cases[i].trust.timestamps = stamps[i];
    return methodsText(reportJson(report));
}

TEST(Methods, ClaimsNoCheckOfTimestampsThatWasNotMade) {
    const char* const checked = "the passes' timestamps were checked against the host's clock";
    EXPECT_THAT(
        withStamps({"right", "right", "right"}),
        HasSubstr(std::string(checked) + "; 3 cases have"));
    EXPECT_THAT(
        withStamps({"right", "unchecked", "right"}),
        HasSubstr(std::string(checked) + " in 2 of 3 cases"));
    EXPECT_THAT(withStamps({"unchecked", "", "unchecked"}), Not(HasSubstr("timestamps")));
    const std::string text = withStamps({"wrong", "unchecked", ""});
    EXPECT_THAT(text, Not(HasSubstr(checked)));
    EXPECT_THAT(text, HasSubstr("timestamps were wrong in 1 case"));
}

TEST(Methods, SaysWhereNoClockIsKnown) {
    Report report = sampleReport();
    report.cases[0].conditions = {};
    EXPECT_THAT(methodsText(reportJson(report)), HasSubstr("No clock of the device was known."));
}

}  // namespace
}  // namespace benchmarks::report
