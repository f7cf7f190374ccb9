// Tests `hairbench groom scene` and `info` with the same hair and heads in files of several
// formats, and with the files of reports.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/head_files.h"

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

using GroomSceneFiles = GroomSceneCli;

// ---- Statements and defaults --------------------------------------------------------------------

using StatedFacts = GroomSceneFormats;

// The reported file: strands along +x from one place, in metres, with +y up. Only the file's
// statement says so. Formats that can state both keep the statements.
TEST_P(StatedFacts, StandAgainstAGuess) {
    const std::string text =
        textOf(HAIRBENCH_SOURCE_DIR "/tests/corpus/usd/reported_up_stated.usda");
    folder_.write("y.usda", text);
    std::string z_up = text;
    z_up.replace(z_up.find("\"Y\""), 3, "\"Z\"");
    folder_.write("z.usda", z_up);
    // The reader turns +z to +y, so the stage's +y becomes -z.
    for (const std::string stage : {"y", "z"}) {
        const std::string name = stage + GetParam();
        if (std::string(GetParam()) != ".usda") {
            ASSERT_EQ(convert(stage + ".usda", name).status, 0);
        }
        const Outcome outcome = sceneOf(name);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(
            outcome.output,
            AllOf(
                HasSubstr("hair: in m, +y up. The file states it."),
                ContainsRegex("the file states \\+y up, but strands leave the scalp and hang as if "
                              "\\+x were up, by 0\\.99[0-9]* of their length")))
            << name;
        EXPECT_FALSE(written()["groom"].contains("placement")) << name;
        EXPECT_TRUE(json(name)["unit"]["stated"]);
        EXPECT_TRUE(json(name)["up"]["stated"]);
        EXPECT_EQ(json(name)["up"]["axis"], "y");
        const Outcome valid = hairbench("validate " + quoted("mine.json"));
        EXPECT_EQ(valid.status, 0) << valid.output;
    }
    EXPECT_THAT(
        sceneOf(std::string("y") + GetParam(), "--up x").output,
        HasSubstr("+x is up, as --up states"));
}

// Hair in millimetres on its head, in a file that states metres: the statement stands.
TEST_P(StatedFacts, ThatContradictTheHeadAreWarnedOf) {
    folder_.write("head.obj", headObj({}));
    const std::string name =
        hairIn(GetParam(), hairFileOnHead({0.001}), "--scale 1 --from-up y --up y");
    const Outcome outcome = sceneOf(name, "--head " + quoted("head.obj"));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output, AllOf(
                            HasSubstr("hair: in m, +y up"),
                            HasSubstr("as the file states, in m, +y up, 0 % of the roots"),
                            HasSubstr("100 % would be in mm, +y up"), HasSubstr("--scale 0.001 ")));
    const nlohmann::json found = json(name);
    EXPECT_EQ(found["unit"]["name"], "m");
    EXPECT_TRUE(found["unit"]["stated"]);
    EXPECT_EQ(found["unit"]["sizes_suggest"]["name"], "mm");
    EXPECT_GT(found["unit"]["sizes_suggest"]["certainty"], 0.99);
}

// No other formats state both.
INSTANTIATE_TEST_SUITE_P(
    Formats, StatedFacts, testing::Values(".usda", ".gltf", ".glb", ".abc"), nameOfFormat);

using UnstatedUnits = GroomSceneFormats;

TEST_P(UnstatedUnits, AreTriedAll) {
    folder_.write("head.obj", headObj({}));
    for (const double metres : {1.0, 0.01, 0.001}) {
        const std::string name = hairIn(GetParam(), hairFileOnHead({metres}));
        const nlohmann::json found = json(name);
        EXPECT_FALSE(found["unit"]["stated"]);
        EXPECT_FALSE(found["up"]["stated"]);
        const Outcome outcome = sceneOf(name, "--head " + quoted("head.obj"));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr("100 % of the roots are within 5"));
        const nlohmann::json groom = written()["groom"];
        const nlohmann::json placement = groom.value("placement", nlohmann::json::object());
        EXPECT_FLOAT_EQ(placement.value("scale", 1.0f), static_cast<float>(metres));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, UnstatedUnits, testing::Values(".usda", ".abc", ".ply", ".npz", ".data"),
    nameOfFormat);

