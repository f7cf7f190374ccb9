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

}  // namespace
