#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/viewer/view_test.h"

namespace {

using ViewChange = ViewTest;

struct Change {
    const char* name;
    const char* set;
    const char* back;
};

constexpr Change kChanges[] = {
    {"density", R"({"/strands/density": 16})", R"({"/strands/density": 4})"},
    {"wind", R"({"/simulation/wind/strength": 20})", R"({"/simulation/wind/strength": 0})"},
    {"shading", R"({"/shading/model": "marschner"})", R"({"/shading/model": "phong"})"},
    {"backend", R"({"/strands/backend": "pulling_geometry", "/strands/density": 8})",
     R"({"/strands/backend": "tessellation", "/strands/density": 4})"},
};

// Steps that record every picture of the window and its hash: before, with and after the change.
std::string stepsOf(const Change& change) {
    const std::string name = change.name;
    return R"({"set": )" + std::string(change.set) + R"(}, {"picture": ")" + name +
           R"(_with.png"}, {"screenshot": ")" + name + R"(_window.png"}, {"state": ")" + name +
           R"(.json"}, {"expect": {"no_problem": true, "frame": 2, "other_hash_than": "0.json"}},
           {"set": )" +
           change.back + R"(}, {"picture": ")" + name +
           R"(_back.png"}, {"expect": {"no_problem": true, "frame": 2, "same_hash_as": "0.json"}},)";
}

TEST_F(ViewChange, IsSeenAtOnceAndLeavesNothingBehind) {
    std::string steps;
    for (const Change& change : kChanges) steps += stepsOf(change);
    expectGood(
        R"({"steps": [{"frames": 2}, {"screenshot": "window.png"}, {"picture": "0.png"},
            {"state": "0.json"}, )" +
            steps + R"({"wait": 1}]})",
        "--width 640 --height 360");
    const std::string before = textOf(folder_.file("0.png"));
    const std::string window = textOf(folder_.file("window.png"));
    ASSERT_FALSE(before.empty());
    for (const Change& change : kChanges) {
        const std::string name = change.name;
        EXPECT_NE(textOf(folder_.file(name + "_with.png")), before) << name;
        EXPECT_EQ(textOf(folder_.file(name + "_back.png")), before) << name;
        EXPECT_NE(textOf(folder_.file(name + "_window.png")), window) << name;
    }
}

// Reads a number in a PNG's header (Portable Network Graphics 3, 11.2.1), most significant byte
// first.
unsigned bigEndian(const std::string& bytes, std::size_t at) {
    unsigned number = 0;
    for (std::size_t i = at; i < at + 4; ++i)
        number = number * 256 + static_cast<unsigned char>(bytes.at(i));
    return number;
}

TEST_F(ViewChange, OfTheWindowsSizeLeavesThePictureAsItIs) {
    expectGood(
        R"({"steps": [{"frames": 1}, {"state": "0.json"},
            {"resize": [900, 500]}, {"screenshot": "large.png"},
            {"expect": {"same_hash_as": "0.json"}},
            {"resize": [700, 400]}, {"screenshot": "small.png"},
            {"expect": {"same_hash_as": "0.json"}}]})",
        "--width 800 --height 450");
    const std::string large = textOf(folder_.file("large.png"));
    const std::string small = textOf(folder_.file("small.png"));
    EXPECT_EQ(bigEndian(large, 16), 900u);
    EXPECT_EQ(bigEndian(large, 20), 500u);
    EXPECT_EQ(bigEndian(small, 16), 700u);
    EXPECT_EQ(bigEndian(small, 20), 400u);
}

TEST_F(ViewChange, OfTheSceneComesWithAFileThatIsDropped) {
    folder_.write("other.json", R"({"base": "small.json", "shading": {"color": [0.2, 0.4, 0.9]}})");
    expectGood(
        R"({"steps": [{"frames": 1}, {"state": "0.json"}, {"drop": "other.json"},
            {"expect": {"no_problem": true, "other_hash_than": "0.json",
                        "setting": {"/shading/color": [0.2, 0.4, 0.9]}}},
            {"seek": 0}, {"state": "other_state.json"}]})",
        "--width 640 --height 360");
    const Outcome rendered = run("render other.json --frame 0 -o other.png");
    EXPECT_THAT(
        rendered.output,
        testing::HasSubstr(
            "image " + state("other_state.json")["sides"][0].value("image_hash", "none")));
}

}  // namespace
