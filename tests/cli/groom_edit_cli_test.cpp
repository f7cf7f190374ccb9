// Tests `hairbench groom filter`, `smooth`, `resample` and `fix` as a user runs them.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/groom_files.h"

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

class GroomEditCli : public GroomCli {
protected:
    Outcome edit(const std::string& command, const std::string& in, const std::string& options) {
        return hairbench(
            "groom " + command + " " + quoted(in) + " " + quoted("out.hair") + " " + options);
    }
};

TEST_F(GroomEditCli, FiltersAndSaysHowManyItLeftOut) {
    folder_.write("four.hair", fourStrands().text());  // 10, 10, 20 and 30 cm
    const Outcome outcome =
        edit("filter", "four.hair", "--scale 0.01 --shortest 150 --longest 250");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output, AllOf(
                            ContainsRegex("read: .*four.hair, 4 strands, 13 points\n"),
                            HasSubstr("left out: shorter than 150 mm: 2\n"),
                            HasSubstr("left out: longer than 250 mm: 1\n"),
                            ContainsRegex("wrote: .*out.hair, 1 strand, 3 points\n")));
    EXPECT_EQ(json("out.hair", "--scale 0.01")["lengths"]["mean"], 0.2);
}

TEST_F(GroomEditCli, ResamplesByNumberAndBySpacing) {
    folder_.write("four.hair", fourStrands().text());
    EXPECT_EQ(edit("resample", "four.hair", "--vertices 9").status, 0);
    EXPECT_EQ(json("out.hair")["points"], 36);
    EXPECT_EQ(edit("resample", "four.hair", "--scale 0.01 --spacing 50").status, 0);
    EXPECT_EQ(json("out.hair")["points"], 3 + 3 + 5 + 7);
}

TEST_F(GroomEditCli, TakesPointsPerStrandOfAPlyOfPoints) {
    folder_.write(
        "points.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n");
    EXPECT_NE(edit("resample", "points.ply", "--vertices 5").status, 0);
    EXPECT_EQ(edit("resample", "points.ply", "--vertices 5 --points-per-strand 2").status, 0);
    EXPECT_EQ(json("out.hair")["points"], 2 * 5);

    const Outcome compared = hairbench(
        "groom compare " + quoted("points.ply") + " " + quoted("points.ply") +
        " --scale-a 0.1 --scale-b 0.1 --points-per-strand-a 2 --points-per-strand-b 4");
    EXPECT_EQ(compared.status, 0);
    EXPECT_THAT(
        compared.output,
        AllOf(ContainsRegex("A .*, 2 strands, "), ContainsRegex("B .*, 1 strand, ")));
}

TEST_F(GroomEditCli, SmoothsBendsAndKeepsLengths) {
    HairFile bend{.segments = {4}, .points = {0, 0, 0, 5, 0, 0, 10, 0, 0, 10, 5, 0, 10, 10, 0}};
    folder_.write("bend.hair", bend.text());
    EXPECT_EQ(edit("smooth", "bend.hair", "--scale 0.01 --length 50").status, 0);
    const nlohmann::json found = json("out.hair", "--scale 0.01");
    EXPECT_NEAR(found["lengths"]["mean"], 0.2, 1e-7);
    EXPECT_GT(found["bounding_box"]["maximum"][0], 0.1);  // the corner is cut; the tip stays
    EXPECT_LT(found["bounding_box"]["maximum"][1], 0.13);
}

TEST_F(GroomEditCli, FixLeavesNothingThatInfoFindsInStrands) {
    HairFile file = fourStrands();
    file.segments.push_back(2);  // a copy of the first strand
    file.points.insert(file.points.end(), {0, 0, 0, 0, 5, 0, 0, 10, 0});
    file.segments.push_back(1);  // a strand without length
    file.points.insert(file.points.end(), {2, 0, 2, 2, 0, 2});
    file.segments.push_back(2);  // a segment without length
    file.points.insert(file.points.end(), {7, 0, 7, 7, 9, 7, 7, 9, 7});
    folder_.write("odd.hair", file.text());
    const Outcome outcome = edit("fix", "odd.hair", "--scale 0.01");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output,
        AllOf(
            HasSubstr("left out: strands without length: 1\n"),
            HasSubstr("left out: strands equal to one before them: 1\n"),
            HasSubstr("left out: points at the same place as the previous one: 1\n"),
            ContainsRegex("wrote: .*out.hair, 5 strands, 15 points\n")));
    EXPECT_TRUE(json("out.hair", "--scale 1")["odd"].empty());  // "out.hair" is in metres
}

TEST_F(GroomEditCli, RefusesInOneLineWithStatus2) {
    folder_.write("four.hair", fourStrands().text());
    const auto expectRefused = [&](const std::string& command, const std::string& options,
                                   const std::string& reason) {
        const Outcome outcome = edit(command, "four.hair", options);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_THAT(outcome.output, HasSubstr(reason));
        EXPECT_FALSE(std::filesystem::exists(folder_.file("out.hair")));
    };
    expectRefused("filter", "--scale 0.01 --deepest 1", "--mesh: ");
    expectRefused("filter", "--scale 0.01 --shortest 5000", "no strand is left");
    expectRefused("resample", "--scale 0.01", "give exactly one of them");
    expectRefused("resample", "--scale 0.01 --vertices 4 --spacing 2", "give exactly one of them");
    expectRefused("fix", "--scale 0.01 --farthest-root 2", "--mesh: ");
    expectRefused("smooth", "--scale 0.01 --length 0", "--length");
}

}  // namespace
