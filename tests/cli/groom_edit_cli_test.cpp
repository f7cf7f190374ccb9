// Tests `hairbench groom filter`, `smooth`, `resample` and `fix` as a user runs them.
#include <filesystem>
#include <limits>
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

// Six strands: the fifth is a single point, and the sixth has a point that is not a number.
TEST_F(GroomEditCli, NamesRefusesAndMendsStrandsThatCantBeUsed) {
    HairFile file = fourStrands();
    file.segments.push_back(0);
    file.points.insert(file.points.end(), {2, 0, 2});
    file.segments.push_back(2);
    file.points.insert(
        file.points.end(), {7, 0, 7, 7, std::numeric_limits<float>::quiet_NaN(), 7, 7, 9, 7});
    folder_.write("bad.hair", file.text());
    const std::string single = "1 strand of a single point (strand 4, counted from 0)";
    const std::string nan =
        "1 strand with a position that is not finite (strand 5, counted from 0)";
    const std::string bad = quoted("bad.hair");

    const Outcome info = hairbench("groom info " + bad);
    EXPECT_EQ(info.status, 0);
    EXPECT_THAT(
        info.output, AllOf(HasSubstr(single + " is left out"), HasSubstr(nan + " is left out")));
    for (const std::string& command :
         {"info " + bad, "convert " + bad + " " + quoted("out.ply"),
          "scene " + bad + " -o " + quoted("out.json")}) {
        const Outcome strict = hairbench("groom " + command + " --strict");
        EXPECT_EQ(strict.status, 2) << command;
        EXPECT_THAT(strict.output, AllOf(HasSubstr(single + "; " + nan), HasSubstr("--strict")));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.file("out.ply")));
    EXPECT_FALSE(std::filesystem::exists(folder_.file("out.json")));

    folder_.write(
        "bad.json",
        R"({"groom": {"file": "bad.hair", "placement": {"scale": 0.01}, "vertices": 3}})");
    const Outcome valid = hairbench("validate --start " + quoted("bad.json"));
    if (valid.status != 77) {  // there is a device
        EXPECT_EQ(valid.status, 0) << valid.output;
        EXPECT_THAT(valid.output, AllOf(HasSubstr(single), HasSubstr(nan)));
        const Outcome strict = hairbench("validate --start --strict " + quoted("bad.json"));
        EXPECT_EQ(strict.status, 2);
        EXPECT_THAT(strict.output, AllOf(HasSubstr(single), HasSubstr("refused by --strict")));
    }

    const Outcome fixed = edit("fix", "bad.hair", "--scale 0.01");
    EXPECT_EQ(fixed.status, 0);
    EXPECT_THAT(
        fixed.output, AllOf(
                          HasSubstr("left out: points with a number that is not finite: 1\n"),
                          HasSubstr("left out: strands of a single point: 1\n"),
                          ContainsRegex("wrote: .*out.hair, 5 strands, ")));
}

TEST_F(GroomEditCli, ChoosesGroups) {
    folder_.write("four.hair", fourStrands().text());
    const Outcome none = edit("filter", "four.hair", "--group 1");
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.output, HasSubstr("the file has no groups to choose from"));
    EXPECT_THAT(
        hairbench("groom info " + quoted("four.hair") + " --group 1").output,
        HasSubstr("--group: the file has no groups to choose from"));
    // Two strands, in the groups 3 and -4; the first is a guide.
    const std::string file = "'" HAIRBENCH_SOURCE_DIR "/tests/corpus/npz/groups_and_guides.npz'";
    for (const std::string option : {"--group 3", "--group=-4"}) {
        const Outcome outcome = hairbench("groom info --json " + file + " " + option);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        const nlohmann::json found = nlohmann::json::parse(outcome.output);
        EXPECT_EQ(found["strands"], 1);
        EXPECT_EQ(found["has"]["groups"], 1);
        EXPECT_EQ(found["has"]["guides"], option == "--group 3" ? 1 : 0);
    }
    EXPECT_EQ(
        hairbench("groom filter " + file + " " + quoted("out.npz") + " --group 3 --group=-4")
            .status,
        0);
    EXPECT_EQ(json("out.npz")["strands"], 2);
    EXPECT_THAT(
        hairbench("groom info " + file + " --group 5").output,
        HasSubstr("--group: no strand belongs to group 5; the file has -4, 3"));
}

TEST_F(GroomEditCli, ReversesTransformsAndListsGroups) {
    folder_.write("four.hair", fourStrands().text());
    EXPECT_EQ(edit("reverse", "four.hair", "").status, 0);
    EXPECT_EQ(edit("reverse", "out.hair", "").status, 0);
    EXPECT_EQ(dataOf("out.hair"), dataOf("four.hair"));

    const Outcome moved = edit(
        "transform", "four.hair", "--from-unit cm --unit m --from-up y --up z --translate 0 0 1");
    EXPECT_EQ(moved.status, 0);
    EXPECT_THAT(
        moved.output, AllOf(
                          HasSubstr("converted from cm to m: strands: 4\n"),
                          HasSubstr("turned from +y to +z up: strands: 4\n"),
                          HasSubstr("translated: strands: 4\n")));
    const auto found = json("out.hair", "--scale 1");
    EXPECT_NEAR(found["lengths"]["maximum"].get<double>(), 0.3, 1e-6);

    const Outcome unknown = edit("transform", "four.hair", "--unit m");
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.output, HasSubstr("four.hair: states no unit: give --from-unit"));

    const Outcome groups = hairbench("groom groups " + quoted("four.hair"));
    EXPECT_EQ(groups.status, 0);
    EXPECT_THAT(groups.output, ContainsRegex("none +4 +0 +13"));
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
