// Tests `hairbench groom convert` as a user runs it.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/groom_files.h"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Every format keeps all bits of the points. It keeps the strands' point counts if they may differ.
TEST_F(GroomCli, ConvertsThereAndBack) {
    folder_.write("four.hair", fourStrands().text());
    for (const std::string extension : {".ply", ".obj", ".gltf", ".glb", ".usda", ".abc"}) {
        const Outcome there = convert("four.hair", "other" + extension);
        EXPECT_EQ(there.status, 0) << there.output;
        const Outcome back = convert("other" + extension, "back.hair");
        EXPECT_EQ(back.status, 0) << back.output;
        EXPECT_TRUE(dataOf("four.hair").starts_with(dataOf("back.hair").substr(0, 8 + 13 * 12)))
            << extension;
    }
    folder_.write("lawn.hair", lawn(20).text());
    for (const std::string extension : {".hgl", ".tfx"}) {
        EXPECT_EQ(convert("lawn.hair", "other" + extension).status, 0);
        EXPECT_EQ(convert("other" + extension, "back.hair").status, 0);
        EXPECT_TRUE(dataOf("back.hair").ends_with(dataOf("lawn.hair").substr(20 * 2))) << extension;
    }
}

TEST_F(GroomCli, ConvertSaysWhatItReadAndWroteAndWhatIsLost) {
    folder_.write("four.hair", fourStrands().text());
    const Outcome outcome = convert("four.hair", "four.obj");
    EXPECT_THAT(outcome.output, ContainsRegex("read: .*four.hair, .*4 strands, 13 points\n"));
    EXPECT_THAT(
        outcome.output, ContainsRegex("wrote: .*four.obj, 4 strands, 13 points, .* bytes\n"));
    EXPECT_THAT(outcome.output, ContainsRegex("hairbench: .*four.obj: the widths are left out\n"));
    const std::string errors =
        hairbenchErrors("groom convert " + quoted("four.hair") + " " + quoted("four.obj")).output;
    EXPECT_FALSE(errors.empty());
    for (std::size_t at = 0; at < errors.size(); at = errors.find('\n', at) + 1)
        EXPECT_EQ(errors.find("hairbench: ", at), at) << errors;
}

TEST_F(GroomCli, ConvertMakesAFileOfGuidesWithTriangles) {
    folder_.write("four.hair", fourStrands().text());
    const Outcome outcome = convert("four.hair", "guides.hgl", "--scale 0.01 --vertices 5");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output, HasSubstr("joined: the roots by 2 triangles, from the roots alone"));
    const nlohmann::json found = json("guides.hgl");
    EXPECT_EQ(found["has"]["root_triangles"], 2);  // of a square
    EXPECT_EQ(found["points"], 20);
    EXPECT_EQ(found["unit"]["stated"], true);
    EXPECT_NEAR(found["lengths"]["maximum"], 0.3, 1e-6);
}

// Equal straight strands equal the mean of their guides, except for rounding of floats.
TEST_F(GroomCli, ConvertChoosesGuidesAndSaysHowGoodTheyAre) {
    folder_.write("lawn.hair", lawn(400).text());
    const Outcome outcome =
        convert("lawn.hair", "guides.hgl", "--scale 0.01 --guides 20 --vertices 8");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output,
        ContainsRegex("chose: 20 guides of 400 strands\nerror of the strands made from them: .* nm "
                      "on average .* % of the mean length"));
    EXPECT_THAT(
        outcome.output, ContainsRegex("error of the file's strands, as /strands/source groom "
                                      "draws them with these guides: .* on average, .* at most"));
    EXPECT_EQ(json("guides.hgl")["strands"], 20);
}

TEST_F(GroomCli, ConvertAddsFollowersInTheFilesUnit) {
    folder_.write("four.hair", fourStrands().text());
    const std::string followers = "--followers 3 --follower-radius 0.5 --scale 0.01";
    const Outcome outcome = convert("four.hair", "more.hair", followers);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json found = json("more.hair", "--scale 1");
    EXPECT_EQ(found["strands"], 16);
    EXPECT_GE(found["bounding_box"]["minimum"][0], -0.005 - 1e-9);
    EXPECT_LT(found["bounding_box"]["minimum"][0], 0.0);
}

