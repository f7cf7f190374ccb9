#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/pictures.h"
#include "tests/viewer/view_test.h"

namespace {

namespace fs = std::filesystem;

// Files that are opened, dropped, saved and recorded, with a cache of the test's own.
class ViewFiles : public ViewTest {
protected:
    void SetUp() override {
        ViewTest::SetUp();
        folder_.write("other/far.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/thesis.json",
            "simulation": {"settle_steps": 0},
            "strands": {"density": 4, "tessellation": 2},
            "render": {"width": 160, "height": 90},
            "camera": {"position": [0, 0, 3]}})");
        folder_.write("small_suite.json", R"({"suite": ["small.json"]})");
        setenv("XDG_CACHE_HOME", folder_.file("cache").c_str(), 1);
    }
    void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

    std::vector<fs::path> thumbnails() const {
        std::vector<fs::path> found;
        std::error_code none;
        for (const auto& each :
             fs::directory_iterator(folder_.file("cache/hairbench/thumbnails"), none))
            found.push_back(each.path());
        return found;
    }
};

// The box takes scenes by their place and puts hair into the open scene; a file that is neither is
// refused, and the scene stays.
TEST_F(ViewFiles, AreOpenedByTheDialog) {
    folder_.write("notes.txt", "no scene");
    expectGood(
        R"({"steps": [{"key": "ctrl+o"}, {"click": "other/"}, {"click": "Open###accept"},
            {"click": "far.json"}, {"click": "Open###accept"}, {"wait": 6},
            {"expect": {"message": "opened .*far.json", "setting": {"/camera/position/2": 3.0}}},
            {"key": "ctrl+o"}, {"key": "ctrl+a"}, {"type": "../notes.txt"}, {"key": "enter"},
            {"wait": 4}, {"expect": {"message": "/notes.txt: line 1: .*is not a number"}},
            {"key": "ctrl+o"}, {"click": "##path"}, {"key": "ctrl+a"}, {"type": "gone.json"},
            {"key": "enter"}, {"expect": {"item": "Cancel"}}, {"click": "Cancel"},
            {"key": "ctrl+shift+s"}, {"key": "ctrl+a"}, {"type": "mine"}, {"key": "enter"},
            {"wait": 4}, {"expect": {"message": "saved to .*other.mine.json"}}]})",
        "--width 1200 --height 700");
    EXPECT_TRUE(fs::exists(folder_.file("other/mine.json")));
}

TEST_F(ViewFiles, AreRecordedToOneThatPlays) {
    expectGood(
        R"({"steps": [{"perform": "Record"}, {"frames": 3}, {"perform": "Record"},
            {"expect": {"message": "recorded 3 frames to .*small-recording-0001.png"}},
            {"seek": 1}, {"picture": "first.png"}]})",
        "--width 640 --height 360");
    // Programs that know no animation show the first frame. recorder_test.cpp plays the others.
    EXPECT_EQ(
        engine::readImage(folder_.file("hairbench-small-recording-0001.png")).rgba,
        engine::readImage(folder_.file("first.png")).rgba);
}

// Pictures are drawn once, by another process, while the scene is paused.
TEST_F(ViewFiles, HaveThumbnails) {
    const std::string script =
        R"({"steps": [{"perform": "Files"}, {"click": "##filter"}, {"type": "small"},
            {"thumbnails": true}, {"screenshot": "files.png"},
            {"expect": {"item": {"item": "small_suite", "enabled": false}}},
            {"click": "small"}, {"wait": 6}, {"expect": {"message": "opened .*small.json"}}]})";
    expectGood(script, "--width 1200 --height 700");
    ASSERT_EQ(thumbnails().size(), 1u);
    const fs::path file = thumbnails().front();
    const engine::Pixels picture = engine::readImage(file);
    EXPECT_EQ(picture.width, 256u);
    EXPECT_EQ(picture.height, 144u);
    // The picture is that of the scene, with fewer and wider strands.
    EXPECT_EQ(
        run("render small.json --frame 30 --set /render/width=256 --set /render/height=144 "
            "--set /lod/mode=forced --set /lod/level=2 -o expected.png")
            .status,
        0);
    EXPECT_EQ(engine::readImage(folder_.file("expected.png")).rgba, picture.rgba);

    const auto written = fs::last_write_time(file);
    expectGood(script, "--width 1200 --height 700");
    EXPECT_EQ(thumbnails(), std::vector{file});
    EXPECT_EQ(fs::last_write_time(file), written);
    // A changed scene gets another one.
    fs::rename(folder_.file("small.json"), folder_.file("tiny.json"));
    folder_.write("small.json", R"({"base": "tiny.json", "camera": {"field_of_view": 40}})");
    expectGood(script, "--width 1200 --height 700");
    EXPECT_EQ(thumbnails().size(), 2u);
}

}  // namespace