// The reported files nounit.usda and sph.obj: 400 strands that fall by 0.2 m along a parabola from
// the upper half of a sphere of 9.5 cm, 1.6 m above the ground, in metres; the stage states +y up
// and no unit. The head is that sphere, 48 vertices around and 32 rings high.
TEST_F(GroomSceneFiles, KeepsTheMetresOfAReportedStageWithoutAUnit) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    constexpr double kPi = std::numbers::pi;
    constexpr double kRadius = 0.095, kHeight = 1.6, kGrowth = 0.01, kFall = 0.2;
    std::ostringstream stage;
    stage.precision(9);
    stage << "#usda 1.0\n( upAxis = \"Y\" )\ndef BasisCurves \"h\" {\n uniform token type = "
             "\"linear\"\n int[] curveVertexCounts = [8";
    for (int i = 1; i < 400; ++i) stage << ", 8";
    stage << "]\n point3f[] points = [";
    for (int i = 0; i < 400; ++i) {
        const double y = (i + 0.5) / 400.0;  // an even spiral
        const double level = std::sqrt(1.0 - y * y);
        const double turn = kPi * (3.0 - std::sqrt(5.0)) * i;
        for (int k = 0; k < 8; ++k) {
            const double out = kRadius + kGrowth * k;
            const double fall = kFall * k * k / 49.0;
            stage << (i + k == 0 ? "" : ", ") << '(' << out * level * std::cos(turn) << ", "
                  << kHeight + out * y - fall << ", " << out * level * std::sin(turn) << ')';
        }
    }
    stage << "]\n float[] widths = [0.0001] ( interpolation = \"constant\" )\n}\n";
    folder_.write("nounit.usda", stage.str());
    std::ostringstream head;
    head.precision(9);
    for (int ring = 1; ring < 32; ++ring)
        for (int k = 0; k < 48; ++k)
            head << "v " << kRadius * std::sin(kPi * ring / 32) * std::cos(2 * kPi * k / 48) << ' '
                 << kHeight + kRadius * std::cos(kPi * ring / 32) << ' '
                 << kRadius * std::sin(kPi * ring / 32) * std::sin(2 * kPi * k / 48) << '\n';
    head << "v 0 " << kHeight + kRadius << " 0\nv 0 " << kHeight - kRadius << " 0\n";
    for (int ring = 0; ring < 30; ++ring)
        for (int k = 0; k < 48; ++k) {
            const int a = 48 * ring + k + 1;
            const int b = 48 * ring + (k + 1) % 48 + 1;
            head << "f " << a << ' ' << b << ' ' << a + 48 << "\nf " << b << ' ' << b + 48 << ' '
                 << a + 48 << '\n';
        }
    for (int k = 0; k < 48; ++k)
        head << "f 1489 " << (k + 1) % 48 + 1 << ' ' << k + 1 << "\nf " << 1440 + k + 1 << ' '
             << 1440 + (k + 1) % 48 + 1 << " 1490\n";
    folder_.write("head.obj", head.str());

    const nlohmann::json found = json("nounit.usda");
    EXPECT_EQ(found["strands"], 400);
    EXPECT_FALSE(found["unit"]["stated"]);
    EXPECT_THAT(found["unit"]["reason"].get<std::string>(), HasSubstr("The file doesn't state it"));
    EXPECT_EQ(found["unit"]["name"], "m");
    EXPECT_TRUE(found["up"]["stated"]);
    const Outcome outcome = sceneOf("nounit.usda", "--head " + quoted("head.obj"));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output, AllOf(
                            HasSubstr("hair: in m, +y up. 100 % of the roots are within 5"),
                            HasSubstr("head: in m, +y up."), Not(HasSubstr("does not fit"))));
    EXPECT_FALSE(written()["groom"].contains("placement"));
    const Outcome valid = hairbench("validate " + quoted("mine.json"));
    EXPECT_EQ(valid.status, 0) << valid.output;
}

// ---- Heads that state facts, and that hide meshes -----------------------------------------------

// A file of the head, with the unit and axis that the file states.
struct StatedHead {
    const char* name;
    FileLay lay;
    std::string (*text)(const HeadMesh& head, const TemporaryFolder& folder);
};

