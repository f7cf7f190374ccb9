#include <gtest/gtest.h>

#include "tests/viewer/view_test.h"

namespace {

class ViewFailure : public ViewTest {
protected:
    void expectFailure(int status, const std::string& steps, const std::string& line) {
        const Outcome outcome = view("{\"steps\": [" + steps + "]}", "--width 640 --height 360");
        EXPECT_EQ(outcome.status, status) << steps;
        EXPECT_EQ(outcome.output, line + '\n');
    }
};

TEST_F(ViewFailure, OfAStepSaysWhichAndWhy) {
    expectFailure(
        3, R"({"frames": 1}, {"expect": {"frame": 7}})",
        "script.json: /steps/1: it is frame 1, not 7");
    expectFailure(
        3, R"({"set": {"/strands/density": 5000}})",
        "script.json: /steps/0: /strands/density: 5000 is outside [1, 4096] count");
}

TEST_F(ViewFailure, OfReadingAScriptIsAMistakeOfTheUsers) {
    expectFailure(
        2, R"({"wait": "long"})",
        "hairbench: script.json: /steps/0/wait: expected a whole number from 0, found the string "
        "\"long\"");
}

TEST_F(ViewFailure, IsAWindowThatClosesBeforeTheScriptEnds) {
    expectFailure(
        3, R"({"perform": "Quit"}, {"expect": {"frame": 0}})",
        "script.json: /steps/1: the window was closed before this step");
}

// Needs no display, because it tests the error without one.
TEST(ViewWithoutDisplay, SaysSoInOneLineAndWhatDrawsWithoutOne) {
    const Outcome outcome = hairbench(
        "view '" HAIRBENCH_SCENES_DIR "/smoke.json'",
        "env -u DISPLAY -u WAYLAND_DISPLAY -u XDG_RUNTIME_DIR ");
    EXPECT_EQ(outcome.status, 77);
    EXPECT_NE(outcome.output.find("hairbench render"), std::string::npos) << outcome.output;
    EXPECT_EQ(outcome.output.find('\n') + 1, outcome.output.size()) << outcome.output;
}

}  // namespace
