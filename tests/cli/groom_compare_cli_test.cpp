// Tests `hairbench groom compare` as a user runs it, and against brute force in numpy.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/groom_files.h"
#include "tests/python.h"
#include "tests/required.h"

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

class GroomCompareCli : public GroomCli {
protected:
    Outcome compare(const std::string& a, const std::string& b, const std::string& options = "") {
        return hairbench("groom compare " + quoted(a) + " " + quoted(b) + " " + options);
    }
    nlohmann::json
    compareJson(const std::string& a, const std::string& b, const std::string& options) {
        return nlohmann::json::parse(compare(a, b, options + " --json 2>/dev/null").output);
    }
};

// Returns curls of 5 to 40 points and 20 to 150 mm on a patch of 15 mm, in metres.
HairFile curls(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967295.0;
    };
    HairFile file;
    for (int i = 0; i < count; ++i) {
        const double x = uniform(0.0, 0.015);
        const double z = uniform(0.0, 0.015);
        const double length = uniform(0.02, 0.15);
        const double radius = uniform(0.0, 0.004);
        const double turns = uniform(10.0, 90.0);
        const auto points = static_cast<int>(uniform(5.0, 40.0));
        file.segments.push_back(static_cast<std::uint16_t>(points - 1));
        for (int k = 0; k < points; ++k) {
            const double y = length * k / (points - 1);
            for (const double coordinate :
                 {x + radius * std::cos(turns * y), y, z + radius * std::sin(turns * y)})
                file.points.push_back(static_cast<float>(coordinate));
        }
    }
    return file;
}

// Writes a strand a line, with enough digits to keep all bits.
std::string lines(const HairFile& file) {
    std::ostringstream text;
    text << std::setprecision(9);
    std::size_t next = 0;
    for (const std::uint16_t segments : file.segments) {
        for (int i = 0; i < 3 * (segments + 1); ++i) text << file.points[next++] << ' ';
        text << '\n';
    }
    return text.str();
}

// The program computes distances and lengths in floats, with a relative error of 1 / 1.7e7. Shares
// are counts of samples, and no sample here is that near to a threshold.
void expectNear(const nlohmann::json& found, double wanted, const std::string& what) {
    EXPECT_NEAR(found.get<double>(), wanted, 1e-6 * std::max(std::abs(wanted), 1e-3)) << what;
}

TEST_F(GroomCompareCli, AgreesWithBruteForce) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const HairFile a = curls(1, 40);
    const HairFile b = curls(2, 30);
    folder_.write("a.hair", a.text());
    folder_.write("b.hair", b.text());
    folder_.write("a.txt", lines(a));
    folder_.write("b.txt", lines(b));
    for (const std::string direction : {"directed", "undirected"}) {
        const Outcome outcome = runPython(
            "tests/cli/compare_grooms.py",
            quoted("a.txt") + ' ' + quoted("b.txt") + " 0.0015 0.004 7 " + direction);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        const nlohmann::json wanted = nlohmann::json::parse(outcome.output);
        const nlohmann::json found = compareJson(
            "a.hair", "b.hair",
            "--scale-a 1 --scale-b 1 --spacing 1.5 --curvature-step 4 --consistency-samples 7 "
            "--threads 2" +
                std::string(direction == "undirected" ? " --undirected" : ""));
        // Only scores between 0 and 1 distinguish the definitions.
        EXPECT_GT(wanted["f1"][2], 0.2);
        EXPECT_LT(wanted["f1"][0], 0.8);
        EXPECT_LT(wanted["strand_consistency"][0], 0.9 * wanted["recall"][0].get<double>());
        ASSERT_EQ(found["scores"].size(), 3u);
        for (std::size_t i = 0; i < 3; ++i)
            for (const char* name : {"precision", "recall", "f1", "strand_consistency"})
                expectNear(found["scores"][i][name], wanted[name][i], name);
        const nlohmann::json& distances = found["distances"];
        for (const char* way : {"first_to_second", "second_to_first"})
            for (const auto& [name, value] : wanted[way].items())
                expectNear(distances[way][name], value, way + (' ' + name));
        for (const char* name : {"chamfer", "chamfer_squared", "hausdorff"})
            expectNear(distances[name]["value"], wanted[name], name);
        expectNear(found["lengths"]["earth_movers_distance"], wanted["lengths"], "lengths");
        expectNear(
            found["curvatures"]["earth_movers_distance"], wanted["curvatures"], "curvatures");
        expectNear(
            found["curvatures"]["first"]["mean"], wanted["mean_curvature"], "mean curvature");
    }
}

