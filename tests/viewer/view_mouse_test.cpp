#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "tests/viewer/view_test.h"

namespace {

using ViewMouse = ViewTest;

// Menus, buttons, fields and keys as a user sees them.
TEST_F(ViewMouse, AndKeysReachWhatIsInTheWindow) {
    expectGood(
        R"({"steps": [
            {"click": {"item": "Step", "window": "Play"}}, {"expect": {"frame": 1}},
            {"click": "Show"}, {"click": "Guides"},
            {"expect": {"setting": {"/render/overlays/guides": true}}},
            {"key": "1"}, {"expect": {"setting": {"/render/overlays/guides": false}}},
            {"key": "ctrl+z"}, {"expect": {"setting": {"/render/overlays/guides": true}}},
            {"click": "##search"}, {"type": "density"},
            {"click": {"item": "/strands/density", "double": true}}, {"key": "ctrl+a"},
            {"type": "8"}, {"key": "enter"},
            {"expect": {"setting": {"/strands/density": 8}, "no_problem": true}},
            {"click": "/strands/density/reset"},
            {"expect": {"setting": {"/strands/density": 4}}},
            {"state": "0.json"},
            {"drag": {"item": "##picture", "from": [0.4, 0.5], "to": [0.6, 0.5]}},
            {"expect": {"other_hash_than": "0.json", "frame": 1}}]})",
        "--width 1000 --height 600");
}

// A click comes with movement: a hand that is still on its way when it presses, and that is not
// steady while the button is down. 5 px are no drag, 12 px are one.
TEST_F(ViewMouse, ClicksThatAreNoDragsMoveNothing) {
    expectGood(
        R"({"steps": [
            {"state": "0.json"},
            {"move": {"item": "##picture", "at": [0.1, 0.1]}},
            {"click": {"item": "##picture", "at": [0.8, 0.3], "hasty": true}},
            {"expect": {"same_hash_as": "0.json"}},
            {"click": {"item": "##picture", "at": [0.1, 0.8], "button": "right", "hasty": true}},
            {"expect": {"same_hash_as": "0.json"}},
            {"drag": {"item": "##picture", "from": [0.4, 0.5], "by": [4, -3]}},
            {"wait": 30},
            {"drag": {"item": "##picture", "from": [0.4, 0.5], "by": [4, -3], "keys": "shift"}},
            {"expect": {"same_hash_as": "0.json"}},
            {"drag": {"item": "##picture", "from": [0.4, 0.5], "by": [12, 0]}},
            {"expect": {"other_hash_than": "0.json"}}, {"key": "ctrl+z"},
            {"expect": {"same_hash_as": "0.json"}},
            {"key": "l"},
            {"drag": {"item": "##picture", "from": [0.608, 0.221], "by": [4, -3]}},
            {"expect": {"same_hash_as": "0.json"}}, {"wait": 30},
            {"drag": {"item": "##picture", "from": [0.608, 0.221], "by": [12, 0]}},
            {"expect": {"other_hash_than": "0.json"}}]})",
        "--width 1200 --height 700 -a /camera/field_of_view=45");
}

// The splitter of a column and the line between two pictures follow drags only.
TEST_F(ViewMouse, ClicksOnEdgesMoveNothing) {
    expectGood(
        R"({"steps": [
            {"perform": "Window/Compare two settings"}, {"perform": "Window/Compare"},
            {"wait": 6}, {"click": "Slider"},
            {"state": "0.json"},
            {"move": {"item": "##picture", "at": [0.2, 0.1]}},
            {"click": {"item": "##bar", "window": "Left splitter", "hasty": true}},
            {"drag": {"item": "##bar", "window": "Left splitter", "from": [0.5, 0.3],
                      "by": [-4, 3]}},
            {"click": {"item": "##divider", "at": [0.1, 0.3]}},
            {"drag": {"item": "##divider", "from": [0.9, 0.3], "by": [-4, 3]}},
            {"state": "clicked.json"},
            {"drag": {"item": "##bar", "window": "Left splitter", "from": [0.5, 0.3],
                      "by": [30, 0]}},
            {"drag": {"item": "##divider", "from": [0.5, 0.3], "by": [30, 0]}},
            {"state": "dragged.json"}]})",
        "--width 1200 --height 700");
    const auto left = [&](const char* file, std::string_view window, std::string_view label) {
        const nlohmann::json document = state(file);
        for (const nlohmann::json& item : document["items"])
            if (item["window"] == window && item["label"] == label)
                return item["rect"][0].get<double>();
        ADD_FAILURE() << file << ": no " << label << " in " << window;
        return 0.0;
    };
    for (const auto& [window, label] :
         {std::pair{"Left splitter", "##bar"}, std::pair{"Picture/picture", "##divider"}}) {
        EXPECT_EQ(left("clicked.json", window, label), left("0.json", window, label)) << label;
        EXPECT_GT(left("dragged.json", window, label), left("clicked.json", window, label) + 20.0)
            << label;
    }
}

}  // namespace
