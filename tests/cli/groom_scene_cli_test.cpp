// Tests `hairbench groom scene` as a user runs it: its guesses about files that the test wrote.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/pictures.h"
#include "tests/cli/head_files.h"

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

struct Variant {
    const char* name;
    FileLay hair;
    FileLay head;
};

class GroomSceneVariants : public GroomSceneCli, public testing::WithParamInterface<Variant> {};

TEST_P(GroomSceneVariants, GuessesUnitsAndAxes) {
    const Variant& variant = GetParam();
    folder_.write("mine.hair", hairOnHead(variant.hair));
    folder_.write("head.obj", headObj(variant.head));
    const Outcome outcome = sceneOnHead();
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(
        outcome.output,
        AllOf(
            HasSubstr("100 % of the roots are within 5"),
            Not(HasSubstr("does not fit the head in any")), Not(HasSubstr("is not closed")),
            Not(HasSubstr("inside the head")), Not(HasSubstr("off the head"))));

    const nlohmann::json groom = written()["groom"];
    EXPECT_EQ(groom["file"], "mine.hair");
    const nlohmann::json placement = groom.value("placement", nlohmann::json::object());
    EXPECT_FLOAT_EQ(placement.value("scale", 1.0f), static_cast<float>(variant.hair.metres));
    const nlohmann::json unturned = {0, 0, 0};
    const nlohmann::json upright = {-90, 0, 0};  // takes +z to +y and -y to +z
    EXPECT_EQ(placement.value("rotation", unturned), variant.hair.z_up ? upright : unturned);
    const bool in_metres = variant.head.metres == 1.0 && !variant.head.z_up;
    EXPECT_EQ(groom["mesh"], in_metres ? "head.obj" : "mine.head.obj");
    EXPECT_EQ(std::filesystem::exists(folder_.file("mine.head.obj")), !in_metres);

    const Outcome valid = hairbench("validate " + quoted("mine.json"));
    EXPECT_EQ(valid.status, 0) << valid.output;
    if (variant.hair.z_up) return;
    // The scene's head is in metres. Roots are off its faces because the faces are flat.
    const Outcome found = hairbench(
        "groom info " + quoted("mine.hair") + " --json --scale " +
        std::to_string(variant.hair.metres) + " --mesh " + quoted(std::string(groom["mesh"])));
    EXPECT_LT(nlohmann::json::parse(found.output)["mesh"]["root_distances"]["maximum"], 5e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Files, GroomSceneVariants,
    testing::Values(
        Variant{"metres", {}, {}}, Variant{"centimetres", {0.01}, {}},
        Variant{"millimetres", {0.001}, {0.001}}, Variant{"inches", {0.0254}, {}},
        Variant{"z_up", {1.0, true}, {}}, Variant{"z_up_both", {0.01, true}, {0.01, true}}),
    [](const auto& variant) { return std::string(variant.param.name); });

TEST_F(GroomSceneCli, SaysThatHairFitsNoHead) {
    folder_.write("mine.hair", hairOnHead({}, {0.4, 0.3, 0.5}));
    folder_.write("head.obj", headObj({}));
    const Outcome outcome = sceneOnHead();
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output, HasSubstr("the hair does not fit the head in any unit or orientation"));
}

// Returns a box round (0, height / 2, 0) with its triangles facing outward.
std::string boxObj(double width, double height, double depth) {
    std::ostringstream text;
    for (int i = 0; i < 8; ++i)
        text << "v " << width * ((i & 1) - 0.5) << ' ' << height * ((i >> 1) & 1) << ' '
             << depth * ((i >> 2) - 0.5) << '\n';
    text << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    return text.str();
}

// Cells of 3 mm: 96 suffice for a head of 0.28 m; a bust of 0.6 m needs 200. A body of 1.72 m would
// need 574, more than the field permits.
TEST_F(GroomSceneCli, GivesALargeBodyAFineDistanceField) {
    for (const auto& [height, cells] : {std::pair{0.28, 96}, {0.6, 200}}) {
        HairFile file{.thickness = 80e-6f};
        for (int i = 0; i < 100; ++i) {
            file.segments.push_back(1);
            const double x = 0.1 * (i % 10 / 9.0 - 0.5);
            const double z = 0.1 * (i / 10 / 9.0 - 0.5);
            for (const double c : {x, height, z, x, height + 0.1, z})
                file.points.push_back(static_cast<float>(c));
        }
        folder_.write("mine.hair", file.text());
        folder_.write("head.obj", boxObj(0.2, height, 0.2));
        const Outcome outcome = sceneOnHead("--force --scale 1 --up y");
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        const nlohmann::json field = written()["simulation"]["distance_fields"][0];
        EXPECT_EQ(field["resolution"], cells);
        EXPECT_FALSE(field.contains("mesh"));
        if (cells > 96) {
            EXPECT_THAT(outcome.output, HasSubstr("MB, margin 2 mm"));
        }
    }
}