// .hgl is in metres, whatever the unit of IN. The radius is in IN's unit.
TEST_F(GroomCli, ConvertTakesAStatedUnitToMetresForGuides) {
    folder_.write(
        "cm.usda", "#usda 1.0\n(\n    metersPerUnit = 0.01\n)\ndef BasisCurves \"hair\"\n{\n"
                   "    uniform token type = \"linear\"\n    int[] curveVertexCounts = [2]\n"
                   "    point3f[] points = [(0, 0, 0), (0, 20, 0)]\n}\n");
    const Outcome outcome =
        convert("cm.usda", "m.hgl", "--followers 2 --follower-radius 1 --tip-separation 0");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("scaled: by 0.01, to metres\n"));
    const nlohmann::json found = json("m.hgl");
    EXPECT_NEAR(found["bounding_box"]["maximum"][1], 0.2, 1e-8);
    EXPECT_LE(found["bounding_box"]["maximum"][0], 0.01);
    EXPECT_GE(found["bounding_box"]["minimum"][0], -0.01);
}

// Epic's "Using Alembic for Grooms" 1.5: centimetres, groom_width, groom_id, groom_guide,
// groom_group_id from 0 and groom_root_uv.
TEST_F(GroomCli, ConvertsForPrograms) {
    folder_.write(
        "in.usda",
        "#usda 1.0\n( metersPerUnit = 1\n  upAxis = \"Y\" )\n"
        "def BasisCurves \"hair\" {\n    uniform token type = \"linear\"\n"
        "    int[] curveVertexCounts = [2, 2]\n"
        "    point3f[] points = [(0, 1.5, 0.25), (0, 1.75, 0.25), (1, 1.5, 0), (1, 2, 0)]\n"
        "    float[] widths = [0.0001] ( interpolation = \"constant\" )\n"
        "    texCoord2f[] primvars:st = [(0.25, 0.5), (0.5, 0.75)] ( interpolation = \"uniform\" "
        ")\n"
        "    int[] primvars:groom_group_id = [-3, 2] ( interpolation = \"uniform\" )\n"
        "    int[] primvars:groom_guide = [1, 0] ( interpolation = \"uniform\" )\n}\n");
    const Outcome made = convert("in.usda", "out.abc", "--for unreal");
    if (made.output.find("Python environment") != std::string::npos)
        GTEST_SKIP() << "no Python environment for USD";
    ASSERT_EQ(made.status, 0) << made.output;
    EXPECT_THAT(
        made.output, AllOf(
                         HasSubstr("converted from m to cm: strands: 2"),
                         HasSubstr("turned from +y to +z up: strands: 2"),
                         HasSubstr("renumbered: group -3 is now 0: strands: 1")));
    const std::string bytes = textOf(folder_.file("out.abc"));
    for (const char* const name :
         {"groom_version_major", "groom_width", "groom_id", "groom_guide", "groom_group_id",
          "groom_root_uv"})
        EXPECT_THAT(bytes, HasSubstr(name));

    // Back in metres with +y up, all is as it was.
    EXPECT_EQ(convert("out.abc", "back.obj", "--unit m --up y").status, 0);
    EXPECT_THAT(
        textOf(folder_.file("back.obj")),
        AllOf(HasSubstr("v 0 1.5 0.25\n"), HasSubstr("v 1 2 0\n")));
    const std::string list = hairbench("groom groups --json " + quoted("out.abc")).output;
    const auto groups = nlohmann::json::parse(list.substr(list.find("[\n")));
    ASSERT_EQ(groups.size(), 2u);
    EXPECT_EQ(groups[0]["group"], 0);
    EXPECT_EQ(groups[0]["guides"], 1);
    EXPECT_EQ(groups[1]["group"], 1);
    EXPECT_EQ(groups[1]["guides"], 0);
    EXPECT_NEAR(json("out.abc")["widths"]["maximum"].get<double>(), 1e-4, 1e-10);  // m

    ASSERT_EQ(convert("in.usda", "out.usda", "--for unreal").status, 0);
    const std::string usda = textOf(folder_.file("out.usda"));
    EXPECT_THAT(
        usda,
        AllOf(
            HasSubstr("metersPerUnit = 0.01"), HasSubstr("upAxis = \"Z\""),
            HasSubstr("points = [(0, -25, 150), (0, -25, 175), (100, 0, 150), (100, 0, 200)]"),
            HasSubstr("primvars:groom_id = [0, 1]")));
    ASSERT_EQ(convert("in.usda", "out.abc", "--for unity").status, 0);
    EXPECT_EQ(convert("out.abc", "back.obj", "--unit m").status, 0);
    EXPECT_THAT(textOf(folder_.file("back.obj")), HasSubstr("v 0 1.5 0.25\n"));

    const Outcome refused = convert("in.usda", "out.hair", "--for unreal");
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.output, HasSubstr("presets are for .abc and .usda"));
    folder_.write("four.hair", fourStrands().text());
    EXPECT_THAT(
        convert("four.hair", "four.abc", "--for unreal").output, HasSubstr("states no unit"));
    EXPECT_THAT(
        convert("four.hair", "four.abc", "--for unreal --scale 0.01").output,
        HasSubstr("states no upward axis"));
    folder_.write("bare.obj", "v 0 0 0\nv 0 1 0\nl 1 2\n");
    const Outcome given = convert("bare.obj", "bare.abc", "--for unreal --scale 1 --from-up y");
    EXPECT_EQ(given.status, 0) << given.output;
    EXPECT_THAT(given.output, HasSubstr("takes them as 1 cm wide"));
}