const StatedHead kStatedHeads[] = {
    {"head.usda",
     {0.01, true},
     [](const HeadMesh& head, const TemporaryFolder&) {
         return "#usda 1.0\n(metersPerUnit = 0.01\nupAxis = \"Z\")\n" + usdMesh("head", head);
     }},
    {"head.dae",
     {0.0254, true},
     [](const HeadMesh& head, const TemporaryFolder&) {
         return colladaMesh(head, "<unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis>");
     }},
    {"head.gltf", {}, [](const HeadMesh& head, const TemporaryFolder& folder) {
         return gltfMesh(head, R"({"mesh":0},{"translation":[1,0,0]})", folder);
     }}};

TEST_F(GroomSceneFiles, BelievesWhatAHeadStates) {
    for (const StatedHead& head : kStatedHeads) {
        if (std::string_view(head.name).ends_with(".usda") && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(head.name);
        folder_.write("mine.hair", hairOnHead({0.01}));
        folder_.write(head.name, head.text(headMesh(head.lay), folder_));
        const Outcome outcome = scene("--force --head " + quoted(head.name));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(
            outcome.output, AllOf(
                                HasSubstr("hair: in cm, +y up. 100 % of the roots are within 5"),
                                HasSubstr("head: in m, +y up. The file states its unit and "
                                          "upward axis.")));
        EXPECT_EQ(written()["groom"]["mesh"], head.name);  // no converted copy
    }
}

// USD's default of a centimetre is no statement, and neither is a size that no head has.
TEST_F(GroomSceneFiles, GuessesWhatAHeadDoesNotState) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    folder_.write("mine.hair", hairOnHead({}));
    for (const double metres : {1.0, 0.01}) {
        folder_.write("head.usda", "#usda 1.0\n" + usdMesh("head", headMesh({metres})));
        const Outcome outcome = scene("--force --head " + quoted("head.usda"));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(
            outcome.output,
            AllOf(
                HasSubstr("hair: in m, +y up. 100 % of the roots are within 5"),
                HasSubstr(metres == 1.0 ? "head: in m, +y up." : "head: in cm, +y up.")));
        EXPECT_EQ(written()["groom"]["mesh"], metres == 1.0 ? "head.usda" : "mine.head.obj");
    }
    folder_.write(
        "head.usda",
        "#usda 1.0\n(metersPerUnit = 1\nupAxis = \"Y\")\n" + usdMesh("head", headMesh({0.01})));
    EXPECT_THAT(
        scene("--force --head " + quoted("head.usda")).output,
        HasSubstr("the head would be 23.0 m long in the unit that its file states; it is taken to "
                  "be in cm instead"));
}

// A head with another mesh beside it that the file hides.
const StatedHead kHidingHeads[] = {
    {"head.usda",
     {},
     [](const HeadMesh& head, const TemporaryFolder&) {
         return "#usda 1.0\n(metersPerUnit = 1\nupAxis = \"Y\")\n" + usdMesh("head", head) +
                usdMesh("helmet", head, "    token visibility = \"invisible\"\n");
     }},
    {"head.gltf",
     {},
     [](const HeadMesh& head, const TemporaryFolder& folder) {
         return gltfMesh(
             head,
             R"({"mesh":0},{"mesh":0,"extensions":{"KHR_node_visibility":{"visible":false}}})",
             folder);
     }},
    {"head.abc", {}, [](const HeadMesh& head, const TemporaryFolder&) {
         return madeArchive({alembicMesh("head", head, false), alembicMesh("helmet", head, true)});
     }}};

