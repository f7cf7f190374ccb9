// Bounds are those of docs/measuring.md.
#include "benchmarks/report/verdict.h"
#include "engine/instance.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/benchmarks/judged_report.h"

namespace benchmarks::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

using Change = std::function<void(Report&)>;

CaseVerdict verdictOn(const Change& change) {
    const scene::Json report = judgedReport(change);
    return judgeCase(report.at("environment"), report.at("cases")[0]).value();
}

Trusted levelOf(const Change& change) { return verdictOn(change).level; }

Change others(double share, engine::DeviceType device = engine::DeviceType::cpu) {
    return [=](Report& report) {
        report.environment.device.type = device;
        report.cases[0].conditions.other_load = share;
    };
}

Change stolen(double share, engine::DeviceType device = engine::DeviceType::cpu) {
    return [=](Report& report) {
        report.environment.device.type = device;
        report.cases[0].conditions.steal = share;
    };
}

// A board at its power limit is not throttled if its clock stays within 3 % (docs/measuring.md).
TEST(IsThrottled, AtThePowerLimitIfTheClockFalls) {
    const auto capped = [](double clock) {
        return Conditions{
            .clock_mhz = clock, .lowest_clock_mhz = clock, .throttle_reasons = {kPowerCap}};
    };
    EXPECT_FALSE(isThrottled(capped(2000.0), {.shaders = 2000.0}, {}));
    EXPECT_FALSE(isThrottled(capped(1941.0), {.shaders = 2000.0}, {}));
    EXPECT_TRUE(isThrottled(capped(1939.0), {.shaders = 2000.0}, {}));
}

TEST(CaseVerdict, IsTrustedWithoutAReasonAgainstIt) {
    const CaseVerdict verdict = verdictOn({});
    EXPECT_EQ(verdict.level, Trusted::trusted);
    EXPECT_THAT(verdict.doubts, IsEmpty());
    EXPECT_EQ(verdictText(verdict), "trusted");
}

TEST(CaseVerdict, FallsWithOthersLoad) {
    EXPECT_EQ(levelOf(others(0.05)), Trusted::trusted);
    EXPECT_EQ(levelOf(others(0.051)), Trusted::doubtful);
    EXPECT_EQ(levelOf(others(0.25)), Trusted::doubtful);
    EXPECT_EQ(levelOf(others(0.251)), Trusted::untrusted);
    EXPECT_EQ(levelOf(others(0.9, engine::DeviceType::discrete)), Trusted::doubtful);
    // An integrated GPU shares the processors' power and memory.
    EXPECT_EQ(levelOf(others(0.25, engine::DeviceType::integrated)), Trusted::doubtful);
    EXPECT_EQ(levelOf(others(0.251, engine::DeviceType::integrated)), Trusted::untrusted);
    EXPECT_EQ(levelOf(stolen(0.9, engine::DeviceType::integrated)), Trusted::doubtful);
    EXPECT_EQ(levelOf(stolen(0.01)), Trusted::trusted);
    EXPECT_EQ(levelOf(stolen(0.011)), Trusted::doubtful);
    EXPECT_EQ(levelOf(stolen(0.101)), Trusted::untrusted);
    EXPECT_EQ(levelOf(stolen(0.9, engine::DeviceType::discrete)), Trusted::doubtful);
}

TEST(CaseVerdict, FallsWithHeatAndOtherLimitsOfTheClock) {
    const auto limited = [](std::vector<std::string> reasons, std::optional<double> clock) {
        return levelOf([&](Report& report) {
            report.environment.device.type = engine::DeviceType::discrete;
            report.cases[0].conditions.clock_mhz = clock;
            report.cases[0].conditions.throttle_reasons = std::move(reasons);
        });
    };
    EXPECT_EQ(limited({}, 1500.0), Trusted::trusted);
    EXPECT_EQ(limited({"thermal slowdown"}, 1500.0), Trusted::untrusted);
    EXPECT_EQ(limited({"application clocks"}, 1500.0), Trusted::doubtful);
    // A board at its limit of power or current is as it should be while its clock is known to keep.
    for (const char* limit : {kPowerCap, kCurrentLimit}) {
        EXPECT_EQ(limited({limit}, 1500.0), Trusted::doubtful);
        EXPECT_EQ(limited({limit}, {}), Trusted::untrusted);
    }
}

