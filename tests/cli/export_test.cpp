// Tests `hairbench export`, `reference` and `diff` as a user runs them.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/reference_python.h"
#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using Point = std::array<double, 3>;

Point readPoint(std::istream& file) {
    Point point{};
    file >> point[0] >> point[1] >> point[2];
    EXPECT_FALSE(file.fail());
    for (double& coordinate : point) coordinate /= 100;  // the files are in cm
    return point;
}

// The spline is natural, so its second control point is the root.
Point firstRoot(const fs::path& folder) {
    std::ifstream file(folder / "hair.txt");
    std::string line;
    std::getline(file, line);
    return readPoint(file);
}

Point firstVertex(const fs::path& folder) {
    std::ifstream file(folder / "head_0.ply");
    std::string line;
    while (std::getline(file, line) && line != "end_header") {
    }
    return readPoint(file);
}

double distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

class ExportCli : public testing::Test {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
    }

    std::string quoted(std::string_view name) const {
        return "'" + folder_.file(name).string() + "' ";
    }

    TemporaryFolder folder_;
};

// There are 136 root triangles with 16 strands each, and 7 segments with 2 pieces each.
TEST_F(ExportCli, WritesAMitsubaScene) {
    const Outcome outcome =
        hairbench("export " + shippedScene("smoke.json") + "--mitsuba " + quoted("m"));
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("frame 0 of smoke, 2176 strands, 32640 points, "));
    const std::string hair = textOf(folder_.file("m/hair.txt"));
    // Each strand has two control points more than points, and an empty line.
    EXPECT_EQ(std::ranges::count(hair, '\n'), 32640 + 2176 * 3);
    const std::string text = textOf(folder_.file("m/scene.xml"));
    for (const char* part : {R"(value="hair.txt")", R"(value="head_0.ply")", R"(value="320")"})
        EXPECT_THAT(text, HasSubstr(part));
}

// Roots move rigidly with the head, so a root keeps its distance to a vertex of the head.
TEST_F(ExportCli, MovesTheHeadWithTheHair) {
    for (const char* frame : {"0", "20"}) {
        const Outcome outcome = hairbench(
            "export " + shippedScene("nod.json") + "-a /strands/density=1 --frame " + frame +
            " --mitsuba " + quoted(frame));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
    }
    const fs::path before = folder_.file("0");
    const fs::path after = folder_.file("20");
    EXPECT_GT(distance(firstVertex(before), firstVertex(after)), 1e-3);  // m: it nods
    // Positions are floats below 1 m, after a few operations in single precision.
    EXPECT_NEAR(
        distance(firstRoot(before), firstVertex(before)),
        distance(firstRoot(after), firstVertex(after)), 1e-6);
}

TEST_F(ExportCli, NamesTheSetUpThatReferencesNeed) {
    const Outcome outcome = hairbench(
        "reference " + shippedScene("smoke.json") + "-o " + quoted("a.png"),
        "HAIRBENCH_REFERENCE_PYTHON=/no/such/python ");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("run scripts/setup --reference"));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
}

TEST_F(ExportCli, RefusesAPictureOfAnotherKind) {
    const Outcome outcome =
        hairbench("reference " + shippedScene("smoke.json") + "-o " + quoted("a.jpg"));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("a.jpg: is neither .png nor .exr"));
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(ExportCli, RendersAndComparesReferences) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    const std::string small =
        "reference " + shippedScene("smoke.json") + "-a /render/height=36 --samples 2 ";
    for (const char* options : {"-a /render/width=64 -o ", "-a /render/width=48 -o "}) {
        const bool wide = std::string(options).find("64") != std::string::npos;
        const Outcome outcome =
            hairbench(small + options + quoted(wide ? "wide.exr" : "narrow.png"));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(outcome.output, testing::Not(HasSubstr("[2/2]")));  // progress is for terminals
        EXPECT_THAT(outcome.output, HasSubstr("x 36 px, 2 samples per pixel"));
    }
    const Outcome same = hairbench(
        "diff --json " + quoted("wide.exr") + quoted("wide.exr") + "-o " + quoted("map.png"));
    ASSERT_EQ(same.status, 0) << same.output;
    // A picture has no error against itself, and its PSNR is infinite.
    const nlohmann::json expected{{"width", 64},        {"height", 36}, {"rmse", 0.0},
                                  {"psnr_db", nullptr}, {"ssim", 1.0},  {"flip", 0.0}};
    EXPECT_EQ(nlohmann::json::parse(same.output), expected);
    EXPECT_TRUE(fs::exists(folder_.file("map.png")));

    const Outcome other = hairbench("diff " + quoted("wide.exr") + quoted("narrow.png"));
    EXPECT_EQ(other.status, 2);
    EXPECT_THAT(other.output, HasSubstr("wide.exr is 64 x 36 px, "));
    EXPECT_THAT(other.output, HasSubstr("narrow.png is 48 x 36 px"));
    EXPECT_EQ(std::ranges::count(other.output, '\n'), 1) << other.output;
}

// The interrupt comes in the middle of a pass, which takes minutes. Without job control the shell's
// children would ignore it.
TEST_F(ExportCli, LeavesNothingWhenItIsInterrupted) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    const std::string log = quoted("log");
    const fs::path script = folder_.write(
        "interrupt.sh", "set -m\nmkdir " + quoted("scratch") + "\nTMPDIR=" + quoted("scratch") +
                            "'" HAIRBENCH_PROGRAM "' reference " + shippedScene("smoke.json") +
                            "--samples 1000000 -o " + quoted("out/a.exr") + " >" + log +
                            " 2>&1 &\nfor i in $(seq 600); do grep -qF '0 of 1000000' " + log +
                            " && break; sleep 0.1; done\nkill -INT $!\nwait $!\n");
    EXPECT_EQ(runInShell("bash '" + script.string() + "'").status, 130);
    EXPECT_THAT(textOf(folder_.file("log")), HasSubstr("interrupted: nothing is written\n"));
    EXPECT_TRUE(fs::is_empty(folder_.file("out")));
    EXPECT_TRUE(fs::is_empty(folder_.file("scratch")));
}

// The pictures are binary PPM of one colour, so their errors can be computed by hand.
TEST_F(ExportCli, ComparesFlatPicturesAsOneComputesByHand) {
    if (!hasReferencePython()) GTEST_SKIP() << kNoReference;
    const auto flat = [&](const char* name, int value) {
        std::string text = "P6\n16 16\n255\n";
        text.append(16 * 16 * 3, static_cast<char>(value));
        folder_.write(name, text);
    };
    flat("a.ppm", 100);
    flat("b.ppm", 151);  // 51 / 255 = 0.2 more
    const Outcome outcome = hairbench("diff --json " + quoted("a.ppm") + quoted("b.ppm"));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json figures = nlohmann::json::parse(outcome.output);
    // Pictures are in single precision.
    EXPECT_NEAR(figures.at("rmse"), 0.2, 1e-6);
    EXPECT_NEAR(figures.at("psnr_db"), -20.0 * std::log10(0.2), 1e-4);
    // For pictures without variance SSIM is (2 a b + C1) / (a^2 + b^2 + C1), with C1 = 0.01^2.
    const double a = 100.0 / 255.0;
    const double b = 151.0 / 255.0;
    EXPECT_NEAR(figures.at("ssim"), (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-5);
}

}  // namespace
