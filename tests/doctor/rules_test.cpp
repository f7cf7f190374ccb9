#include "benchmarks/doctor/reports.h"

#include <functional>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/error_text.h"

namespace benchmarks::doctor {
namespace {

using scene::Json;
using testing::ElementsAre;
using testing::HasSubstr;

// Four frames of 10, 10, 10 and 20 ms are 4 frames in 50 ms: 80 a second.
Json rulesReport() {
    const Json frames = {
        {"unit", "ms"},
        {"mode", "overlapped"},
        {"mean", 12.5},
        {"samples", {10, 10, 10, 20}},
        {"percentile_5", 10},
        {"percentile_95", 20},
        {"percentile_99", 20},
        {"effective_samples", 4},
        {"interval", {{"lower", 10}, {"upper", 20}, {"confidence", 0.95}}}};
    const Json measured = {
        {"name", "a"},
        {"status", "ok"},
        {"metrics",
         {{"frame.time", frames},
          {"fps", {{"unit", "1/s"}, {"mode", "overlapped"}, {"mean", 80}, {"samples", {80}}}}}},
        {"sampling", {{{"mode", "overlapped"}}}},
        {"image_hash", "1"},
        {"state_hash", "2"}};
    return {
        {"environment",
         {{"device", {{"name", "Card 7"}, {"driver_version", "1.2"}}},
          {"host", {{"processor", "Chip"}, {"system", "Linux"}}},
          {"build",
           {{"version", "1"}, {"commit", "abc"}, {"compiler", "GCC"}, {"type", "Release"}}},
          {"command", {"hairbench", "run", "x.json"}}}},
        {"scene", {{"hash", "3"}, {"document", Json::object()}}},
        {"methods", "Times were taken."},
        {"cases",
         {measured, {{"name", "b"}, {"status", "skipped"}, {"reason", "no geometry stages"}}}}};
}

std::vector<std::string> rulesVerdicts(const Json& report) {
    std::vector<std::string> verdicts;
    for (const RuleFinding& finding : judgeRules(report))
        verdicts.emplace_back(ruleVerdictName(finding.verdict));
    return verdicts;
}

TEST(Rules, AreTwelveOfWhichAReportCanMeetNine) {
    const std::vector<RuleFinding> findings = judgeRules(rulesReport());
    EXPECT_THAT(
        rulesVerdicts(rulesReport()), ElementsAre(
                                          "met", "met", "met", "met", "met", "met", "author", "met",
                                          "met", "met", "author", "author"));
    EXPECT_TRUE(meetsRules(findings));
    EXPECT_THAT(
        rulesText(findings),
        HasSubstr("9 of 12 rules are met by the report, 0 are not, 3 are for the author"));
}

TEST(Rules, SayWhatTheyCannotJudge) {
    for (const auto& [pointer, value] :
         {std::pair{"/interrupted", Json(5)},
          {"/cases/0/metrics/fps/mean", Json::array()},
          {"/environment", Json()}}) {
        Json report = rulesReport();
        report[Json::json_pointer(pointer)] = value;
        EXPECT_THAT(
            errorText([&] { judgeRules(report); }),
            testing::StartsWith("the report can't be judged: "))
            << pointer;
    }
}

// Each fault breaks the named rule and no other.
TEST(Rules, AreNotMetByWhatAReportLacks) {
    struct Lack {
        std::size_t rule;  // from 1
        const char* seen;
        std::function<void(Json& report)> plant;
    };
    const auto frames = [](Json& report) -> Json& {
        return report["cases"][0]["metrics"]["frame.time"];
    };
    const Lack lacks[] = {
        {1, "a has no frame time",
         [](Json& report) {
             Json& metrics = report["cases"][0]["metrics"];
             metrics["pass.strands.time"] = metrics["frame.time"];
             metrics.erase("frame.time");
         }},
        {2, "interrupted", [](Json& report) { report["interrupted"] = true; }},
        {2, "1 case without times", [](Json& report) { report["cases"][1]["reason"] = ""; }},
        // The arithmetic mean of the four rates: (100 + 100 + 100 + 50) / 4.
        {3, "fps of a", [](Json& report) { report["cases"][0]["metrics"]["fps"]["mean"] = 87.5; }},
        {5, "1 of 1 time have too few samples",
         [&](Json& report) { frames(report).erase("interval"); }},
        {6, "1 time is not known",
         [&](Json& report) { frames(report).erase("effective_samples"); }},
        {8, "no percentiles", [&](Json& report) { frames(report).erase("percentile_99"); }},
        {9, "unknown: /environment/host/processor",
         [](Json& report) { report["environment"]["host"].erase("processor"); }},
        {9, "differ from their commit",
         [](Json& report) { report["environment"]["build"]["dirty"] = true; }},
        {10, "is not known", [](Json& report) { report["cases"][0].erase("sampling"); }},
        {10, "no paragraph", [](Json& report) { report.erase("methods"); }}};
    const std::vector<std::string> healthy = rulesVerdicts(rulesReport());
    for (const Lack& lack : lacks) {
        Json report = rulesReport();
        lack.plant(report);
        std::vector<std::string> expected = healthy;
        expected[lack.rule - 1] = "not met";
        EXPECT_EQ(rulesVerdicts(report), expected) << lack.seen;
        EXPECT_THAT(judgeRules(report)[lack.rule - 1].seen, HasSubstr(lack.seen));
        EXPECT_FALSE(meetsRules(judgeRules(report)));
    }
}

TEST(Rules, LeaveToTheAuthorWhyAPartWasMeasured) {
    Json report = rulesReport();
    report["environment"]["command"] = {"hairbench", "run", "x.json", "--filter=msaa:1"};
    EXPECT_EQ(rulesVerdicts(report)[1], "author");
    EXPECT_TRUE(meetsRules(judgeRules(report)));
}

}  // namespace
}  // namespace benchmarks::doctor