// The hidden mesh would double each triangle, so that the head bounded no body.
TEST_F(GroomSceneFiles, CountsHiddenMeshesOfHeads) {
    folder_.write("mine.hair", hairOnHead({}));
    for (const StatedHead& head : kHidingHeads) {
        const bool is_usd = std::string_view(head.name).ends_with(".usda");
        if (is_usd && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(head.name);
        folder_.write(head.name, head.text(headMesh({}), folder_));
        const std::string said =
            is_usd ? "1 mesh of invisible prims: left out" : "1 hidden mesh is left out";
        const std::string mesh = "--mesh " + quoted(head.name);
        EXPECT_THAT(
            info("mine.hair", mesh).output, HasSubstr("left out:\n  the mesh: " + said + "\n"));
        const nlohmann::json found = json("mine.hair", mesh)["mesh"];
        EXPECT_EQ(found["left_out"], nlohmann::json{said});
        EXPECT_TRUE(found["closed"]);
        EXPECT_EQ(found["roots_off_surface"], 0);
        const Outcome outcome = scene("--force --head " + quoted(head.name));
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(
            outcome.output, AllOf(
                                HasSubstr(std::string(head.name) + ": " + said),
                                HasSubstr("100 % of the roots are within 5")));
        EXPECT_THAT(
            hairbench("validate " + quoted("mine.json")).output,
            HasSubstr("mine.json: " + std::string(head.name) + ": " + said));
        EXPECT_THAT(
            hairbench(
                "groom fix " + quoted("mine.hair") + " " + quoted("out.hair") + " --scale 1 " +
                mesh)
                .output,
            HasSubstr(std::string(head.name) + ": " + said));
    }
}

// ---- Strays -------------------------------------------------------------------------------------

// Returns 1,000 strands of 6 points of hairOnHead(), 1.6 m above the ground.
HairFile thousandStrands() {
    HairFile file{.thickness = 80e-6f};
    for (int ring = 0; ring < 20; ++ring)
        for (int k = 0; k < 50; ++k) {
            file.segments.push_back(5);
            for (int vertex = 0; vertex < 6; ++vertex) {
                const HeadPoint p = onHead(
                    0.2 + 0.06 * ring, std::numbers::pi * (1.0 + 1.4 * (k / 49.0 - 0.5)),
                    1.0 + 0.2 * vertex);
                for (const double c : {p.x, p.y + 1.6, p.z})
                    file.points.push_back(static_cast<float>(c));
            }
        }
    return file;
}

constexpr std::size_t kStray = 517;
constexpr std::size_t kFloats = 18;  // of a strand

using GroomSceneStrays = GroomSceneFormats;

TEST_P(GroomSceneStrays, DoNotDecideForTheOthers) {
    for (const float metres : {10.0f, 100.0f, 1000.0f}) {
        HairFile file = thousandStrands();
        for (std::size_t k = 0; k < kFloats; k += 3) file.points[kStray * kFloats + k] += metres;
        const std::string name = hairIn(GetParam(), file, "--scale 1");
        const nlohmann::json found = json(name);
        EXPECT_EQ(found["unit"]["name"], "m") << metres;
        ASSERT_EQ(found["strays"].size(), 1u) << metres;
        EXPECT_EQ(found["strays"][0]["strand"], kStray);
        EXPECT_NEAR(found["strays"][0]["distance"]["value"], metres, 0.2);
        EXPECT_LT(found["bounding_box"]["maximum"][0], 0.2);

        const Outcome outcome = sceneOf(name);
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr("strand 517 (from 0) with its root "));
        const nlohmann::json camera = written()["camera"];
        for (int axis = 0; axis < 3; ++axis) {  // hair within 0.25 m of (0, 1.7, 0)
            const double middle = axis == 1 ? 1.7 : 0.0;
            EXPECT_NEAR(camera["target"][axis], middle, 0.25);
            EXPECT_NEAR(camera["position"][axis], middle, 2.0);
        }
        const Outcome valid = hairbench("validate " + quoted("mine.json"));
        EXPECT_EQ(valid.status, 0) << valid.output;
    }
}

TEST_P(GroomSceneStrays, ATipAtTheOriginIsNamed) {
    HairFile file = thousandStrands();
    for (std::size_t k = kFloats - 3; k < kFloats; ++k) file.points[kStray * kFloats + k] = 0.0f;
    const std::string name = hairIn(GetParam(), file, "--scale 1");
    const nlohmann::json found = json(name);
    ASSERT_EQ(found["strays"].size(), 1u);
    EXPECT_EQ(found["strays"][0]["strand"], kStray);
    EXPECT_EQ(found["strays"][0]["by"], "segment");
    // The point before the tip is at 1.6 m plus at most 1.8 times the head's half height.
    EXPECT_NEAR(found["strays"][0]["distance"]["value"], 1.7, 0.15);
    EXPECT_THAT(sceneOf(name).output, HasSubstr("strand 517 (from 0) with a segment of 1.7"));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, GroomSceneStrays, testing::Values(".hair", ".ply", ".npy", ".abc", ".usda", ".gltf"),
    nameOfFormat);

// ---- Scenes that are written --------------------------------------------------------------------

using GroomSceneWritten = GroomSceneFormats;

