#include <gtest/gtest.h>

#include "benchmarks/viewer/script/script.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/headless_ui.h"

namespace benchmarks::viewer {
namespace {

class ScriptFile : public testing::Test {
protected:
    // Returns the error of reading a script.
    std::string problemOf(const std::string& text) {
        const std::filesystem::path file = folder_.write("script.json", text);
        return folder_.relative(errorText([&] { Script script(file); }));
    }
    std::string problemOfStep(const std::string& step) {
        return problemOf("{\"steps\": [{\"wait\": 1}, " + step + "]}");
    }

private:
    TemporaryFolder folder_;
    HeadlessUi ui_{640, 360};  // for the names of keys
};

TEST_F(ScriptFile, MayHaveEveryVerb) {
    EXPECT_EQ(
        problemOf(R"({
        "description": "all of them", "out": "pictures", "steps": [
        {"wait": 2}, {"frames": 3}, {"play": true}, {"seek": 0},
        {"set": {"/strands/density": 16, "side": 1}}, {"perform": "undo"},
        {"perform": "Show/Head"}, {"drop": "a.json"}, {"drop": ["a.hair", "b.obj"]},
        {"resize": [800, 600]}, {"move": "Play"}, {"move": {"at": [3, 4]}},
        {"click": "Play"},
        {"click": {"item": "Play", "window": "Play", "button": "right", "double": true}},
        {"drag": {"item": "Picture", "from": [0.2, 0.5], "to": [0.8, 0.5], "keys": "shift"}},
        {"drag": {"from": [10, 10], "by": [5, 0], "button": "middle"}},
        {"scroll": {"window": "Scene", "by": [0, -3]}}, {"key": "ctrl+shift+z"}, {"key": "f1"},
        {"type": "wind"}, {"screenshot": "a.png"}, {"picture": {"file": "b.png", "side": 1}},
        {"save": "scene.json"}, {"state": "state.json"},
        {"expect": {"side": 1, "hash": "0123456789abcdef", "same_hash_as": "state.json",
                    "other_hash_than": "state.json", "frame": 3,
                    "setting": {"/strands/density": 16}, "no_problem": true, "problem": "^$",
                    "message": "saved", "clipboard": "-a", "sides": 2,
                    "item": {"item": "Head", "checked": true},
                    "nothing_clipped": true, "nothing_outside": true}}]})"),
        "no error");
}

TEST_F(ScriptFile, NamesTheVerbsItCouldHave) {
    EXPECT_EQ(
        problemOfStep(R"({"clik": "Play"})"),
        "script.json: /steps/1: unknown verb (did you mean 'click'?); known: wait, frames, play, "
        "seek, set, perform, drop, resize, move, click, drag, scroll, key, type, screenshot, "
        "picture, save, state, live, expect, thumbnails");
}

TEST_F(ScriptFile, NamesTheMembersItCouldHave) {
    EXPECT_EQ(
        problemOfStep(R"({"click": {"itme": "Play"}})"),
        "script.json: /steps/1/click: unknown key (did you mean 'item'?); known: item, window, "
        "at, button, double, hasty, keys");
    EXPECT_EQ(
        problemOf(R"({"step": []})"),
        "script.json: /step: unknown key (did you mean 'steps'?); known: description, out, "
        "steps");
}

TEST_F(ScriptFile, SaysWhereAValueIsWrong) {
    const std::pair<const char*, const char*> rows[] = {
        {R"({"wait": -1})", "/wait: expected a whole number from 0, found -1"},
        {R"({"wait": 1.5})", "/wait: expected a whole number from 0, found 1.5"},
        {R"({"play": 1})", "/play: expected true or false, found 1"},
        {R"({"resize": [800]})", "/resize: expected two numbers, [x, y], found an array of 1"},
        {R"({"set": {}})",
         "/set: expected an object of settings, as in {\"/strands/density\": 16}"},
        {R"({"click": {}})",
         "/click/at: is missing; without an item it must be a point of the window, px"},
        {R"({"drag": {"item": "Picture"}})", "/drag: needs either 'to' or 'by'"},
        {R"({"click": {"item": "a", "button": "lft"}})",
         "/click/button: unknown button (did you mean 'left'?); known: left, right, middle"},
        {R"({"perform": "Head"})", "/perform: several menus have a 'Head'; write <menu>/Head"},
        {R"({"expect": {}})", "/expect: expects nothing"},
        {R"({"expect": {"no_problem": false}})", "/expect/no_problem: expected true"},
        {R"({"expect": {"message": "("}})", "/expect/message: is not a regular expression"},
    };
    for (const auto& [step, reason] : rows)
        EXPECT_EQ(problemOfStep(step), "script.json: /steps/1" + std::string(reason)) << step;
    EXPECT_EQ(
        problemOfStep(R"({"wait": 1, "play": true})"),
        "script.json: /steps/1: expected an object with one verb, as in {\"wait\": 2}");
    EXPECT_EQ(problemOf("{}"), "script.json: /: 'steps' is missing");
    EXPECT_EQ(problemOf(R"({"steps": 3})"), "script.json: /steps: expected an array");
}

TEST_F(ScriptFile, KnowsKeys) {
    for (const char* key :
         {"a", "Z", "7", "F12", "ctrl+=", "ctrl+shift+s", "alt+1", "shift", "space", "left", ".",
          "escape"})
        EXPECT_EQ(problemOfStep("{\"key\": \"" + std::string(key) + "\"}"), "no error") << key;
    EXPECT_EQ(
        problemOfStep(R"({"key": "ctrl+spcae"})").substr(0, 69),
        "script.json: /steps/1/key: unknown key (did you mean 'space'?); known");
}

}  // namespace
}  // namespace benchmarks::viewer