// A body of 1.72 m with hair of 10 cm on top of it: the field is that of its uppermost 10 cm, which
// is 0.2 m wide and deep: 96 cells.
TEST_F(GroomSceneCli, CutsABodyOffWhereNoHairIs) {
    HairFile file{.thickness = 80e-6f};
    for (int i = 0; i < 100; ++i) {
        file.segments.push_back(1);
        const double x = 0.1 * (i % 10 / 9.0 - 0.5);
        const double z = 0.1 * (i / 10 / 9.0 - 0.5);
        for (const double c : {x, 1.72, z, x, 1.82, z})
            file.points.push_back(static_cast<float>(c));
    }
    folder_.write("mine.hair", file.text());
    folder_.write("head.obj", boxObj(0.2, 1.72, 0.2));
    const Outcome outcome = sceneOnHead("--force --scale 1 --up y");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("the part of the mesh up to 10 cm beyond the hair"));
    const nlohmann::json field = written()["simulation"]["distance_fields"][0];
    EXPECT_EQ(field["resolution"], 96);
    EXPECT_EQ(field["mesh"], "mine.body.obj");
    std::istringstream lines(textOf(folder_.file("mine.body.obj")));
    double least = 2.0, most = 0.0;
    for (std::string word; lines >> word;)
        if (word == "v") {
            double x = 0.0, y = 0.0;
            lines >> x >> y;
            least = std::min(least, y);
            most = std::max(most, y);
        }
    EXPECT_NEAR(least, 1.62, 1e-6);
    EXPECT_NEAR(most, 1.72, 1e-6);
    const Outcome valid = hairbench("validate " + quoted("mine.json"));
    EXPECT_EQ(valid.status, 0) << valid.output;
}

TEST_F(GroomSceneCli, TakesWhatIsStated) {
    folder_.write("mine.hair", hairOnHead({0.01}));
    const Outcome outcome = scene("--scale 0.001 --up z");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json groom = written()["groom"];
    EXPECT_FLOAT_EQ(groom["placement"]["scale"], 0.001f);
    EXPECT_EQ(groom["placement"]["rotation"], (nlohmann::json{-90, 0, 0}));
    EXPECT_FALSE(groom.contains("mesh"));
    EXPECT_FALSE(written()["simulation"].contains("distance_fields"));
}

TEST_F(GroomSceneCli, WarnsOfAnOpenHeadAndOfRootsOffIt) {
    folder_.write("mine.hair", hairOnHead({}, {0, 0.003, 0}));
    folder_.write("head.obj", headObj({}, true));
    const Outcome outcome = sceneOnHead();
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(
        outcome.output, AllOf(
                            HasSubstr("edges with one triangle: " + std::to_string(kAround)),
                            ContainsRegex("of the roots are more than 1 mm off the head"),
                            HasSubstr("hairbench groom fix")));
}

TEST_F(GroomSceneCli, ReplacesOnlyWhenTold) {
    folder_.write("mine.hair", hairOnHead({}));
    folder_.write("mine.json", "kept");
    const Outcome refused = scene();
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.output, HasSubstr("--force"));
    EXPECT_EQ(textOf(folder_.file("mine.json")), "kept");
    EXPECT_EQ(scene("--force").status, 0);
    EXPECT_TRUE(written().contains("groom"));
}

TEST_F(GroomSceneCli, RendersAFrameWithHairInIt) {
    folder_.write("mine.hair", hairOnHead({0.01, true}));
    folder_.write("head.obj", headObj({}));
    ASSERT_EQ(sceneOnHead().status, 0);
    const auto render = [&](const std::string& name, const std::string& more) {
        return hairbench(
            "render " + quoted("mine.json") + " -o " + quoted(name) +
            " --no-cache --set /render/width=64 --set /render/height=64 --set /render/ssaa=1 "
            "--set /simulation/distance_fields/0/resolution=32 " +
            more);
    };
    const Outcome outcome = render("hair.png", "");
    if (outcome.status == 77) GTEST_SKIP() << outcome.output;
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    ASSERT_EQ(render("bare.png", "--set /render/hair=false").status, 0);
    const engine::Pixels bare = engine::readImage(folder_.file("bare.png"));
    const engine::Pixels hair = engine::readImage(folder_.file("hair.png"));
    ASSERT_EQ(bare.rgba.size(), hair.rgba.size());
    double squares = 0;
    for (std::size_t i = 0; i < bare.rgba.size(); ++i)
        squares += std::pow((bare.rgba[i] - hair.rgba[i]) / 255.0, 2);
    // A change of a tenth in a tenth of the pixels has a root mean square of 0.03.
    EXPECT_GT(std::sqrt(squares / static_cast<double>(bare.rgba.size())), 0.03);
}

TEST_F(GroomSceneCli, DrawsASheetOfFourViews) {
    folder_.write("mine.hair", hairOnHead({}));
    const Outcome outcome = scene("--sheet " + quoted("sheet.png"));
    if (outcome.status == 77) GTEST_SKIP() << outcome.output;
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    // Width and height follow the signature (8 bytes) and the header chunk's length and name (8
    // bytes), big-endian.
    EXPECT_EQ(
        textOf(folder_.file("sheet.png")).substr(16, 8), std::string("\0\0\5\0\0\0\1\x40", 8));
    EXPECT_EQ(scene("--force --sheet " + quoted("sheet.jpg")).status, 2);
}