TEST_F(GroomCompareCli, FindsAGroomEqualInEveryFormat) {
    folder_.write("four.hair", fourStrands().text());
    folder_.write("lawn.hair", lawn(20).text());
    const auto expectEqual = [&](const std::string& file, const std::string& other) {
        ASSERT_EQ(convert(file, other, "--scale 0.01").status, 0);
        const nlohmann::json found = compareJson(file, other, "--scale-a 0.01 --scale-b 1");
        EXPECT_TRUE(found["equal"]) << other;
        for (const nlohmann::json& scores : found["scores"]) {
            EXPECT_EQ(scores["f1"], 1.0) << other;
            EXPECT_EQ(scores["strand_consistency"], 1.0) << other;
        }
        EXPECT_LT(found["distances"]["hausdorff"]["value"], 1e-12) << other;
        EXPECT_EQ(found["lengths"]["earth_movers_distance"], 0.0) << other;
        EXPECT_EQ(found["curvatures"]["earth_movers_distance"], 0.0) << other;
    };
    for (const std::string extension : {".hair", ".ply", ".obj", ".gltf", ".glb"})
        expectEqual("four.hair", "other" + extension);
    for (const std::string extension : {".hgl", ".tfx"})
        expectEqual("lawn.hair", "lawn" + extension);
    if (!pythonInterpreter().empty()) expectEqual("four.hair", "other.usda");
}

TEST_F(GroomCompareCli, PrintsATableAndWritesJson) {
    folder_.write("four.hair", fourStrands().text());
    const Outcome outcome = compare(
        "four.hair", "four.hair", "--scale-a 0.01 --scale-b 0.01 -o " + quoted("found.json"));
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output, AllOf(
                            HasSubstr("4 strands, 700 mm in all, in cm"),
                            HasSubstr("The same strands, point for point."),
                            ContainsRegex("2 mm, 20° +100 % +100 % +100 % +100 %\n"),
                            HasSubstr("Hausdorff distance 0")));
    const nlohmann::json found = nlohmann::json::parse(textOf(folder_.file("found.json")));
    EXPECT_EQ(found["schema"], "hairbench-groom-comparison/1.0.0");
    EXPECT_NEAR(found["first"]["length"]["value"], 0.7, 1e-7);
    EXPECT_EQ(found["first"]["samples"], 350);
    EXPECT_EQ(found["scores"][0]["distance"]["value"], 2e-3);
    EXPECT_FALSE(found.contains("penetration"));
}

// Four strands of 0.1 to 0.3 m start at y = 0 in a box that reaches to y = 0.1 m. The lower 0.1 m
// of each is inside, 0.4 of 0.7 m in all. Parts less than 1 mm deep do not count.
TEST_F(GroomCompareCli, SaysWhatIsInsideAHead) {
    folder_.write("four.hair", fourStrands().text());
    folder_.write(
        "box.obj", "v -1 -1 -1\nv 1 -1 -1\nv 1 0.1 -1\nv -1 0.1 -1\nv -1 -1 1\nv 1 -1 1\n"
                   "v 1 0.1 1\nv -1 0.1 1\nf 1 4 3\nf 1 3 2\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\n"
                   "f 4 8 7\nf 4 7 3\nf 1 5 8\nf 1 8 4\nf 2 3 7\nf 2 7 6\n");
    const nlohmann::json found = compareJson(
        "four.hair", "four.hair",
        "--scale-a 0.01 --scale-b 0.01 --spacing 4 --mesh " + quoted("box.obj"));
    // Samples at heights of 2, 6 ... 98 mm are 98 to 2 mm deep.
    EXPECT_EQ(found["penetration"]["first"]["samples_inside"], 100);
    EXPECT_EQ(found["penetration"]["first"]["strands_inside"], 4);
    EXPECT_NEAR(found["penetration"]["first"]["share"], 100.0 / 175.0, 1e-12);
    EXPECT_NEAR(found["penetration"]["first"]["mean_depth"]["value"], 0.05, 1e-6);
    EXPECT_NEAR(found["penetration"]["second"]["deepest"]["value"], 0.098, 1e-6);
    EXPECT_THAT(
        compare(
            "four.hair", "four.hair",
            "--scale-a 0.01 --scale-b 0.01 --spacing 4 --mesh " + quoted("box.obj"))
            .output,
        HasSubstr("A inside the mesh: 57.1 % of its length, 4 strands, 50.0 mm deep on average"));
}

TEST_F(GroomCompareCli, RefusesInOneLineWithStatus2) {
    folder_.write("four.hair", fourStrands().text());
    HairFile point{.segments = {1}, .points = {1, 1, 1, 1, 1, 1}};
    folder_.write("point.hair", point.text());
    point.points[4] = std::nanf("");
    folder_.write("nan.hair", point.text());
    const auto expectRefused = [](const Outcome& outcome, const std::string& reason) {
        EXPECT_EQ(outcome.status, 2);
        EXPECT_THAT(outcome.output, HasSubstr(reason));
    };
    const std::string scales = "--scale-a 0.01 --scale-b 0.01 ";
    expectRefused(compare("four.hair", "point.hair", scales), "the second groom: has no strand");
    expectRefused(compare("four.hair", "nan.hair", scales), "nan.hair: ");
    expectRefused(compare("four.hair", "none.hair", scales), "none.hair: ");
    for (const std::string wrong : {"2", "2/", "/20", "2/20x", "a/b"})
        expectRefused(
            compare("four.hair", "four.hair", scales + "--threshold " + wrong),
            "is not MM/DEGREES");
    expectRefused(
        compare("four.hair", "four.hair", scales + "--threshold 2/200"), "in [0, 180] degrees");
}

}  // namespace