// Whatever the unit, a scene is either valid, or not written and the reason is said.
TEST_P(GroomSceneWritten, IsAcceptedByValidate) {
    const std::string name = hairIn(GetParam(), hairFileOnHead({}));
    int refused = 0;
    for (const char* scale : {"1e-6", "1e-4", "0.0254", "1", "30", "1000", "1e4", "1e5", "1e6"}) {
        const Outcome outcome = sceneOf(name, std::string("--scale ") + scale);
        if (outcome.status != 0) {
            ++refused;
            EXPECT_EQ(outcome.status, 2);
            EXPECT_THAT(
                outcome.output, AllOf(
                                    HasSubstr("no scene is written"),
                                    HasSubstr("is outside [-1000, 1000]"), HasSubstr("--scale")));
            continue;
        }
        const Outcome valid = hairbench("validate " + quoted("mine.json"));
        EXPECT_EQ(valid.status, 0) << scale << ": " << valid.output;
        const nlohmann::json camera = written()["camera"];
        double distance = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            distance += std::pow(
                camera["position"][axis].get<double>() -
                    camera.value("target", nlohmann::json{0, 0, 0})[axis].get<double>(),
                2);
        EXPECT_GT(camera.value("far_plane", 100.0), std::sqrt(distance)) << scale;
        EXPECT_LT(camera.value("near_plane", 0.01), std::sqrt(distance)) << scale;
    }
    // Hair of 0.3 m is 300 km large at a scale of 10^6; cameras are within 1 km of the origin.
    EXPECT_GE(refused, 3);
    EXPECT_LE(refused, 4);
}

// Frames of 1/60 s have 1 or 2 steps of 0.01 s.
TEST_P(GroomSceneWritten, IsWarnedOfStepsThatDoNotDivideFrames) {
    ASSERT_EQ(sceneOf(hairIn(GetParam(), hairFileOnHead({})), "--scale 1").status, 0);
    const auto validated = [&](double time_step, bool interpolate) {
        nlohmann::json changed = written();
        changed["simulation"]["time_step"] = time_step;
        changed["run"] = {{"frame_time", 1.0 / 60.0}, {"interpolate", interpolate}};
        folder_.write("steps.json", changed.dump());
        const Outcome outcome = hairbench("validate " + quoted("steps.json"));
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return outcome.output;
    };
    const std::string warning = "a frame advances by 1 or 2 steps";
    EXPECT_THAT(validated(0.01, false), HasSubstr(warning));
    EXPECT_THAT(validated(0.01, true), Not(HasSubstr(warning)));
    EXPECT_THAT(validated(1.0 / 120.0, false), Not(HasSubstr("a frame advances")));
}

TEST_P(GroomSceneWritten, NamesStrandsThatRunFromTipToRoot) {
    folder_.write("head.obj", headObj({}));
    HairFile file = thousandStrands();
    for (std::size_t i = 0; i < file.points.size(); i += kFloats)
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t axis = 0; axis < 3; ++axis)
                std::swap(file.points[i + 3 * k + axis], file.points[i + 15 - 3 * k + axis]);
    for (std::size_t k = 1; k < file.points.size(); k += 3) file.points[k] -= 1.6f;
    const std::string name = hairIn(GetParam(), file);
    const Outcome outcome = sceneOf(name, "--head " + quoted("head.obj"));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output, AllOf(
                            HasSubstr("strands run from tip to root: 100 % of their last points"),
                            HasSubstr("hairbench groom reverse"), Not(HasSubstr("in any unit"))));
    EXPECT_THAT(
        info(name, "--scale 1 --mesh " + quoted("head.obj")).output,
        HasSubstr("1,000 strands from tip to root"));
}

INSTANTIATE_TEST_SUITE_P(
    Formats, GroomSceneWritten, testing::Values(".hair", ".ply", ".npz", ".abc", ".usda"),
    nameOfFormat);

// A file of a report, with texts that `groom scene` says of it and others that it doesn't say.
struct ReportedFile {
    const char* name;  // in tests/corpus
    std::vector<const char*> said;
    std::vector<const char*> not_said;
};

