// Tests `hairbench groom filter`, `smooth`, `resample` and `fix` as a user runs them.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/groom_files.h"
#include "tests/python.h"
#include "tests/required.h"

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

// ---- Strands that can't be used -----------------------------------------------------------------

// USC-HairSalon's strands: their number, then for each that of its points and the points.
std::string dataText(const HairFile& file) {
    std::string text;
    const auto append = [&](auto value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    append(static_cast<std::int32_t>(file.segments.size()));
    const float* point = file.points.data();
    for (const std::uint16_t segments : file.segments) {
        append(std::int32_t{segments} + 1);
        for (int k = 0; k < 3 * (segments + 1); ++k) append(*point++);
    }
    return text;
}

std::string usdText(const HairFile& file) {
    std::ostringstream text;
    text << "#usda 1.0\ndef BasisCurves \"hair\" {\nuniform token type = \"linear\"\n"
            "int[] curveVertexCounts = [";
    for (std::size_t i = 0; i < file.segments.size(); ++i)
        text << (i == 0 ? "" : ", ") << file.segments[i] + 1;
    text << "]\npoint3f[] points = [";
    for (std::size_t i = 0; i < file.points.size(); i += 3)
        text << (i == 0 ? "(" : ", (") << file.points[i] << ", " << file.points[i + 1] << ", "
             << file.points[i + 2] << ')';
    text << "]\n}\n";
    return text.str();
}

struct WrittenFormat {
    const char* extension;
    std::string (*text)(const HairFile& file);
};

class BadStrandsCli : public GroomEditCli, public testing::WithParamInterface<WrittenFormat> {
protected:
    void SetUp() override {
        if (std::string_view(GetParam().extension) == ".usda" && pythonInterpreter().empty())
            return skipWithout(Need::python, kNoPython);
    }
};

INSTANTIATE_TEST_SUITE_P(
    Formats, BadStrandsCli,
    testing::Values(
        WrittenFormat{".hair", [](const HairFile& file) { return file.text(); }},
        WrittenFormat{".data", dataText}, WrittenFormat{".usda", usdText}),
    [](const auto& format) { return std::string(format.param.extension).substr(1); });

// Six strands: the fifth is a single point, and the sixth has a point that is not a number.
TEST_P(BadStrandsCli, AreNamedRefusedAndMended) {
    HairFile file = fourStrands();
    file.segments.push_back(0);
    file.points.insert(file.points.end(), {2, 0, 2});
    file.segments.push_back(2);
    file.points.insert(
        file.points.end(), {7, 0, 7, 7, std::numeric_limits<float>::quiet_NaN(), 7, 7, 9, 7});
    const std::string name = std::string("bad") + GetParam().extension;
    folder_.write(name, GetParam().text(file));
    const std::string single = "1 strand of a single point (strand 4, counted from 0)";
    const std::string nan =
        "1 strand with a position that is not finite (strand 5, counted from 0)";
    const std::string bad = quoted(name);

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
        R"({"groom": {"file": ")" + name + R"(", "placement": {"scale": 0.01}, "vertices": 3}})");
    const Outcome valid = hairbench("validate --start " + quoted("bad.json"));
    if (valid.status != 77) {  // there is a device
        EXPECT_EQ(valid.status, 0) << valid.output;
        EXPECT_THAT(valid.output, AllOf(HasSubstr(single), HasSubstr(nan)));
        const Outcome strict = hairbench("validate --start --strict " + quoted("bad.json"));
        EXPECT_EQ(strict.status, 2);
        EXPECT_THAT(strict.output, AllOf(HasSubstr(single), HasSubstr("refused by --strict")));
    }

    const Outcome fixed = edit("fix", name, "--scale 0.01");
    EXPECT_EQ(fixed.status, 0);
    EXPECT_THAT(
        fixed.output, AllOf(
                          HasSubstr("left out: points with a number that is not finite: 1\n"),
                          HasSubstr("left out: strands of a single point: 1\n"),
                          ContainsRegex("wrote: .*out.hair, 5 strands, ")));
}

// ---- Groups -------------------------------------------------------------------------------------

TEST_F(GroomEditCli, ChoosesGroups) {
    folder_.write("four.hair", fourStrands().text());
    const Outcome none = edit("filter", "four.hair", "--group 1");
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.output, HasSubstr("the file has no groups to choose from"));
    EXPECT_THAT(
        hairbench("groom info " + quoted("four.hair") + " --group 1").output,
        HasSubstr("--group: the file has no groups to choose from"));
    // Two strands, in the groups 3 and -4; the first is a guide.
    folder_.write(
        "two.npz", textOf(HAIRBENCH_SOURCE_DIR "/tests/corpus/npz/groups_and_guides.npz"));
    for (const std::string extension : {".npz", ".abc", ".usda"}) {
        if (extension == ".usda" && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(extension);
        const std::string file = "two" + extension;
        const std::string out = "out" + extension;
        if (extension != ".npz") {
            ASSERT_EQ(convert("two.npz", file).status, 0);
        }
        for (const std::string option : {"--group 3", "--group=-4"}) {
            const nlohmann::json found = json(file, option);
            EXPECT_EQ(found["strands"], 1);
            EXPECT_EQ(found["has"]["groups"], 1);
            EXPECT_EQ(found["has"]["guides"], option == "--group 3" ? 1 : 0);
        }
        EXPECT_EQ(
            hairbench("groom filter " + quoted(file) + " " + quoted(out) + " --group 3 --group=-4")
                .status,
            0);
        EXPECT_EQ(json(out)["strands"], 2);
        EXPECT_THAT(
            info(file, "--group 5").output,
            HasSubstr("--group: no strand belongs to group 5; the file has -4, 3"));
        const Outcome groups = hairbench("groom groups " + quoted(file));
        EXPECT_THAT(
            groups.output, AllOf(ContainsRegex("\n +-4 +1 +0 +"), ContainsRegex("\n +3 +1 +1 +")));
        const Outcome scene = hairbench(
            "groom scene " + quoted(file) + " --group=-4 --scale 1 --force -o " +
            quoted("out.json"));
        EXPECT_EQ(scene.status, 0) << scene.output;
        EXPECT_THAT(scene.output, HasSubstr("1 strand, "));
        EXPECT_EQ(nlohmann::json::parse(textOf(folder_.file("out.json")))["groom"]["groups"], "-4");
        EXPECT_EQ(hairbench("validate " + quoted("out.json")).status, 0);
    }
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
