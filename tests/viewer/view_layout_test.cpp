#include <string>

#include <gtest/gtest.h>

#include "tests/viewer/view_test.h"

namespace {

using ViewLayout = ViewTest;

const std::string kGood = R"({"expect": {"nothing_clipped": true, "nothing_outside": true}})";

// Every panel of a column, in both themes, and two sides.
std::string panels() {
    std::string steps = R"({"frames": 1}, )" + kGood;
    for (const char* theme : {"Light", "Dark"}) {
        steps += R"(, {"perform": ")" + std::string(theme) + "\"}";
        for (const char* panel : {"Scene", "Files", "Timings", "Compare", "Shaders"})
            steps += R"(, {"perform": ")" + std::string(panel) + "\"}, " + kGood;
    }
    return steps + R"(, {"perform": "Compare two settings"}, {"perform": "Timings"}, )" + kGood;
}

// Returns steps that open the menus and the boxes above the panels, and show every setting; nearly
// all settings have an "e" in their names.
std::string popupsAndSettings() {
    std::string steps;
    for (const char* menu : {"File", "Camera", "Tools", "View", "Window"})
        steps += R"({"click": {"item": ")" + std::string(menu) +
                 R"(", "window": "##MainMenuBar"}}, )" + kGood + R"(, {"key": "escape"}, )";
    for (const char* dialog : {"Save scene as", "File/Open"})
        steps += R"({"perform": ")" + std::string(dialog) + R"("}, )" + kGood +
                 R"(, {"click": "Cancel"}, )";
    steps += R"({"click": "##search"}, {"type": "e"})";
    for (int i = 0; i < 8; ++i)
        steps += R"(, {"scroll": {"window": "Left/Scene/fields", "by": [0, -12]}}, )" + kGood;
    // The panel floats above the others.
    steps += R"(, {"perform": "Keys and mouse"}, {"expect": {"nothing_clipped": true}})";
    return steps;
}

std::string scriptOf(const std::string& steps) { return R"({"steps": [)" + steps + "]}"; }

TEST_F(ViewLayout, FitsIntoAUsualWindow) {
    const std::string window = "--width 1280 --height 720 --scale 1";
    expectGood(scriptOf(panels()), window);
    expectGood(scriptOf(popupsAndSettings()), window);
}

TEST_F(ViewLayout, FitsIntoAFineScreen) {
    expectGood(scriptOf(panels()), "--width 2560 --height 1440 --scale 2");
}

TEST_F(ViewLayout, FitsIntoASmallWindowWithLargeLetters) {
    const std::string window = "--width 1280 --height 720 --scale 2";
    expectGood(scriptOf(panels()), window);
    expectGood(scriptOf(popupsAndSettings()), window);
}

}  // namespace