TEST(CaseVerdict, FallsWithThePasses) {
    const auto wall = [](double sum) {
        return levelOf([=](Report& report) { report.cases[0].trust.pass_sum_over_wall = sum; });
    };
    EXPECT_EQ(wall(0.91), Trusted::trusted);
    EXPECT_EQ(wall(0.89), Trusted::untrusted);
    EXPECT_EQ(wall(1.11), Trusted::untrusted);
    const auto device = [](double sum) {
        return levelOf([=](Report& report) {
            report.environment.device.type = engine::DeviceType::discrete;
            // On a fast device a submission takes longer than a frame.
            report.cases[0].trust.pass_sum_over_wall = 0.4;
            report.cases[0].trust.pass_sum_over_device = sum;
        });
    };
    EXPECT_EQ(device(0.91), Trusted::trusted);
    EXPECT_EQ(device(0.89), Trusted::untrusted);
    const auto work = [](double sum, const char* timestamps, const char* warning) {
        return levelOf([=](Report& report) {
            report.environment.device.type = engine::DeviceType::discrete;
            Trust& trust = report.cases[0].trust;
            trust = {.pass_sum_over_wall = 0.4, .pass_sum_over_device = 1.0};
            trust.pass_sum_over_work = sum;
            trust.timestamps = timestamps;
            trust.warnings = {warning};
        });
    };
    const char* const incomplete = "the passes add up to 1.00 of the device's time for the frame";
    EXPECT_EQ(work(0.89, "unchecked", incomplete), Trusted::untrusted);
    EXPECT_EQ(work(1.11, "", incomplete), Trusted::untrusted);
    EXPECT_EQ(work(2.0, "right", incomplete), Trusted::doubtful);
    EXPECT_EQ(work(0.91, "unchecked", incomplete), Trusted::trusted);
    EXPECT_EQ(work(0.89, "unchecked", "hair sags"), Trusted::trusted);  // submissions vary so much
    EXPECT_EQ(
        levelOf([](Report& report) { report.cases[0].trust.timestamps = "wrong"; }),
        Trusted::untrusted);
    EXPECT_EQ(
        levelOf([](Report& report) { report.cases[0].trust.timestamps = "unchecked"; }),
        Trusted::trusted);
    // Reports before 1.3 have the sentence alone.
    EXPECT_EQ(
        levelOf([](Report& report) {
            report.cases[0].trust.warnings = {"timestamps are not trusted: the passes' times are"};
        }),
        Trusted::untrusted);
}

TEST(CaseVerdict, FallsWithDifferentWork) {
    EXPECT_EQ(
        levelOf([](Report& report) {
            report.cases[0].trust.warnings = {"isolated rounds made different states"};
        }),
        Trusted::untrusted);
    EXPECT_EQ(
        levelOf([](Report& report) {
            report.cases[0].trust.warnings = {"a guide stretches to 1.2 of its length"};
        }),
        Trusted::trusted);
}

TEST(CaseVerdict, FallsWithDriftAndNoise) {
    EXPECT_EQ(
        levelOf([](Report& report) { report.cases[0].sampling[0].steady = false; }),
        Trusted::doubtful);
    const auto interval = [](double lower, double upper) {
        scene::Json report = judgedReport({});
        report["cases"][0]["metrics"]["frame.time"]["median"] = 10.0;
        report["cases"][0]["metrics"]["frame.time"]["interval"] = {
            {"lower", lower}, {"upper", upper}, {"confidence", 0.95}};
        return judgeCase(report.at("environment"), report.at("cases")[0]).value();
    };
    EXPECT_EQ(interval(9.6, 10.4).level, Trusted::trusted);
    EXPECT_EQ(verdictText(interval(9.4, 10.6)), "doubtful (noise 6 %)");
    const CaseVerdict few =
        verdictOn([](Report& report) { report.cases[0].metrics[0].samples = {10.0, 10.1}; });
    EXPECT_EQ(few.level, Trusted::doubtful);
    EXPECT_THAT(reasonsText(few), HasSubstr("too few frames for an interval"));
}

