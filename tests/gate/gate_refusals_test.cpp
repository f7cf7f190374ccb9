#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>

#include "tests/gate/fake_builds.h"

// Tests gates that end before there is a verdict on times.
namespace benchmarks::gate {
namespace {

using testing::HasSubstr;
using testing::Not;

scene::Json withHashes(char side, const std::string& image, const std::string& state) {
    scene::Json report = report::madeReport();
    report["cases"].push_back(
        report::madeCase("made", {{"frame.time", {side == 'A' ? 10.0 : 20.0}}}, image, state));
    return report;
}

TEST(GateRefusals, EndAtOnceWherePicturesDiffer) {
    const FakeBuilds builds(
        [](char side, int) { return withHashes(side, side == 'A' ? "aaaa" : "bbbb", "cccc"); });
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 12) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("made: the pictures differ: aaaa and bbbb"));
    EXPECT_THAT(gate.output, Not(HasSubstr("regressed")));
    EXPECT_EQ(builds.order(), "AB");
    EXPECT_EQ(builds.report()["verdict"], "mismatch");
    EXPECT_EQ(builds.report()["changes"].size(), 0u);
}

TEST(GateRefusals, EndWhereABuildDiffersFromItself) {
    const FakeBuilds builds(
        [](char side, int n) { return withHashes(side, "aaaa", n < 5 ? "cccc" : "dddd"); });
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 12) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("The runs of A differ among themselves."));
    EXPECT_THAT(gate.output, HasSubstr("made: the states differ: cccc and dddd"));
    EXPECT_EQ(builds.order(), "ABABBA");
}

TEST(GateRefusals, EndWhereOneBuildCannotPlayACase) {
    const FakeBuilds builds([](char side, int) {
        scene::Json report = withHashes(side, "aaaa", "cccc");
        report["cases"].push_back(
            side == 'A' ? report::madeCase("other", {{"frame.time", {1.0}}})
                        : report::failedCase("other", "no such groom"));
        return report;
    });
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 12) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("other: the outcomes differ: ok and failed: no such groom"));
}

TEST(GateRefusals, SayThatNothingRan) {
    const FakeBuilds builds([](char, int) {
        scene::Json report = report::madeReport();
        report["cases"].push_back(report::failedCase("made", "no such groom"));
        return report;
    });
    EXPECT_EQ(builds.gate().status, 14);
    EXPECT_EQ(builds.order(), "AB");
}

TEST(GateRefusals, ShowWhatAFailedProcessSaid) {
    FakeBuilds builds(FakeMachine(0.0));
    builds.writeProgram('B', "test $n -lt 6 || { echo it went wrong >&2; exit 3; }");
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 1) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("ended with status 3:\n    it went wrong\n"));
    EXPECT_EQ(builds.report()["end"], "failed");
    EXPECT_EQ(builds.report()["pairs"], 2);  // A B B A; B fails after the next A
}

TEST(GateRefusals, PassOnWhatAProcessFoundAtFault) {
    for (const int status : {2, 14, 77}) {
        FakeBuilds builds(FakeMachine(0.0));
        builds.writeProgram('A', "rm \"$4\"; exit " + std::to_string(status));
        EXPECT_EQ(builds.gate().status, status);
    }
}

TEST(GateRefusals, SayWhichSignalEndedAProcess) {
    FakeBuilds builds(FakeMachine(0.0));
    builds.writeProgram('A', "kill -SEGV $$");
    const Outcome gate = builds.gate();
    EXPECT_EQ(gate.status, 1);
    EXPECT_THAT(gate.output, HasSubstr("was ended by signal 11"));
}

