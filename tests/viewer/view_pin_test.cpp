#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/viewer/view_test.h"

namespace {

using ViewPin = ViewTest;

// Settings change during play, some of them back again. The saved scene plays from the start.
TEST_F(ViewPin, PlaysToThePictureThatTheWindowShowed) {
    expectGood(
        R"({"steps": [{"frames": 1},
            {"set": {"/simulation/wind/strength": 12}}, {"frames": 1},
            {"set": {"/shading/model": "kajiya_kay"}},
            {"set": {"/strands/root_width": 0.004}}, {"set": {"/strands/density": 32}},
            {"perform": "undo"}, {"perform": "undo"}, {"perform": "redo"},
            {"frames": 1},
            {"expect": {"frame": 3, "no_problem": true,
                        "setting": {"/simulation/wind/strength": 12, "/strands/density": 4,
                                    "/strands/root_width": 0.004}}},
            {"save": "saved/pinned.json"}, {"state": "shown.json"}]})",
        "--width 640 --height 360");
    const std::string shown = state("shown.json")["sides"][0].value("image_hash", "none");

    const Outcome rendered = run("render saved/pinned.json --frame 3 -o pinned.png");
    EXPECT_EQ(rendered.status, 0);
    EXPECT_THAT(rendered.output, testing::HasSubstr("image " + shown));

    // A round of the runner has two warm-up frames, the one of /run/frames and one that ends its
    // interval. The hash is that of the last one, number 3.
    const Outcome measured = run("run saved/pinned.json --out measured.json");
    EXPECT_EQ(measured.status, 0) << measured.output;
    const nlohmann::json result = state("measured.json")["cases"][0];
    EXPECT_EQ(result.value("image_hash", "absent"), shown);
    EXPECT_EQ(
        result.value("state_hash", "absent"),
        state("shown.json")["sides"][0].value("state_hash", "none"));
}

}  // namespace