TEST(CaseVerdict, FallsWithTheBuildButNotWithItsChanges) {
    EXPECT_EQ(
        levelOf([](Report& report) { report.environment.build.type = "Debug"; }),
        Trusted::untrusted);
    EXPECT_EQ(
        levelOf([](Report& report) { report.environment.build.flags = "-O2 -fsanitize=address"; }),
        Trusted::untrusted);
    EXPECT_EQ(
        levelOf([](Report& report) { report.environment.validation = true; }), Trusted::untrusted);
    // Nobody can build it again, but its times are right.
    EXPECT_EQ(
        levelOf([](Report& report) { report.environment.build.dirty = true; }), Trusted::trusted);
}

TEST(CaseVerdict, NamesTheWorstReasonsFirst) {
    const CaseVerdict verdict = verdictOn([](Report& report) {
        report.cases[0].sampling[0].steady = false;
        report.cases[0].conditions.other_load = 0.73;
        report.cases[0].conditions.steal = 0.02;
    });
    EXPECT_EQ(verdictText(verdict), "untrusted (other load 73 %)");
    ASSERT_THAT(verdict.doubts, SizeIs(3));
    EXPECT_EQ(
        reasonsText(verdict),
        "other load: 73.0 % of all processors' time was used by others; steal: 2.0 % of all "
        "processors' time was given to others by the hypervisor; drift: times drifted to the end: "
        "overlapped");
    EXPECT_EQ(verdictText(verdictOn(others(0.071))), "doubtful (other load 7.1 %)");
}

TEST(CaseVerdict, IsOfCasesThatRan) {
    const scene::Json report = reportJson(sampleReport());
    EXPECT_TRUE(judgeCase(report.at("environment"), report.at("cases")[0]).has_value());
    EXPECT_FALSE(judgeCase(report.at("environment"), report.at("cases")[1]).has_value());
    EXPECT_FALSE(judgeCase(report.at("environment"), report.at("cases")[2]).has_value());
}

// A verdict that another build wrote does not count.
TEST(CaseVerdict, IsThatOfTheseRules) {
    scene::Json report = judgedReport(others(0.73));
    report["cases"][0]["trust"]["verdict"] = "trusted";
    EXPECT_EQ(verdictsOf(report).worst(), Trusted::untrusted);
    putVerdict(report.at("environment"), report["cases"][0]);
    EXPECT_EQ(report["cases"][0]["trust"]["verdict"], "untrusted");
    EXPECT_EQ(
        report["cases"][0]["trust"]["reasons"],
        scene::Json({"other load: 73.0 % of all processors' time was used by others"}));
}

// A report with a case for each of these shares of others' load.
Verdicts verdictsWith(const std::vector<double>& shares) {
    return verdictsOf(judgedReport([&](Report& report) {
        report.cases.resize(1);
        const CaseResult first = report.cases[0];
        report.cases.clear();
        for (const double share : shares) {
            report.cases.push_back(first);
            report.cases.back().conditions.other_load = share;
        }
    }));
}

TEST(Verdicts, AreCounted) {
    EXPECT_EQ(
        verdictsWith({0.0, 0.1, 0.3, 0.7, 0.1}).counts(), "1 trusted, 2 doubtful, 2 untrusted");
    EXPECT_EQ(verdictsWith({0.0}).counts(), "1 trusted");
    EXPECT_EQ(verdictsWith({}).counts(), "");
}

TEST(Verdicts, AreSaidInOneLineWhereACaseIsNotTrusted) {
    EXPECT_EQ(verdictsWith({0.0, 0.01}).summary(), "");
    EXPECT_EQ(
        verdictsWith({0.0, 0.3, 0.73, 0.41}).summary(),
        "3 of 4 cases are not to be trusted: up to 73.0 % of all processors' time was used by "
        "others; \"hairbench doctor\" says more");
    EXPECT_EQ(
        verdictsWith({0.1, 0.3}).summary(),
        "1 of 2 cases is not to be trusted, 1 is doubtful: 30.0 % of all processors' time was used "
        "by others; \"hairbench doctor\" says more");
    EXPECT_THAT(
        verdictsWith({0.1}).summary(),
        AllOf(StartsWith("1 of 1 case is doubtful: 10.0 %"), Not(HasSubstr("up to"))));
}

}  // namespace
}  // namespace benchmarks::report