TEST(GateRefusals, NameWhatIsWrongWithTheOptions) {
    const FakeBuilds builds(FakeMachine(0.0));
    const TemporaryFolder empty;
    const std::string a =
        "gate --a '" + builds.program('A') + "' --scene s.json -o " + builds.reportFile().string();
    EXPECT_THAT(
        hairbench(a + " --b " + empty.path().string()).output,
        HasSubstr("holds no benchmarks/hairbench, bin/hairbench or hairbench"));
    EXPECT_THAT(hairbench(a + " --b 'x {scene}'").output, HasSubstr("has {scene} but no {out}"));
    EXPECT_THAT(
        hairbench(a + " --b 'x {out}' --set-b /seed=2").output,
        HasSubstr("put '--set' into the command itself"));
    EXPECT_EQ(hairbench(a + " --b x --metrics '('").status, 2);
    EXPECT_THAT(
        builds.gate("--metrics nothing").output, HasSubstr("'nothing' matches no metric's name"));
    EXPECT_THAT(hairbench(a + " --b nonsense").output, HasSubstr("not found"));
}

// B's fourth process waits for the signal that the test sends only to the gate.
TEST(GateRefusals, SaveWhatIsDoneWhenInterrupted) {
    FakeBuilds builds(FakeMachine(0.0));
    const std::string waiting = builds.folder().file("waiting").string();
    const std::string ended = builds.folder().file("ended").string();
    builds.writeProgram(
        'B', "test $n -lt 6 || { trap 'echo yes > " + ended + "; exit 130' INT; echo $$ > " +
                 waiting + "; while :; do sleep 0.05; done; }");
    Outcome gate{};
    std::atomic<bool> over = false;
    // The shell becomes the gate, so it has the gate's process id.
    const std::string id_file = builds.folder().file("id").string();
    std::thread user([&] {
        gate = runInShell(
            "echo $$ > " + id_file + "; exec '" HAIRBENCH_PROGRAM "' " + builds.arguments() +
            " 2>&1");
        over = true;
    });
    while (textOf(waiting).empty() && !over)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (!over) kill(std::stoi(textOf(id_file)), SIGINT);
    user.join();
    EXPECT_EQ(gate.status, 130) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("interrupted after 2 pairs"));
    EXPECT_EQ(textOf(ended), "yes\n");
    const scene::Json report = builds.report();
    EXPECT_EQ(report["end"], "interrupted");
    EXPECT_EQ(report["pairs"], 2);
    EXPECT_EQ(report["blocks"].size(), 2u + 4u + 1u);  // warm-up, two pairs, A of the third
}

// The gate runs a 13th pair because of another pass. B's block in it waits for the signal.
TEST(GateRefusals, GiveTheLastVerdictsWhenInterruptedLater) {
    FakeBuilds builds([noise = Noise(6)](char side, int) mutable {
        scene::Json made = report::madeReport();
        const double strands = side == 'B' ? 12.0 : 8.0;
        made["cases"].push_back(report::madeCase(
            "made", {{"frame.time", {strands * (1.0 + 0.001 * noise.normal())}},
                     {"pass.resolve.time", {4.0 * (1.0 + 0.2 * noise.normal())}}}));
        return made;
    });
    const std::string waiting = builds.folder().file("waiting").string();
    builds.writeProgram(
        'B', "test $n -lt 26 || { trap 'exit 130' INT; echo $$ > " + waiting +
                 "; while :; do sleep 0.05; done; }");
    Outcome gate{};
    std::atomic<bool> over = false;
    const std::string id_file = builds.folder().file("id").string();
    std::thread user([&] {
        gate = runInShell(
            "echo $$ > " + id_file + "; exec '" HAIRBENCH_PROGRAM "' " + builds.arguments() +
            " --all 2>&1");
        over = true;
    });
    while (textOf(waiting).empty() && !over)
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (!over) kill(std::stoi(textOf(id_file)), SIGINT);
    user.join();
    EXPECT_EQ(gate.status, 10) << gate.output;
    EXPECT_THAT(gate.output, HasSubstr("the verdicts are those passed at 12 pairs"));
    const scene::Json report = builds.report();
    EXPECT_EQ(report["end"], "interrupted");
    EXPECT_EQ(report["decided_at"], 12);
    EXPECT_EQ(report["verdict"], "regressed");
    EXPECT_EQ(report["exit_status"], 10);
}

}  // namespace
}  // namespace benchmarks::gate
