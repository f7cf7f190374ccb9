#include <gmock/gmock.h>

#include "benchmarks/report/verdict.h"
#include "tests/gate/fake_builds.h"

// Tests the gate as a user runs it, with programs in place of builds.
namespace benchmarks::gate {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::Not;

TEST(GateCommand, PassesIdenticalBuilds) {
    const FakeBuilds builds(FakeMachine(0.0));
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("0 regressed, 0 improved, 1 same, 0 inconclusive"));
    EXPECT_EQ(builds.report()["verdict"], "same");
    EXPECT_EQ(builds.report()["pairs"], 12);
}

TEST(GateCommand, FailsASlowerBuild) {
    const FakeBuilds builds(FakeMachine(0.05));
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 10) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("verdict: regressed"));
    const scene::Json change = builds.report()["changes"][0];
    // Estimate from 12 pairs. Differences have a standard deviation of sqrt(2) * 0.4 % and some
    // drift. The tolerance is four standard errors.
    EXPECT_NEAR(change["change"].get<double>(), 0.05, 4.0 * 0.008 / std::sqrt(12.0));
}

TEST(GateCommand, PassesAFasterBuild) {
    const FakeBuilds builds(FakeMachine(-0.05));
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("verdict: improved"));
}

TEST(GateCommand, TakesTurnsAfterOneBlockOfEach) {
    const FakeBuilds builds(FakeMachine(0.0));
    builds.gate();
    EXPECT_EQ(
        builds.order(), "AB"
                        "ABBAABBAABBAABBAABBAABBA");
}

TEST(GateCommand, GivesBothBlocksOfAPairTheSameOrderOfCases) {
    const FakeBuilds builds(FakeMachine(0.0));
    builds.gate();
    const std::vector<std::string> calls = builds.calls();
    ASSERT_EQ(calls.size(), 26u);
    const auto seed = [&](std::size_t call) {
        const std::size_t at = calls[call].find("--order-seed ");
        return calls[call].substr(at, calls[call].find(' ', at + 13) - at);
    };
    for (std::size_t i = 2; i < calls.size(); i += 2) EXPECT_EQ(seed(i), seed(i + 1));
    EXPECT_NE(seed(2), seed(4));
}

TEST(GateCommand, HandsOptionsToTheRuns) {
    const FakeBuilds builds(FakeMachine(0.0));
    builds.gate("--axis /render/msaa=1,4 --set /seed=3 --set-a /seed=4 --set-b /seed=5 --filter x "
                "--frames 7 "
                "--device soft");
    const std::vector<std::string> calls = builds.calls();
    const std::string both = "--axis /render/msaa=1,4 --set /seed=3 ";
    EXPECT_THAT(calls.at(0), HasSubstr("run made.json --out "));
    EXPECT_THAT(calls.at(0), HasSubstr(" --no-pictures "));
    EXPECT_THAT(
        calls.at(0),
        HasSubstr(both + "--set /seed=4 --filter x --device soft --frames 7 --max-time 0.5"));
    EXPECT_THAT(calls.at(1), HasSubstr(both + "--set /seed=5 --filter x"));
}

// Results of a GPU on which strands take 8 ms, and 50 % more in B. Wind and resolve can't be
// decided: wind takes a hundredth of the frame, and resolve differs by 10 % between processes.
FakeBuilds slowStrands() {
    return FakeBuilds([noise = Noise(5)](char side, int) mutable {
        const auto off = [&](double share) { return 1.0 + share * noise.normal(); };
        const double strands = 8.0 * (side == 'B' ? 1.5 : 1.0) * off(0.004);
        scene::Json made = report::madeReport();
        made["cases"].push_back(report::madeCase(
            "made", {{"frame.time", {strands + 1.0}, "ms", "lower", "overlapped"},
                     {"pass.strands.time", {strands}},
                     {"pass.resolve.time", {0.9 * off(0.1)}},
                     {"pass.wind.time", {0.09 * off(0.1)}}}));
        return made;
    });
}

TEST(GateCommand, EndsWhenItsAnswerIsKnown) {
    const FakeBuilds builds = slowStrands();
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 10) << gate.output;
    EXPECT_EQ(builds.report()["pairs"], 8);
    EXPECT_EQ(builds.report()["decided_at"], 8);
    EXPECT_THAT(gate.output, HasSubstr("decides nothing"));
    EXPECT_THAT(gate.output, HasSubstr("2 regressed, 0 improved, 0 same, 1 inconclusive"));
    const scene::Json report = builds.report();
    for (const scene::Json& time : report["times"])
        EXPECT_EQ(time.value("decides", true), time["metric"] != "pass.wind.time");
    const FakeBuilds all = slowStrands();
    EXPECT_EQ(all.gate("--all").status, 10);
    EXPECT_GT(all.report()["pairs"], 12);
    // If passes of a hundredth of the frame do not count, there is nothing to wait for.
    const FakeBuilds large_only = slowStrands();
    EXPECT_EQ(large_only.gate("--all --smallest-share 0.5").status, 10);
    EXPECT_EQ(large_only.report()["pairs"], 8);
}

