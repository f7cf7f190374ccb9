// Tests `hairbench groom info` as a user runs it.
#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/groom_files.h"

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

TEST_F(GroomCli, InfoSaysWhatIsInAFile) {
    folder_.write("four.hair", fourStrands().text());
    const Outcome outcome = info("four.hair", "--scale 0.01");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, ContainsRegex("comment +made for a test\n"));
    EXPECT_THAT(outcome.output, ContainsRegex("strands +4\n"));
    EXPECT_THAT(outcome.output, ContainsRegex("points +13, 3 to 4 per strand, median 3\n"));
    EXPECT_THAT(outcome.output, HasSubstr("40.0 x 300 x 40.0 mm"));
    EXPECT_THAT(outcome.output, ContainsRegex("widths +70.0 µm everywhere\n"));
    EXPECT_THAT(outcome.output, ContainsRegex("colour +0.5 0.25 0.125 everywhere\n"));
    // Lengths are 10, 10, 20 and 30 cm. Quartiles interpolate linearly, as numpy's do.
    EXPECT_THAT(outcome.output, ContainsRegex("length +100 +100 +150 +225 +300 +175 +mm\n"));
    EXPECT_THAT(outcome.output, HasSubstr("nothing odd\n"));
}

TEST_F(GroomCli, InfoGivesTheSameAsJson) {
    folder_.write("four.hair", fourStrands().text());
    const nlohmann::json found = json("four.hair", "--scale 0.01");
    EXPECT_EQ(found["schema"], "hairbench-groom/1.0.0");
    EXPECT_EQ(found["comment"], "made for a test");
    EXPECT_EQ(found["strands"], 4);
    EXPECT_EQ(found["points"], 13);
    EXPECT_EQ(found["points_per_strand"]["maximum"], 4);
    EXPECT_EQ(found["unit"]["metres"], 0.01);
    EXPECT_EQ(found["lengths"]["unit"], "m");
    EXPECT_NEAR(found["lengths"]["mean"], 0.175, 1e-9);
    EXPECT_NEAR(found["bounding_box"]["maximum"][1], 0.3, 1e-9);
    EXPECT_NEAR(found["widths"]["median"], 70e-6, 1e-11);  // 0.007f
    EXPECT_EQ(found["has"]["widths"], "everywhere");
    EXPECT_TRUE(found["odd"].empty());
}

TEST_F(GroomCli, InfoListsWhatIsOddAndWhatToDo) {
    HairFile file = fourStrands();
    file.segments.push_back(2);  // a copy of the first strand
    file.points.insert(file.points.end(), {0, 0, 0, 0, 5, 0, 0, 10, 0});
    file.segments.push_back(1);  // a strand without length
    file.points.insert(file.points.end(), {2, 0, 2, 2, 0, 2});
    file.thickness = 1.0f;  // the format's default; hair in cm is then as thick as rope
    folder_.write("odd.hair", file.text());
    const Outcome outcome = info("odd.hair", "--scale 0.01");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output,
        ContainsRegex(
            "\nodd:\n.*1 strand without length.*\n +leave.*\n.*1 strand equal to another.*"
            "\n +leave.*\n.*widths of 10.0 mm"));
    const nlohmann::json findings = json("odd.hair", "--scale 0.01");
    ASSERT_FALSE(findings["odd"].empty());
    for (const nlohmann::json& each : findings["odd"]) {
        EXPECT_GT(each["count"], 0);
        EXPECT_FALSE(each["advice"].get<std::string>().empty());
    }
}

TEST_F(GroomCli, InfoHoldsTheRootsAgainstAMesh) {
    folder_.write("four.hair", fourStrands().text());
    // Roots at (0, 0) and (4, 0) cm are on the floor. The others are beyond its edge at z = 2 cm.
    folder_.write(
        "floor.obj", "v 0 0 0\nv 0.04 0 0\nv 0 0 0.02\nv 0.04 0 0.02\nf 1 3 2\nf 2 3 4\n");
    const nlohmann::json found = json("four.hair", "--scale 0.01 --mesh " + quoted("floor.obj"));
    EXPECT_EQ(found["mesh"]["roots_off_surface"], 2);
    EXPECT_NEAR(found["mesh"]["root_distances"]["maximum"], 0.02, 1e-8);
    EXPECT_FALSE(found["mesh"]["closed"]);
    EXPECT_THAT(
        info("four.hair", "--scale 0.01 --mesh " + quoted("floor.obj")).output,
        AllOf(HasSubstr("2 roots further than"), HasSubstr("a mesh that is not closed")));
}

TEST_F(GroomCli, InfoOfAFileThatIsNotHairIsOneLineWithStatus2) {
    folder_.write("short.hair", fourStrands().text().substr(0, 140));
    folder_.write("text.hair", "not hair at all");
    for (const char* name : {"short.hair", "text.hair", "none.hair"}) {
        const Outcome outcome = info(name);
        EXPECT_EQ(outcome.status, 2) << name;
        EXPECT_THAT(outcome.output, HasSubstr(folder_.file(name).string() + ": "));
        EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    }
}

TEST_F(GroomCli, TakesPointsPerStrandOfAPlyOfPoints) {
    folder_.write(
        "points.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n");
    const Outcome without = info("points.ply");
    EXPECT_NE(without.status, 0);
    EXPECT_THAT(without.output, HasSubstr("--points-per-strand"));
    const Outcome outcome = info("points.ply", "--points-per-strand 2");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.output, ContainsRegex("points +4, 2 per strand\n"));
    EXPECT_THAT(outcome.output, ContainsRegex("groups +none\n *guides +not stated\n"));
    EXPECT_EQ(json("points.ply", "--points-per-strand 4")["strands"], 1);
}

}  // namespace