const ReportedFile kReportedFiles[] = {
    {"usd/reported_guides_flag.usda", {"guides: 2, the strands that the file flags"}, {"left out"}},
    {"usd/reported_half_width.usda",
     {"2 of 5 points have no colour and become white", "colour: the mean of the file's colours",
      "widths: the file's, median 100.0 µm"},
     {}},
    {"usd/reported_invisible.usda",
     {"2 strands, 6 points",
      "1 strand of invisible prims, 1 strand of prims of purpose \"guide\": left out"},
     {}},
    {"usd/reported_pinned_varying.usda", {"1 strand, 7 points"}, {"left out:"}},
    {"usd/reported_seq.usda",
     {"hair: in cm, +y up. The file states it.", "/a: one of its 3 time samples is read"},
     {"sizes are those of hair in"}},
    {"usd/reported_st_vertex.usda", {"2 strands, 4 points"}, {"left out"}},
    {"usd/reported_up_stated.usda", {"hair: in m, +y up. The file states it."}, {"left out"}},
    {"usd/reported_usd_width1.usda", {"widths: the file's, median 100.0 µm"}, {"left out"}},
    {"hair/reported_one_point.hair",
     {"11 strands, 110 points",
      "1 strand of a single point (strand 4, counted from 0) is left out"},
     {}}};

TEST_F(GroomSceneFiles, MakesScenesOfReportedFiles) {
    const std::string corpus = HAIRBENCH_SOURCE_DIR "/tests/corpus/";
    for (const ReportedFile& file : kReportedFiles) {
        const std::string name = std::filesystem::path(file.name).filename().string();
        if (name.ends_with(".usda") && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(name);
        folder_.write(name, textOf(corpus + file.name));
        const Outcome outcome = sceneOf(name);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        for (const char* said : file.said) EXPECT_THAT(outcome.output, HasSubstr(said));
        for (const char* said : file.not_said) EXPECT_THAT(outcome.output, Not(HasSubstr(said)));
        const Outcome valid = hairbench("validate " + quoted("mine.json"));
        EXPECT_EQ(valid.status, 0) << valid.output;
        EXPECT_EQ(convert(name, "out.abc").status, 0);
        EXPECT_EQ(json("out.abc")["strands"], json(name)["strands"]);
    }
    folder_.write("points.hair", textOf(corpus + "findings/hair/reported_only_points.hair"));
    for (const Outcome& outcome :
         {sceneOf("points.hair"), info("points.hair"), convert("points.hair", "out.abc")}) {
        EXPECT_EQ(outcome.status, 2);
        EXPECT_THAT(
            outcome.output,
            HasSubstr("points.hair: no strand can be used; the file has only 12 strands of a "
                      "single point (the first is strand 0, counted from 0)"));
    }
}

// Hair sunk by 4 mm into a head that is open at the neck. The highest roots are 1.3 rad above the
// middle. There the normal's share of y is (sin 1.3 / 115) / |(cos 1.3 / 75 to 95, sin 1.3 / 115)|:
// 0.92 to 0.95 for half axes in mm, so that the deepest is 3.7 mm inside, less up to 0.2 mm for
// flat faces. `groom info` and `groom scene` say the same.
TEST_F(GroomSceneFiles, KnowsTheStrandsInsideAnOpenHeadAsInfoDoes) {
    folder_.write("mine.hair", hairOnHead({}, {0, -0.004, 0}));
    folder_.write("head.obj", headObj({}, true));
    const Outcome outcome = scene("--scale 1 --up y --head " + quoted("head.obj"));
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json found =
        json("mine.hair", "--scale 1 --mesh " + quoted("head.obj"))["mesh"];
    EXPECT_FALSE(found["closed"]);
    EXPECT_NEAR(found["deepest"]["value"], 0.0037, 0.0003);
    std::smatch match;
    ASSERT_TRUE(std::regex_search(
        outcome.output, match,
        std::regex("([0-9.]+) % of the strands are deeper than 1 mm inside the head, up to "
                   "([0-9.]+) mm")))
        << outcome.output;
    EXPECT_NEAR(std::stod(match[1]), 100.0 * found["strands_inside"].get<double>() / 480.0, 0.05);
    EXPECT_NEAR(std::stod(match[2]), 1e3 * found["deepest"]["value"].get<double>(), 0.005);

    // The same head, closed.
    folder_.write("head.obj", headObj({}));
    const nlohmann::json closed =
        json("mine.hair", "--scale 1 --mesh " + quoted("head.obj"))["mesh"];
    EXPECT_EQ(found["strands_inside"], closed["strands_inside"]);
    EXPECT_EQ(found["points_inside"], closed["points_inside"]);
    EXPECT_NEAR(found["deepest"]["value"], closed["deepest"]["value"], 1e-6);
}

}  // namespace