TEST_F(GroomCli, ConvertMayReplaceItsOwnFile) {
    folder_.write("four.hair", fourStrands().text());
    EXPECT_EQ(convert("four.hair", "four.hair", "--scale 2").status, 0);
    EXPECT_NEAR(json("four.hair", "--scale 1")["lengths"]["maximum"], 60.0, 1e-5);
}

struct RefusedGroom {
    const char* name;
    const char* in;
    const char* out;
    const char* options;
    const char* reason;
};

class GroomRefusal : public testing::TestWithParam<RefusedGroom> {};

TEST_P(GroomRefusal, IsOneLineWithStatus2AndWritesNothing) {
    const TemporaryFolder folder;
    folder.write("four.hair", fourStrands().text());
    folder.write("broken.hair", fourStrands().text().substr(0, 150));
    const auto path = [&](const char* name) { return "'" + folder.file(name).string() + "'"; };
    const Outcome outcome = hairbenchErrors(
        "groom convert " + path(GetParam().in) + " " + path(GetParam().out) + " " +
        GetParam().options);
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(GetParam().reason));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_FALSE(fs::exists(folder.file(GetParam().out)));
}

INSTANTIATE_TEST_SUITE_P(
    , GroomRefusal,
    testing::Values(
        // In some pixels, hair may have the colour of the surface that it hides.
        RefusedGroom{
            "UnknownExtension", "none.hair", "out.foo", "",
            "can't be written as '.foo'; known: .hair"},
        RefusedGroom{"NoExtension", "four.hair", "out", "", "can't be written as ''"},
        RefusedGroom{
            "OneVertex", "none.hair", "out.hair", "--vertices 1", "1 is outside [2, 65536]"},
        RefusedGroom{
            "TooManyVertices", "none.hair", "out.hair", "--vertices 65537",
            "65537 is outside [2, 65536]"},
        RefusedGroom{
            "TooManyGuideVertices", "none.hair", "out.hgl", "--vertices 257",
            "257 is outside [2, 256]"},
        RefusedGroom{"MeshForNothing", "none.hair", "out.ply", "--mesh m.obj", "root triangles"},
        RefusedGroom{
            "FollowersInOnePlace", "none.hair", "out.ply", "--followers 2", "--follower-radius"},
        RefusedGroom{
            "RadiusWithoutFollowers", "none.hair", "out.ply", "--follower-radius 2",
            "without --followers"},
        RefusedGroom{"MissingMesh", "four.hair", "out.hgl", "--mesh none.obj", "none.obj: "},
        RefusedGroom{"MissingFile", "none.hair", "out.hair", "", "none.hair: "},
        RefusedGroom{"BrokenFile", "broken.hair", "out.hair", "", "broken.hair: byte"},
        RefusedGroom{
            "TooManyGuides", "four.hair", "out.hair", "--guides 5",
            "5 is more than the 4 strands of the file"}),
    [](const auto& each) { return each.param.name; });

