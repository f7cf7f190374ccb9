// Tests `hairbench groom scene` as a user runs it: its guesses about files that the test wrote.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/pictures.h"
#include "tests/cli/groom_files.h"

namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Unit and up axis of a file: metres per unit, and whether z is up, with -y as the front.
struct FileLay {
    double metres = 1.0;
    bool z_up = false;
};

struct HeadPoint {
    double x, y, z;  // m, +y up, front +z
};

// Returns a point on an ellipsoid as wide, high and deep as a head, with three different axes.
HeadPoint onHead(double elevation, double azimuth, double factor = 1.0) {
    const double level = std::abs(elevation) < 1.57 ? std::cos(elevation) : 0.0;  // at the poles
    return {
        factor * 0.075 * level * std::sin(azimuth), factor * 0.115 * std::sin(elevation),
        factor * 0.095 * level * std::cos(azimuth)};
}

std::vector<double> inFile(const HeadPoint& p, const FileLay& lay) {
    if (lay.z_up) return {p.x / lay.metres, -p.z / lay.metres, p.y / lay.metres};
    return {p.x / lay.metres, p.y / lay.metres, p.z / lay.metres};
}

constexpr int kRings = 40;
constexpr int kAround = 80;

// Returns the ellipsoid as OBJ. Edges are at most 1 cm long, so flat faces are off by 0.2 mm.
// `open` leaves out the lowest rings.
std::string headObj(const FileLay& lay, bool open = false) {
    constexpr double kPi = std::numbers::pi;
    std::ostringstream text;
    text.precision(9);
    for (int i = 0; i <= kRings; ++i)
        for (int k = 0; k < kAround; ++k) {
            const auto p =
                inFile(onHead(kPi * (i / double{kRings} - 0.5), 2 * kPi * k / kAround), lay);
            text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
        }
    for (int i = open ? 6 : 0; i < kRings; ++i)
        for (int k = 0; k < kAround; ++k) {
            const int a = i * kAround + k + 1;
            const int b = i * kAround + (k + 1) % kAround + 1;
            if (i > 0) text << "f " << a << ' ' << b << ' ' << b + kAround << '\n';
            if (i + 1 < kRings)
                text << "f " << a << ' ' << b + kAround << ' ' << a + kAround << '\n';
        }
    return text.str();
}

// Returns 480 strands that stand off the upper and hind part of the head, as long as its radius.
std::string hairOnHead(const FileLay& lay, const HeadPoint& moved = {0, 0, 0}) {
    HairFile file{.thickness = static_cast<float>(80e-6 / lay.metres)};
    for (int ring = 0; ring < 12; ++ring)
        for (int k = 0; k < 40; ++k) {
            const double elevation = 0.2 + 0.1 * ring;
            // From one temple over the back of the head to the other.
            const double azimuth = std::numbers::pi * (1.0 + 1.4 * (k / 39.0 - 0.5));
            file.segments.push_back(5);
            for (int vertex = 0; vertex < 6; ++vertex) {
                const HeadPoint p = onHead(elevation, azimuth, 1.0 + 0.2 * vertex);
                for (const double c : inFile({p.x + moved.x, p.y + moved.y, p.z + moved.z}, lay))
                    file.points.push_back(static_cast<float>(c));
            }
        }
    return file.text();
}

class GroomSceneCli : public GroomCli {
protected:
    Outcome scene(const std::string& options = "") const {
        return hairbench(
            "groom scene " + quoted("mine.hair") + " -o " + quoted("mine.json") + " " + options);
    }
    Outcome sceneOnHead(const std::string& options = "") const {
        return scene("--head " + quoted("head.obj") + " " + options);
    }
    nlohmann::json written() const {
        return nlohmann::json::parse(textOf(folder_.file("mine.json")));
    }
};

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

}  // namespace
