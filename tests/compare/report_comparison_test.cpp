#include "benchmarks/report/compare.h"

#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/compare/made_report.h"
#include "tests/error_text.h"

namespace benchmarks::report {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Returns 41 samples within 1 % of `middle`, in an order without a trend. The median is the sample
// in the middle of the order.
std::vector<double> about(double middle) {
    std::vector<double> samples;
    for (int i = 0; i < 41; ++i) samples.push_back(middle * (1.0 + 0.0005 * ((17 * i) % 41 - 20)));
    std::swap(samples[20], *std::ranges::find(samples, middle));
    return samples;
}

scene::Json
reportOf(const std::vector<scene::Json>& cases, const std::string& device = "discrete") {
    scene::Json report = madeReport(device);
    for (const scene::Json& each : cases) report["cases"].push_back(each);
    return report;
}

scene::Json frameCase(const std::string& name, double time) {
    return madeCase(name, {{"frame.time", about(time)}});
}

Verdict verdictOfOne(double a, double b) {
    const ReportComparison found =
        compareReports(reportOf({frameCase("x", a)}), reportOf({frameCase("x", b)}), {});
    EXPECT_EQ(found.changes.size(), 1u);
    return found.changes.front().comparison.verdict;
}

TEST(ReportComparison, HasFourVerdicts) {
    EXPECT_EQ(verdictOfOne(10.0, 11.0), Verdict::regressed);
    EXPECT_EQ(verdictOfOne(11.0, 10.0), Verdict::improved);
    EXPECT_EQ(verdictOfOne(10.0, 10.0), Verdict::same);
    EXPECT_EQ(verdictOfOne(10.0, 10.2), Verdict::inconclusive);
}

scene::Json codedReport(double time, double registers, double waves) {
    const auto coded = [&](const std::string& name) {
        return madeCase(
            name, {{"pass.points.time", about(time)},
                   {"shader.strands/points:comp.registers", {registers}, "1", "lower", ""},
                   {"shader.strands/points:comp.waves", {waves}, "1", "higher", ""},
                   {"shader.strands/points:comp.spills", {0.0}, "1", "lower", ""}});
    };
    return reportOf({coded("x"), coded("y")});
}

// A register more is no slowdown where times say that there is none.
TEST(ReportComparison, ExplainsTimesByChangedCode) {
    const ReportComparison same =
        compareReports(codedReport(10.0, 64.0, 8.0), codedReport(10.0, 96.0, 5.0), {});
    EXPECT_EQ(overallVerdict(same), Verdict::same);
    EXPECT_EQ(same.changes.size(), 2u);
    ASSERT_EQ(same.code.size(), 2u);
    EXPECT_EQ(same.code[0].metric.name(), "shader.strands/points:comp.registers");
    EXPECT_EQ(same.code[0].a, 64.0);
    EXPECT_EQ(same.code[0].b, 96.0);
    EXPECT_EQ(same.code[0].cases, 2u);
    EXPECT_THAT(
        codeChangesText(same.code),
        testing::ContainsRegex("strands/points:comp +registers +64 +96 +2\n"));
    const scene::Json json = comparisonJson(same, "a", "b");
    EXPECT_EQ(json["code"][1]["metric"], "shader.strands/points:comp.waves");
    EXPECT_EQ(json["code"][1]["b"], 5.0);

    const ReportComparison slower =
        compareReports(codedReport(10.0, 64.0, 8.0), codedReport(11.0, 64.0, 8.0), {});
    EXPECT_EQ(overallVerdict(slower), Verdict::regressed);
    EXPECT_THAT(slower.code, IsEmpty());
    EXPECT_EQ(codeChangesText(slower.code), "");
}

TEST(ReportComparison, JudgesCodeWhereItIsWantedOrNothingIsTimed) {
    const ReportComparison wanted = compareReports(
        codedReport(10.0, 64.0, 8.0), codedReport(10.0, 96.0, 8.0), {.metrics = "registers"});
    EXPECT_EQ(overallVerdict(wanted), Verdict::regressed);
    EXPECT_THAT(wanted.code, IsEmpty());

    const auto untimed = [](double registers) {
        return reportOf(
            {madeCase("x", {{"shader.a:comp.registers", {registers}, "1", "lower", ""}})});
    };
    const ReportComparison found = compareReports(untimed(64.0), untimed(96.0), {});
    EXPECT_EQ(overallVerdict(found), Verdict::regressed);
    EXPECT_THAT(found.code, IsEmpty());
}

TEST(ReportComparison, PairsCasesByName) {
    const ReportComparison found = compareReports(
        reportOf({frameCase("x", 10.0), frameCase("y", 20.0), frameCase("gone", 1.0)}),
        reportOf({frameCase("new", 1.0), frameCase("y", 20.0), frameCase("x", 10.0)}), {});
    EXPECT_EQ(found.common_cases, 2u);
    ASSERT_EQ(found.changes.size(), 2u);
    EXPECT_EQ(found.changes[1].case_name, "y");
    EXPECT_EQ(found.changes[1].comparison.verdict, Verdict::same);
    EXPECT_THAT(found.unmatched, ElementsAre("only in A: gone", "only in B: new"));
}

// A version may lack a pass of the other version.
TEST(ReportComparison, NamesPassesThatOneReportLacks) {
    const auto passes = [](const std::string& name, const std::vector<const char*>& timed) {
        std::vector<MadeMetric> metrics;
        for (const char* metric : timed) metrics.push_back({metric, about(1.0)});
        return madeCase(name, metrics);
    };
    const ReportComparison found = compareReports(
        reportOf(
            {passes("x", {"pass.wind.time", "pass.strands.time", "pass.wind.cpu.time"}),
             passes("y", {"pass.wind.time", "pass.strands.time"})}),
        reportOf(
            {passes("x", {"pass.strands.time"}),
             passes("y", {"pass.strands.time", "pass.points.time"})}),
        {});
    EXPECT_EQ(found.changes.size(), 2u);
    EXPECT_THAT(
        found.unmatched,
        ElementsAre(
            "only in A: pass.wind.time, of 2 cases", "only in B: pass.points.time, of 1 case"));
}

TEST(ReportComparison, ComparesNoTimesOfDifferentWork) {
    scene::Json other = frameCase("x", 20.0);
    other["image_hash"] = "00000000000000ff";
    const ReportComparison found = compareReports(
        reportOf({frameCase("x", 10.0), frameCase("y", 10.0)}),
        reportOf({other, frameCase("y", 10.0)}), {});
    ASSERT_EQ(found.mismatches.size(), 1u);
    EXPECT_EQ(
        mismatchText(found.mismatches[0]),
        "x: the pictures differ: 00000000000000aa and 00000000000000ff");
    ASSERT_EQ(found.changes.size(), 1u);
    EXPECT_EQ(found.changes[0].case_name, "y");
    EXPECT_EQ(overallVerdict(found), Verdict::mismatch);
}

TEST(ReportComparison, TakesAHashThatIsNotKnownForNone) {
    scene::Json older = frameCase("x", 10.0);
    older.erase("state_hash");
    EXPECT_THAT(
        compareReports(reportOf({older}), reportOf({frameCase("x", 10.0)}), {}).mismatches,
        IsEmpty());
}

TEST(ReportComparison, TakesACaseThatOnlyOnePlayedForAMismatch) {
    const ReportComparison found = compareReports(
        reportOf({frameCase("x", 10.0), failedCase("y", "no")}),
        reportOf({failedCase("x", "no such groom"), failedCase("y", "no")}), {});
    ASSERT_EQ(found.mismatches.size(), 1u);
    EXPECT_EQ(found.mismatches[0].b, "failed: no such groom");
}

TEST(ReportComparison, WarnsOfOtherSurroundings) {
    scene::Json b = reportOf({frameCase("x", 10.0)}, "cpu");
    b["environment"]["host"]["processor"] = "Slide rule";
    b["scene"]["hash"] = "fedcba9876543210";
    const ReportComparison found = compareReports(reportOf({frameCase("x", 10.0)}), b, {});
    EXPECT_FALSE(found.same_device);
    EXPECT_THAT(
        found.warnings, ElementsAre(
                            "kind of device: discrete and cpu", "processor: Abacus and Slide rule",
                            "scene: 0123456789abcdef and fedcba9876543210"));
}

TEST(ReportComparison, WarnsOfAnotherBoardOfTheSameModel) {
    scene::Json a = reportOf({frameCase("x", 10.0)}), b = a;
    a["environment"]["device"].update(
        {{"board", "00000000000000aa"}, {"pci_address", "0000:65:00.0"}, {"power_limit_w", 300.0}});
    b["environment"]["device"].update(
        {{"board", "00000000000000bb"}, {"pci_address", "0000:b3:00.0"}, {"power_limit_w", 250.0}});
    const ReportComparison found = compareReports(a, b, {});
    EXPECT_TRUE(found.same_device);
    EXPECT_THAT(
        found.warnings, ElementsAre(
                            "board: 00000000000000aa and 00000000000000bb",
                            "PCI address: 0000:65:00.0 and 0000:b3:00.0",
                            "board's power limit in W: 300.0 and 250.0"));
    b = a;
    b["environment"]["device"].erase("board");  // an older report
    EXPECT_THAT(compareReports(a, b, {}).warnings, testing::IsEmpty());
}

TEST(ReportComparison, ComparesNoTwoWaysOfTiming) {
    const scene::Json a = reportOf({madeCase("x", {{"pass.wind.time", about(1.0)}})});
    const scene::Json b =
        reportOf({madeCase("x", {{"pass.wind.time", about(2.0), "ms", "lower", "wall_clock"}})});
    const ReportComparison found = compareReports(a, b, {});
    EXPECT_THAT(found.changes, IsEmpty());
    EXPECT_THAT(found.warnings, Contains(HasSubstr("isolated and wall_clock")));
}

TEST(ReportComparison, JudgesWhatIsAskedFor) {
    const auto report = [](double time, double rate, double bytes) {
        return reportOf({madeCase(
            "x", {{"frame.time", about(time)},
                  {"fps", about(rate), "1/s", "higher"},
                  {"memory.device", {bytes}, "B"}})});
    };
    const ReportComparison found = compareReports(
        report(10.0, 100.0, 1000.0), report(20.0, 50.0, 1030.0), {.metrics = "fps|memory"});
    ASSERT_EQ(found.changes.size(), 2u);
    EXPECT_EQ(found.changes[0].metric.name(), "fps");
    EXPECT_EQ(found.changes[0].comparison.verdict, Verdict::regressed);
    EXPECT_NEAR(found.changes[0].comparison.change, 1.0, 1e-9);  // a frame takes twice as long
    // Bytes are counted, so one sample shows that there are 3 % more.
    EXPECT_EQ(found.changes[1].comparison.verdict, Verdict::regressed);
    EXPECT_EQ(
        errorText([&] {
            compareReports(report(1, 1, 1), report(1, 1, 1), {.metrics = "("});
        }).substr(0, 10),
        "--metrics:");
}

TEST(ReportComparison, LeavesOutWhatIsTooShort) {
    // A GPU's timestamps resolve microseconds, so its times may be shorter.
    for (const auto& [type, scale] : {std::pair("cpu", 1.0), std::pair("discrete", 0.04)}) {
        const auto report = [&, type = type, scale = scale](double a, double b) {
            scene::Json made = reportOf({madeCase(
                "x", {{"pass.a.time", about(a * scale)}, {"pass.b.time", about(b * scale)}})});
            made["environment"]["device"]["type"] = type;
            return made;
        };
        const ReportComparison found = compareReports(report(0.02, 0.02), report(0.04, 0.2), {});
        ASSERT_EQ(found.too_short.size(), 1u) << type;
        EXPECT_EQ(found.too_short[0].metric.name(), "pass.a.time");
        // the time is long enough in B
        EXPECT_EQ(found.changes[0].comparison.verdict, Verdict::regressed);
    }
}

TEST(ReportComparison, NamesWhatAReportLacks) {
    EXPECT_THAT(
        errorText([] { compareReports(scene::Json::object(), scene::Json::object(), {}); }),
        HasSubstr("the reports can't be compared"));
}

// They have no noise, and some spills are infinitely more than none.
TEST(ReportComparison, JudgesFiguresOfShadersWithoutNoise) {
    const auto reportOf = [](double spills, double waves, double instructions) {
        scene::Json report = madeReport();
        const auto figure = [](const char* name, double value, const char* hint) {
            return MadeMetric{std::string("shader.a:comp.") + name, {value}, "1", hint, ""};
        };
        report["cases"].push_back(madeCase(
            "made", {figure("spills", spills, "lower"), figure("waves", waves, "higher"),
                     figure("instructions", instructions, "lower")}));
        return report;
    };
    const ReportComparison worse = compareReports(reportOf(0, 8, 100), reportOf(3, 4, 101), {});
    ASSERT_EQ(worse.changes.size(), 3u);
    for (const Change& each : worse.changes) {
        const bool same = each.metric.what == Measured::instructions;  // 1 %: below the threshold
        EXPECT_EQ(each.comparison.verdict, same ? Verdict::same : Verdict::regressed)
            << each.metric.name();
    }
    EXPECT_EQ(overallVerdict(worse), Verdict::regressed);
    const ReportComparison better = compareReports(reportOf(3, 4, 100), reportOf(0, 8, 100), {});
    EXPECT_EQ(overallVerdict(better), Verdict::improved);
}

scene::Json probedCase(const std::vector<MadeMetric>& probes, const std::string& state_hash) {
    return madeCase("x", probes, "00000000000000aa", state_hash);
}

ReportComparison probesCompared(const MadeMetric& a, const MadeMetric& b) {
    return compareReports(
        reportOf({probedCase({a}, "aa")}), reportOf({probedCase({b}, "bb")}),
        {.threshold = 0.03, .probes = true});
}

MadeMetric tips(const std::vector<double>& samples) {
    return {"probe.tip_displacement.mean", samples, "m", "", ""};
}

// The largest difference is 3 of 100: at the threshold, not above it.
TEST(ReportComparison, ComparesProbesFrameByFrame) {
    ReportComparison found = probesCompared(tips({0, -50, 100}), tips({2, -53, 98}));
    EXPECT_THAT(found.mismatches, IsEmpty());  // states differ, as they may
    ASSERT_EQ(found.changes.size(), 1u);
    EXPECT_EQ(found.changes[0].comparison.verdict, Verdict::same);
    EXPECT_DOUBLE_EQ(found.changes[0].comparison.change, -0.03);
    EXPECT_EQ(found.changes[0].a, -50.0);
    EXPECT_EQ(found.changes[0].b, -53.0);
    for (const double other : {-54.0, -46.0, 300.0, -1000.0}) {
        found = probesCompared(tips({0, -50, 100}), tips({0, other, 100}));
        EXPECT_EQ(found.changes[0].comparison.verdict, Verdict::mismatch) << other;
        EXPECT_EQ(overallVerdict(found), Verdict::mismatch);
    }
}

// Hair that is no longer anywhere is not the same, wherever the others are.
TEST(ReportComparison, NeverTakesNoNumberForTheSameProbe) {
    const double kNone = std::numeric_limits<double>::quiet_NaN();
    for (const std::string name : {"probe.speed", "probe.penetration"})
        for (const std::vector<double>& samples :
             {std::vector{kNone, 1.0, 2.0}, {0.0, kNone, 2.0}, {0.0, 1.0, kNone}}) {
            const MadeMetric broken{name, samples, "m", "lower", ""};
            const MadeMetric whole{name, {0.0, 1.0, 2.0}, "m", "lower", ""};
            for (const ReportComparison& found :
                 {probesCompared(whole, broken), probesCompared(broken, whole)})
                EXPECT_EQ(overallVerdict(found), Verdict::mismatch) << name;
        }
}

// Neither is a probe without any number, which a report leaves out.
TEST(ReportComparison, NeverTakesAMissingProbeForTheSame) {
    const MadeMetric speed{"probe.speed", {1.0, 2.0}, "m/s", "", ""};
    const scene::Json both = reportOf({probedCase({tips({1, 2}), speed}, "aa")});
    const scene::Json one = reportOf({probedCase({speed}, "aa")});
    const ReportComparison found = compareReports(both, one, {.probes = true});
    ASSERT_EQ(found.mismatches.size(), 1u);
    EXPECT_EQ(
        mismatchText(found.mismatches[0]),
        found.mismatches[0].case_name +
            ": the probes differ: probe.tip_displacement.mean and none");
    EXPECT_EQ(overallVerdict(found), Verdict::mismatch);
    EXPECT_EQ(overallVerdict(compareReports(one, both, {.probes = true})), Verdict::mismatch);
    EXPECT_EQ(overallVerdict(compareReports(both, one, {})), Verdict::same);
}

TEST(ReportComparison, GivesProbesTheirDirection) {
    const auto depth = [](double value) {
        return MadeMetric{"probe.penetration", {0.0, value}, "m", "lower", ""};
    };
    const auto verdict = [&](double a, double b) {
        return probesCompared(depth(a), depth(b)).changes.at(0).comparison.verdict;
    };
    EXPECT_EQ(verdict(1.0, 1.1), Verdict::regressed);
    EXPECT_EQ(verdict(1.0, 0.9), Verdict::improved);
    EXPECT_EQ(verdict(1.0, 1.01), Verdict::same);
    EXPECT_EQ(verdict(0.0, 1e-9), Verdict::regressed);  // from none
    EXPECT_EQ(verdict(0.0, 0.0), Verdict::same);
}

// A hair that swings along x has a momentum along z that is noise.
TEST(ReportComparison, ComparesComponentsWithTheirVector) {
    const auto swing = [](double noise, const char* hash) {
        return reportOf({probedCase(
            {{"probe.momentum.x", {1.0, -1.0}, "kg m/s", "", ""},
             {"probe.momentum.z", {noise, -noise}, "kg m/s", "", ""}},
            hash)});
    };
    const ReportComparison found =
        compareReports(swing(1e-9, "aa"), swing(-1e-9, "bb"), {.probes = true});
    ASSERT_EQ(found.changes.size(), 2u);
    for (const Change& each : found.changes)
        EXPECT_EQ(each.comparison.verdict, Verdict::same) << each.metric.name();
}

TEST(ReportComparison, JudgesProbesOnlyOnRequest) {
    const scene::Json a = reportOf({probedCase({tips({1.0}), {"frame.time", about(1.0)}}, "aa")});
    const scene::Json b = reportOf({probedCase({tips({2.0}), {"frame.time", about(1.0)}}, "aa")});
    const ReportComparison times = compareReports(a, b, {});
    ASSERT_EQ(times.changes.size(), 1u);
    EXPECT_EQ(times.changes[0].metric.name(), "frame.time");
    const ReportComparison probes = compareReports(a, b, {.probes = true});
    ASSERT_EQ(probes.changes.size(), 1u);
    EXPECT_EQ(probes.changes[0].metric.name(), "probe.tip_displacement.mean");
}

TEST(ReportComparison, RefusesProbesOfOtherFrames) {
    EXPECT_EQ(
        errorText([] { probesCompared(tips({1, 2}), tips({1, 2, 3})); }),
        "the reports can't be compared: probe.tip_displacement.mean has 2 frames in A and 3 in B");
}

}  // namespace
}  // namespace benchmarks::report