// Without any time, there is no verdict, and the gate says so.
TEST(GateCommand, SaysWhatItKnowsWhenTimeIsOver) {
    FakeBuilds builds(FakeMachine(0.05));
    const Outcome none = builds.gate("--max-minutes 0.000001");
    EXPECT_EQ(none.status, 11) << none.output;
    EXPECT_THAT(none.output, HasSubstr("out of time after 0 pairs"));
    EXPECT_EQ(builds.report()["end"], "out_of_time");
    EXPECT_EQ(builds.report()["verdict"], "inconclusive");
    EXPECT_FALSE(builds.report().contains("decided_at"));
    EXPECT_EQ(builds.gate("--max-minutes 0.000001 --fail-on regressed").status, 0);
}

// A block in which heat ended a case tells nothing about the build. Twice in a row is bad luck;
// three times in a row is the build's fault.
TEST(GateCommand, RepeatsABlockThatIsLost) {
    const auto gateOf = [](int lost) {
        return FakeBuilds([=, machine = FakeMachine(0.0)](char side, int n) {
            scene::Json report = machine(side, n);
            if (n >= 6 && n < 6 + lost) {
                scene::Json& each = report["cases"][0];
                each["status"] = "failed";
                each["reason"] = "isolated: heat or power held the device back in all 10 rounds";
                each["metrics"] = scene::Json::object();
            }
            return report;
        });
    };
    const FakeBuilds twice = gateOf(2);
    const Outcome gate = twice.gate();
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_EQ(twice.report()["repeated_blocks"], 2);
    EXPECT_EQ(twice.report()["verdict"], "same");
    EXPECT_EQ(gateOf(3).gate().status, 12);
}

// B takes 5 % longer for the same cycles.
TEST(GateCommand, BlamesTheBuildThatItsPowerCapSlows) {
    const auto gateOf = [](const std::vector<std::string>& reasons) {
        return FakeBuilds([=, machine = FakeMachine(0.0)](char side, int n) {
            scene::Json report = machine(side, n);
            const double time = machine.frameTime(side, n);
            scene::Json& each = report["cases"][0];
            each = report::madeCase(
                "made",
                {{"frame.time", {side == 'B' ? 1.05 * time : time}, "ms", "lower", "overlapped"},
                 {"frame.cycles", {1e6 * time}, "1", "lower", "overlapped"}});
            each["conditions"] = {{"clock_mhz", side == 'B' ? 1714.0 : 1800.0}};
            if (side == 'B') each["conditions"]["throttle_reasons"] = reasons;
            return report;
        });
    };
    const FakeBuilds capped = gateOf({report::kPowerCap});
    const Outcome gate = capped.gate();
    EXPECT_EQ(gate.status, 10) << gate.output;
    EXPECT_EQ(capped.report()["verdict"], "regressed");
    for (const scene::Json& block : capped.report()["blocks"])
        if (block["phase"] == "gate") {
            EXPECT_EQ(block.contains("capped"), block["side"] == "B");
        }
    const FakeBuilds free = gateOf({});
    EXPECT_EQ(free.gate().status, 0);
    EXPECT_THAT(free.gate().output, HasSubstr("by the clock alone"));
}

TEST(GateCommand, GoesOnWhileItCannotTell) {
    // A slowdown at the threshold can't be decided.
    const FakeBuilds builds(FakeMachine(0.02, 0.02));
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("48 pairs"));
    EXPECT_THAT(gate.output, HasSubstr("verdict: inconclusive"));
    EXPECT_EQ(builds.calls().size(), 2u + 96u);
}

TEST(GateCommand, FailsOnInconclusiveWhereAskedTo) {
    const FakeBuilds builds(FakeMachine(0.02, 0.02));
    EXPECT_EQ(builds.gate("--fail-on inconclusive").status, 11);
}

TEST(GateCommand, DecidesFirstWhereAskedTo) {
    const FakeBuilds builds(FakeMachine(0.05));
    EXPECT_EQ(builds.gate("--pairs 24").status, 10);
    EXPECT_EQ(builds.report()["pairs"], 24);
    EXPECT_EQ(builds.report()["rule"]["decisions"].dump(), "[24,48]");
}