// ---- Sheets of data sets ------------------------------------------------------------------------

class GroomSheetCli : public GroomSceneCli {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder_.file("set"));
        std::filesystem::create_directory(folder_.file("set/more"));
        folder_.write("set/b10.hair", hairOnHead({}));
        folder_.write("set/b2.hair", hairOnHead({}));
        folder_.write("set/a.hair", hairOnHead({0.01}));
        folder_.write("set/more/c.hair", hairOnHead({}));
        folder_.write("set/broken.data", "no strands");
        folder_.write("set/picture.jpg", "not hair");
    }
    Outcome sheet(const std::string& from, const std::string& options = "") const {
        return hairbench(
            "groom sheet " + quoted(from) + " -o " + quoted("sheet.png") + " --json " +
            quoted("sheet.json") + " --size 64 --columns 2 " + options);
    }
    nlohmann::json listed() const {
        return nlohmann::json::parse(textOf(folder_.file("sheet.json")));
    }
};

// Four files of hair in the order of their numbers, two in a row, and one that can't be read.
TEST_F(GroomSheetCli, DrawsAndListsAFolder) {
    const Outcome outcome = sheet("set");
    if (outcome.status == 77) GTEST_SKIP() << outcome.output;
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json all = listed();
    std::vector<std::string> names;
    for (const nlohmann::json& groom : all["grooms"]) {
        names.push_back(groom["file"]);
        EXPECT_EQ(groom["strands"], 480);
        EXPECT_EQ(groom["points"], 480 * 6);
    }
    EXPECT_THAT(names, testing::ElementsAre("a.hair", "b2.hair", "b10.hair", "more/c.hair"));
    EXPECT_EQ(all["grooms"][0]["unit"]["name"], "cm");
    EXPECT_EQ(all["grooms"][1]["unit"]["name"], "m");
    EXPECT_THAT(outcome.output, HasSubstr("its unit is cm?, that of most files m?"));
    ASSERT_EQ(all["refused"].size(), 1u);
    EXPECT_EQ(all["refused"][0]["file"], "broken.data");
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("not read:"), HasSubstr("broken.data")));
    EXPECT_THAT(outcome.output, ContainsRegex("a.hair +480 +2,880 +0 +0 +cm\\? +\\+y\\?"));
    const engine::Pixels picture = engine::readImage(folder_.file("sheet.png"));
    ASSERT_GE(picture.width, 128u);
    ASSERT_GE(picture.height, 128u);
    // Hair covers some of each quarter of the sheet: its darkest pixels are darker than the rest.
    for (const std::uint32_t row : {0u, 1u})
        for (const std::uint32_t column : {0u, 1u}) {
            std::set<std::array<std::uint8_t, 3>> colors;
            for (std::uint32_t y = 0; y < 64; ++y)
                for (std::uint32_t x = 0; x < picture.width / 2; ++x) {
                    const std::size_t pixel =
                        std::size_t{row * picture.height / 2 + y} * picture.width +
                        column * picture.width / 2 + x;
                    colors.insert(
                        {picture.rgba[4 * pixel], picture.rgba[4 * pixel + 1],
                         picture.rgba[4 * pixel + 2]});
                }
            EXPECT_GT(colors.size(), 100u) << row << ' ' << column;
        }
    EXPECT_EQ(sheet("set").status, 2);  // both files exist
    EXPECT_EQ(sheet("set", "--force --most 2").status, 0);
    ASSERT_EQ(listed()["grooms"].size(), 2u);
    EXPECT_EQ(listed()["files"], 5);
}

// Without a device there is no picture, but everything else about an archive.
TEST_F(GroomSheetCli, ReadsArchives) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const Outcome whole = sheet("set");
    if (whole.status == 77) GTEST_SKIP() << whole.output;
    const nlohmann::json of_folder = listed();
    const std::string python =
        "cd '" + folder_.path().string() + "/set' && '" + pythonInterpreter() + "' -m ";
    for (const char* const command :
         {"zipfile -c ../set.zip a.hair b2.hair b10.hair more broken.data picture.jpg",
          "tarfile -c ../set.tar.gz a.hair b2.hair b10.hair more broken.data picture.jpg"}) {
        SCOPED_TRACE(command);
        ASSERT_EQ(runInShell(python + command).status, 0);
        const std::string name =
            std::string(command).find(".zip") != std::string::npos ? "set.zip" : "set.tar.gz";
        const Outcome outcome = sheet(name, "--force");
        ASSERT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_EQ(listed()["grooms"], of_folder["grooms"]);
        EXPECT_EQ(listed()["refused"], of_folder["refused"]);
    }
    folder_.write("cut.zip", textOf(folder_.file("set.zip")).substr(0, 3000));
    EXPECT_THAT(sheet("cut.zip", "--force").output, HasSubstr("can't be read as an archive"));
    EXPECT_THAT(sheet("none", "--force").output, HasSubstr("is neither a folder nor an archive"));
    EXPECT_THAT(sheet("set/more/c.hair", "--force").output, HasSubstr("archive"));
}

}  // namespace