TEST_F(GroomCli, RefusesOptionsThatMakeNoSense) {
    folder_.write("four.hair", fourStrands().text());
    for (const char* options : {"--scale 0", "--scale -1", "--guides 0", "--vertices x"})
        EXPECT_EQ(convert("four.hair", "out.hair", options).status, 2) << options;
    EXPECT_EQ(hairbench("groom").status, 2);
    EXPECT_EQ(hairbench("groom convert " + quoted("four.hair")).status, 2);
}

// ---- Incomplete files ---------------------------------------------------------------------------

std::vector<std::string> namesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

class GroomInterrupt : public testing::TestWithParam<const char*> {};

// The signal comes as soon as the temporary file exists, long before a million points are written
// as text.
TEST_P(GroomInterrupt, LeavesTheOldFileAndNoPart) {
    const TemporaryFolder folder;
    folder.write("in/lawn.hair", lawn(65536).text());
    const fs::path out = folder.write("out/lawn.obj", "old");
    const fs::path log = folder.file("log");
    // Without job control the shell's children would ignore the interrupt.
    const fs::path script = folder.write(
        "interrupt.sh", "set -m\n'" HAIRBENCH_PROGRAM "' groom convert '" +
                            folder.file("in/lawn.hair").string() + "' '" + out.string() + "' >'" +
                            log.string() + "' 2>&1 &\nwhile ! compgen -G '" + out.string() +
                            ".*.partial' >/dev/null && kill -0 $! 2>/dev/null; do :; done\nkill -" +
                            GetParam() + " $!\nwait $!\n");
    const int status = std::system(("bash '" + script.string() + "'").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_EQ(textOf(out), "old");
    EXPECT_THAT(namesIn(out.parent_path()), testing::ElementsAre("lawn.obj"));
    EXPECT_THAT(
        textOf(log), AllOf(
                         HasSubstr("hairbench: interrupted, " + out.string() + " is not written\n"),
                         Not(HasSubstr("wrote"))));
}

INSTANTIATE_TEST_SUITE_P(, GroomInterrupt, testing::Values("INT", "TERM"), [](const auto& each) {
    return std::string(each.param);
});

TEST_F(GroomCli, SaysWhereItCannotWrite) {
    folder_.write("four.hair", fourStrands().text());
    fs::create_directory(folder_.file("folder.hair"));
    const Outcome folder = convert("four.hair", "folder.hair");
    EXPECT_EQ(folder.status, 2);
    EXPECT_THAT(folder.output, HasSubstr("folder.hair: is a folder"));
    fs::create_symlink("/dev/full", folder_.file("full.hair"));
    const Outcome full = convert("four.hair", "full.hair");
    EXPECT_EQ(full.status, 1);
    EXPECT_THAT(full.output, HasSubstr("full.hair: cannot be written: No space left on device\n"));
}

// `ulimit -f` counts in units of 0.5 or 1 kB; the file would have 3 MB.
TEST_F(GroomCli, LeavesNothingWhereThereIsNoRoom) {
    folder_.write("in/lawn.hair", lawn(4096).text());
    folder_.write("out/lawn.hair", "old");
    const Outcome outcome = hairbenchErrors(
        "groom convert " + quoted("in/lawn.hair") + " " + quoted("out/lawn.hair"),
        "ulimit -f 100; ");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(
        outcome.output, "hairbench: " + folder_.file("out/lawn.hair").string() +
                            ": cannot be written: File too large\n");
    EXPECT_EQ(textOf(folder_.file("out/lawn.hair")), "old");
    EXPECT_THAT(namesIn(folder_.file("out")), testing::ElementsAre("lawn.hair"));
}

}  // namespace