TEST(GateCommand, CalibratesWithAAlone) {
    // Pairs of one build differ by sqrt(2) * 3 %, so a slowdown of 5 % is not significant.
    const FakeBuilds builds(FakeMachine(0.05, 0.03));
    const Outcome gate = builds.gate("--calibrate 48");
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_EQ(builds.order().substr(0, 2 + 96 + 4), "AB" + std::string(96, 'A') + "ABBA");
    const scene::Json report = builds.report();
    EXPECT_EQ(report["times"][0]["calibration"].size(), 48u);
    // Three standard deviations of a pair. The MAD of 48 normal values has a relative standard
    // error of 1.17 / sqrt(48) = 17 % (Rousseeuw and Croux 1993: an efficiency of 37 %).
    const double expected = 3.0 * std::sqrt(2.0) * 0.03;
    EXPECT_NEAR(
        report["changes"][0]["decisive_change"].get<double>(), expected, 3.0 * 0.17 * expected);
}

TEST(GateCommand, JudgesCpuTimeOnSoftwareDevices) {
    const auto report = [](const char* device) {
        return [device](char, int) {
            scene::Json made = report::madeReport(device);
            made["cases"].push_back(report::madeCase(
                "made", {{"frame.time", {10.0}},
                         {"frame.first.time", {99.0}},
                         {"frame.overlap", {1.0}, "ms", ""},
                         {"cpu.record.time", {1.0}},
                         {"fps", {100.0}, "1/s", "higher"},
                         {"memory.device", {1000.0}, "B"},
                         {"pass.strands.time", {8.0}},
                         {"pass.wind.time", {0.0015}},
                         {"frame.cpu.time", {15.0}},
                         {"pass.strands.cpu.time", {12.0}},
                         {"pass.strands.instructions", {1e6}, "1"}}));
            return made;
        };
    };
    const auto judged = [](const FakeBuilds& builds) {
        std::vector<std::string> names;
        const scene::Json made = builds.report();
        for (const scene::Json& each : made["changes"]) names.push_back(each["metric"]);
        return names;
    };
    const FakeBuilds software(report("cpu"));
    software.gate();
    EXPECT_THAT(
        judged(software),
        testing::ElementsAre(
            "frame.cpu.time", "pass.strands.cpu.time", "pass.strands.instructions"));
    const FakeBuilds hardware(report("discrete"));
    const Outcome gate = hardware.gate();
    EXPECT_THAT(judged(hardware), testing::ElementsAre("frame.time", "pass.strands.time"));
    EXPECT_THAT(gate.output, HasSubstr("shorter than 0.002 ms, not judged: pass.wind.time"));
    const FakeBuilds chosen(report("cpu"));
    chosen.gate("--metrics '^fps|strands.time|memory'");
    EXPECT_THAT(judged(chosen), testing::ElementsAre("fps", "memory.device", "pass.strands.time"));
}

TEST(GateCommand, TakesLowerRatesForWorse) {
    const FakeBuilds builds([](char side, int) {
        scene::Json made = report::madeReport();
        made["cases"].push_back(
            report::madeCase("made", {{"fps", {side == 'A' ? 100.0 : 80.0}, "1/s", "higher"}}));
        return made;
    });
    const Outcome gate = builds.gate("--metrics fps");
    EXPECT_EQ(gate.status, 10) << gate.output;
    EXPECT_NEAR(builds.report()["changes"][0]["change"].get<double>(), 0.25, 1e-9);
}

TEST(GateCommand, TakesACommandLine) {
    const FakeBuilds builds(FakeMachine(0.0));
    const Outcome gate = hairbench(
        "gate --a '" + builds.program('A') + "' --b 'MORE=1 nice -n 1 " + builds.program('B') +
        "' --scene 'my made.json' -o " + builds.reportFile().string());
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(builds.calls().at(1), HasSubstr("B run my made.json --out /"));
}

TEST(GateCommand, TakesACommandWithPlacesAsItIs) {
    const FakeBuilds builds(FakeMachine(0.0));
    const std::string pattern = " x {scene} y {out}'";
    const Outcome gate = hairbench(
        "gate --a '" + builds.program('A') + pattern + " --b '" + builds.program('B') + pattern +
        " --scene 'my made.json' -o " + builds.reportFile().string());
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_THAT(builds.calls(), Each(Not(HasSubstr("--out"))));
    EXPECT_THAT(builds.calls().at(0), HasSubstr("A x my made.json y /"));
}

TEST(GateCommand, FindsAProgramInABuildFolder) {
    const FakeBuilds builds(FakeMachine(0.0));
    for (const char* const place : {"old/benchmarks", "new"}) {
        const auto folder = builds.folder().file(place);
        std::filesystem::create_directories(folder);
        std::filesystem::copy_file(
            builds.program(place == std::string("new") ? 'B' : 'A'), folder / "hairbench");
    }
    const std::string folder = builds.folder().path().string();
    const Outcome gate = hairbench(
        "gate --a " + folder + "/old --b " + folder + "/new --scene made.json -o " +
        builds.reportFile().string());
    EXPECT_EQ(gate.status, 0) << gate.output;
    EXPECT_EQ(builds.order().substr(0, 6), "ABABBA");
}

}  // namespace
}  // namespace benchmarks::gate
