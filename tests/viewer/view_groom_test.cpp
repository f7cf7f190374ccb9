#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/viewer/view_test.h"

namespace {

using ViewGroom = ViewTest;

// Drags each brush over the hair. A stroke is an entry of /groom/edits and one undo step. The saved
// scene plays to the same picture.
TEST_F(ViewGroom, StrokesAreKeptInTheScene) {
    expectGood(
        R"({"steps": [{"frames": 1}, {"key": "b"},
            {"state": "before.json"},
            {"drag": {"item": "##picture", "from": [0.4, 0.6], "to": [0.3, 0.6]}},
            {"expect": {"frame": 1, "no_problem": true, "other_hash_than": "before.json",
                        "setting": {"/groom/edits/0/tool": "comb"}}},
            {"state": "combed.json"},
            {"click": "Cut"}, {"key": "]"}, {"key": "]"},
            {"drag": {"item": "##picture", "from": [0.6, 0.75], "to": [0.56, 0.75]}},
            {"expect": {"other_hash_than": "combed.json",
                        "setting": {"/groom/edits/1/tool": "cut"}}},
            {"key": "ctrl+z"}, {"expect": {"same_hash_as": "combed.json"}},
            {"key": "ctrl+z"}, {"expect": {"same_hash_as": "before.json"}},
            {"key": "ctrl+y"}, {"key": "ctrl+y"},
            {"click": "Push"}, {"click": {"item": "##picture", "at": [0.5, 0.33]}},
            {"click": "Clump"},
            {"drag": {"item": "##picture", "from": [0.5, 0.33], "to": [0.45, 0.36]}},
            {"click": "Lengthen"}, {"click": {"item": "##picture", "at": [0.61, 0.6]}},
            {"expect": {"frame": 1, "no_problem": true,
                        "setting": {"/groom/edits/2/tool": "push",
                                    "/groom/edits/3/tool": "clump",
                                    "/groom/edits/4/tool": "lengthen"}}},
            {"save": "brushed.json"}, {"state": "shown.json"}]})",
        "--width 1200 --height 700 -a /camera/field_of_view=45");
    const nlohmann::json settings = state("shown.json")["sides"][0]["settings"];
    ASSERT_EQ(settings["groom"]["edits"].size(), 5u);
    // Two key presses widen the brush.
    EXPECT_GT(settings["groom"]["edits"][1]["radius"], settings["groom"]["edits"][0]["radius"]);
    EXPECT_GE(settings["groom"]["edits"][0]["path"].size(), 2u);

    const std::string shown = state("shown.json")["sides"][0].value("image_hash", "none");
    const Outcome rendered = run("render brushed.json --frame 1 -o brushed.png");
    EXPECT_EQ(rendered.status, 0) << rendered.output;
    EXPECT_THAT(rendered.output, testing::HasSubstr("image " + shown));
}

// Beside the hair, the mouse orbits as with other tools. All strokes can be removed.
TEST_F(ViewGroom, LeaveTheCameraBesideTheHair) {
    expectGood(
        R"({"steps": [{"state": "0.json"}, {"key": "b"},
            {"drag": {"item": "##picture", "from": [0.02, 0.1], "to": [0.1, 0.1]}},
            {"expect": {"setting": {"/groom/edits": []}, "other_hash_than": "0.json"}},
            {"key": "ctrl+z"}, {"expect": {"same_hash_as": "0.json"}},
            {"drag": {"item": "##picture", "from": [0.4, 0.6], "to": [0.3, 0.6]}},
            {"expect": {"other_hash_than": "0.json"}},
            {"click": "clear_strokes"},
            {"expect": {"setting": {"/groom/edits": []}, "same_hash_as": "0.json"}}]})",
        "--width 1200 --height 700 -a /camera/field_of_view=45");
}

TEST_F(ViewGroom, LightsAreDragged) {
    expectGood(
        R"({"steps": [{"state": "0.json"}, {"key": "l"},
            {"click": {"item": "Strength", "double": true, "keys": "ctrl"}}, {"key": "ctrl+a"},
            {"type": "0.5"}, {"key": "enter"},
            {"expect": {"setting": {"/shading/lights/0/strength": 0.5},
                        "other_hash_than": "0.json", "no_problem": true}},
            {"state": "weak.json"},
            {"drag": {"item": "##picture", "from": [0.608, 0.221], "to": [0.4, 0.25]}},
            {"expect": {"other_hash_than": "weak.json"}}, {"state": "left.json"},
            {"key": "ctrl+z"}, {"expect": {"same_hash_as": "weak.json"}}]})",
        "--width 1200 --height 700 -a /camera/field_of_view=45");
    // The light now shines from the other side, at the same distance.
    const auto lightIn = [&](const char* file) {
        return state(file)["sides"][0]["settings"]["shading"]["lights"][0]["position"]
            .get<std::vector<double>>();
    };
    const std::vector<double> right = lightIn("weak.json"), left = lightIn("left.json");
    EXPECT_GT(right[0], 1.0);
    EXPECT_LT(left[0], -1.0);
    // Distances are from the groom's middle, within 0.2 m of the origin.
    EXPECT_NEAR(
        std::hypot(left[0], left[1], left[2]), std::hypot(right[0], right[1], right[2]), 0.4);
}

// The scrubber plays in parts, forward and from the start, to the same picture as a direct seek.
TEST_F(ViewGroom, TheTimelinePlaysToAFrame) {
    expectGood(
        R"({"steps": [{"seek": 60}, {"state": "60.json"}, {"seek": 0},
            {"click": {"item": "##timeline", "at": [0.502, 0.5]}}, {"wait": 12},
            {"state": "there.json"},
            {"click": {"item": "##timeline", "at": [0.1, 0.5]}}, {"wait": 12},
            {"state": "back.json"}]})",
        "--width 1200 --height 700 -a /camera/field_of_view=45");
    const auto frameOf = [&](const char* file) {
        return state(file)["sides"][0].value("frame", 0);
    };
    // The bar has frames 0 to 119. Its ends lie half a letter inside the item.
    EXPECT_EQ(frameOf("there.json"), 60);
    EXPECT_EQ(
        state("there.json")["sides"][0]["image_hash"], state("60.json")["sides"][0]["image_hash"]);
    EXPECT_NEAR(frameOf("back.json"), 12, 3);
}

// Views of strands in the menu View.
TEST_F(ViewGroom, ViewsAreInTheMenu) {
    for (const std::string view : {"tangents", "shadow", "overdraw", "density"}) {
        expectGood(
            R"({"steps": [{"state": "0.json"}, {"perform": "View/Strands: )" + view +
                R"("}, {"expect": {"other_hash_than": "0.json", "no_problem": true}},
                {"perform": "View/Strands: light"},
                {"expect": {"same_hash_as": "0.json"}}]})",
            "--width 640 --height 360");
    }
}

}  // namespace
