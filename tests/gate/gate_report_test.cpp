#include <gmock/gmock.h>

#include "benchmarks/doctor/reports.h"
#include "benchmarks/report/change.h"
#include "tests/gate/fake_builds.h"
#include "tests/required.h"

// Tests the gate's report.
namespace benchmarks::gate {
namespace {

using testing::IsEmpty;

std::vector<std::string> errorsOf(const FakeBuilds& builds) {
    return report::schemaErrors(
        textOf(HAIRBENCH_SOURCE_DIR "/results/gate.schema.json"), textOf(builds.reportFile()));
}

// Returns a report of two cases with two metrics, with noise that depends on the process.
scene::Json twoCases(char side, int n) {
    scene::Json report = report::madeReport();
    Noise noise(static_cast<std::uint64_t>(2 * n + (side == 'B')));
    const double cost = side == 'B' ? 1.04 : 1.0;
    for (const char* const name : {"near", "far"}) {
        const double frame = 10.0 * std::exp(0.01 * noise.normal());
        const double pass = 6.0 * cost * std::exp(0.01 * noise.normal());
        report["cases"].push_back(
            report::madeCase(name, {{"frame.time", {frame}}, {"pass.strands.time", {pass}}}));
    }
    return report;
}

TEST(GateReport, IsOfItsSchema) {
    const FakeBuilds builds(twoCases);
    builds.gate("--calibrate 12");
    EXPECT_THAT(errorsOf(builds), IsEmpty());
}

TEST(GateReport, IsOfItsSchemaHoweverTheGateEnds) {
    FakeBuilds failing(twoCases);
    failing.writeProgram('B', "exit 1");
    failing.gate();
    EXPECT_EQ(failing.report()["end"], "failed");
    EXPECT_THAT(errorsOf(failing), IsEmpty());

    const FakeBuilds different([](char side, int) {
        scene::Json report = report::madeReport();
        report["cases"].push_back(
            report::madeCase("x", {{"frame.time", {1.0}}}, std::string{side}));
        return report;
    });
    EXPECT_EQ(different.gate().status, 12);
    EXPECT_THAT(errorsOf(different), IsEmpty());

    const FakeBuilds odd([](char, int n) {  // in one process the time is missing
        scene::Json report = report::madeReport();
        report["cases"].push_back(report::madeCase(
            "x", {{n == 9 ? "fps" : "frame.time", {1.0}}, {"pass.x.time", {1.0}}}));
        return report;
    });
    const Outcome gate = odd.gate();
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(
        gate.output,
        testing::HasSubstr("missing, or timed in another way, in some process: frame.time"));
    EXPECT_EQ(odd.report()["changes"][0]["verdict"], "inconclusive");
    EXPECT_EQ(odd.report()["changes"][1]["verdict"], "same");
    EXPECT_THAT(errorsOf(odd), IsEmpty());
}

// Code of shaders that the driver tells of decides nothing.
TEST(GateReport, NamesChangedCode) {
    const FakeBuilds builds([](char side, int n) {
        scene::Json report = report::madeReport();
        report["cases"].push_back(report::madeCase(
            "x", {{"frame.time", {10.0 + 0.001 * (n % 3)}},
                  {"shader.strands/points:comp.registers",
                   {side == 'B' ? 96.0 : 64.0},
                   "1",
                   "lower",
                   ""}}));
        return report;
    });
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(gate.output, testing::ContainsRegex("strands/points:comp +registers +64 +96 +1"));
    const scene::Json report = builds.report();
    EXPECT_EQ(report["times"].size(), 1u);
    ASSERT_EQ(report["code"].size(), 1u);
    EXPECT_EQ(report["code"][0]["a"], 64.0);
    EXPECT_EQ(report["code"][0]["b"], 96.0);
    EXPECT_THAT(errorsOf(builds), IsEmpty());
}

TEST(GateReport, SchemaRefusesWhatIsNoReport) {
    EXPECT_FALSE(report::schemaErrors(
                     textOf(HAIRBENCH_SOURCE_DIR "/results/gate.schema.json"),
                     R"({"schema": "hairbench-gate/1.0.0"})")
                     .empty());
}

// Recomputes pairs from blocks, differences from medians and verdicts from differences.
TEST(GateReport, HoldsAllThatItsVerdictsFollowFrom) {
    const FakeBuilds builds(twoCases);
    builds.gate("--calibrate 12");
    const scene::Json report = builds.report();
    const std::size_t count = report["times"].size();
    ASSERT_EQ(count, 4u);
    std::vector<std::vector<double>> differences(count);
    std::vector<double> decisive_changes;
    for (std::size_t i = 0; i < count; ++i) {
        std::map<int, std::map<std::string, double>> pairs;
        for (const scene::Json& block : report["blocks"])
            if (block["phase"] == "gate") pairs[block["pair"]][block["side"]] = block["medians"][i];
        for (const auto& [pair, medians] : pairs)
            differences[i].push_back(std::log(medians.at("B") / medians.at("A")));
        const auto& written = report["times"][i]["differences"];
        ASSERT_EQ(written.size(), differences[i].size());
        for (std::size_t pair = 0; pair < written.size(); ++pair)
            EXPECT_DOUBLE_EQ(written[pair].get<double>(), differences[i][pair]);
        decisive_changes.push_back(report::decisiveChange(
            report["rule"]["threshold"],
            report["times"][i]["calibration"].get<std::vector<double>>()));
    }
    for (std::size_t i = 0; i < count; ++i) {
        const scene::Json& change = report["changes"][i];
        // Each verdict follows from the pairs at the time of the verdict.
        std::vector<std::vector<double>> first = differences;
        for (std::vector<double>& each : first) each.resize(change["pairs"].get<std::size_t>());
        const std::vector<report::Comparison> again =
            report::compare(first, decisive_changes, report["rule"]["alpha"]);
        EXPECT_EQ(change["verdict"], report::verdictName(again[i].verdict));
        EXPECT_DOUBLE_EQ(change["change"].get<double>(), again[i].change);
        EXPECT_DOUBLE_EQ(change["lower"].get<double>(), again[i].lower);
        EXPECT_DOUBLE_EQ(change["p"].get<double>(), again[i].p);
    }
}

// Pairs of A with itself come in both orders, too.
TEST(GateReport, CancelsADriftInTheCalibration) {
    const FakeBuilds builds([](char, int n) {
        scene::Json report = report::madeReport();
        report["cases"].push_back(report::madeCase("x", {{"frame.time", {std::exp(0.01 * n)}}}));
        return report;
    });
    builds.gate("--calibrate 12");
    const auto calibration = builds.report()["times"][0]["calibration"].get<std::vector<double>>();
    ASSERT_EQ(calibration.size(), 12u);
    for (std::size_t i = 0; i < calibration.size(); ++i)
        EXPECT_NEAR(calibration[i], i % 2 == 0 ? 0.01 : -0.01, 1e-12);
}

// A rate falls if its cost rises: by 1 % from process to process, and in B by a quarter more. In
// the calibration, too, a difference of costs is above 0 only if the second is worse.
TEST(GateReport, TurnsRatesRoundInEveryDifference) {
    const FakeBuilds builds([](char side, int n) {
        scene::Json report = report::madeReport();
        const double rate = 100.0 * std::exp(-0.01 * n) / (side == 'B' ? 1.25 : 1.0);
        report["cases"].push_back(report::madeCase("x", {{"fps", {rate}, "1/s", "higher"}}));
        return report;
    });
    builds.gate("--calibrate 12 --metrics fps");
    const scene::Json time = builds.report()["times"][0];
    const auto calibration = time["calibration"].get<std::vector<double>>();
    const auto differences = time["differences"].get<std::vector<double>>();
    ASSERT_EQ(calibration.size(), 12u);
    ASSERT_GE(differences.size(), 8u);
    // Pairs come in both orders: A B, B A ...
    for (std::size_t i = 0; i < calibration.size(); ++i)
        EXPECT_NEAR(calibration[i], i % 2 == 0 ? 0.01 : -0.01, 1e-12);
    for (std::size_t i = 0; i < differences.size(); ++i)
        EXPECT_NEAR(differences[i], std::log(1.25) + (i % 2 == 0 ? 0.01 : -0.01), 1e-12);
}

// A gate on the real program tests only that everything fits together: its verdicts depend on the
// machine.
TEST(GateReport, IsOfItsSchemaForARealGate) {
    const TemporaryFolder folder;
    const auto out = folder.file("gate.json");
    const Outcome gate = hairbench(
        "gate --a '" HAIRBENCH_PROGRAM "' --b '" HAIRBENCH_PROGRAM
        "' --scene '" HAIRBENCH_SCENES_DIR "/smoke.json' --filter msaa:1 --frames 2 --warmup 2 "
        "--set /render/width=32 --set /render/height=32 --set /groom/guides=4 "
        "--max-time 0 --threshold 1000% -o " +
        out.string());
    if (gate.status == 77) return skipWithout(Need::device, "no Vulkan device");
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(
        report::schemaErrors(textOf(HAIRBENCH_SOURCE_DIR "/results/gate.schema.json"), textOf(out)),
        IsEmpty());
    EXPECT_THAT(scene::Json::parse(textOf(out))["changes"], testing::Not(IsEmpty()));
}

}  // namespace
}  // namespace benchmarks::gate
