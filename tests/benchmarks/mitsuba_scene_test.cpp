// Scenes of Mitsuba: well-formed, and with the values of the settings.
#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/mitsuba_optics.h"
#include "benchmarks/mitsuba_scene.h"
#include "benchmarks/mitsuba_shapes.h"

namespace benchmarks {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string sceneOf(const hair::Settings& settings, const MitsubaParts& parts) {
    std::ostringstream out;
    writeMitsubaScene(out, settings, parts);
    return out.str();
}

// Whether every element is closed by its own name, and the root is the last.
bool isWellFormed(const std::string& text) {
    const std::regex tag(R"(<(/?)(\w+)((?:\s+\w+="[^"<&]*")*)\s*(/?)>)");
    std::string body = text.substr(text.find("?>") + 2);
    std::vector<std::string> open;
    bool ended = false;
    for (std::smatch match; std::regex_search(body, match, tag); body = match.suffix()) {
        if (ended || match.prefix().str().find_first_not_of(" \n") != std::string::npos)
            return false;
        if (match[1].length() > 0) {
            if (open.empty() || open.back() != match[2]) return false;
            open.pop_back();
            ended = open.empty();
        } else if (match[4].length() == 0) {
            open.push_back(match[2]);
        }
    }
    return ended && body.find_first_not_of(" \n") == std::string::npos;
}

TEST(MitsubaScene, HasTheSettings) {
    hair::Settings settings;
    settings.camera = {
        .position = {0.25f, 0.05f, 0.47f},
        .target = {0, -0.07f, 0},
        .up = {0, 1, 0},
        .field_of_view = 35.0f};
    settings.render.width = 320;
    settings.render.height = 240;
    settings.render.background = {1.0f, 0.0f, 1.0f};
    settings.shading.lights[0].position = {0, -0.07f, 2};  // 2 m from the target
    settings.shading.lights[0].color = {1, 1, 0};
    const std::string text =
        sceneOf(settings, {.hair_file = "hair.txt", .meshes = {{"head_0.ply", {1, 0, 0}}}});
    EXPECT_TRUE(isWellFormed(text)) << text;
    for (const char* part :
         {R"(<float name="fov" value="35"/>)", R"(<string name="fov_axis" value="y"/>)",
          R"(origin="0.25, 0.05, 0.47" target="0, -0.07, 0" up="0, 1, 0")",
          R"(<integer name="width" value="320"/>)", R"(<integer name="height" value="240"/>)",
          R"(<rgb name="radiance" value="1, 0, 1"/>)",
          R"(<point name="position" value="0, -0.07, 2"/>)",
          // 4 pi
          R"(<rgb name="intensity" value="12.566371, 12.566371, 0"/>)",
          R"(<string name="filename" value="hair.txt"/>)",
          R"(<string name="filename" value="head_0.ply"/>)",
          R"(<rgb name="reflectance" value="1, 0, 0"/>)"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST(MitsubaScene, LeavesOutWhatIsNotDrawn) {
    hair::Settings settings;
    settings.render.background = glm::vec3(0.0f);
    const std::string text = sceneOf(settings, {});
    EXPECT_TRUE(isWellFormed(text)) << text;
    EXPECT_THAT(text, Not(HasSubstr("constant")));
    EXPECT_THAT(text, Not(HasSubstr("<shape")));
}

// Mitsuba refuses colours above 1 there: near black absorbs more, so the rest is in the factor.
TEST(MitsubaScene, ScalesWhatAbsorbsMuch) {
    hair::Settings settings;
    settings.shading.color = {1.0f, 1.0f, 0.0f};
    const std::string text = sceneOf(settings, {.hair_file = "hair.txt", .meshes = {}});
    EXPECT_THAT(text, HasSubstr(R"(<rgb name="sigma_a" value="0, 0, 1"/>)"));
    // (ln 1e-4 / 5.88841475)^2, see below.
    EXPECT_THAT(text, HasSubstr(R"(<float name="scale" value="2.4465)"));
}

TEST(MitsubaOptics, TurnsDisplayColorsLinear) {
    // IEC 61966-2-1: the ends, the joint of its two parts from both sides, and the middle.
    const glm::dvec3 linear = toLinear({0.0, 1.0, 0.5});
    EXPECT_EQ(linear.x, 0.0);
    EXPECT_EQ(linear.y, 1.0);
    EXPECT_NEAR(linear.z, 0.21404114, 1e-8);  // as printed
    const glm::dvec3 joint = toLinear({0.04045, 0.0404501, 0.04045});
    EXPECT_NEAR(joint.x, 0.0031308, 1e-7);
    EXPECT_NEAR(joint.y, joint.x, 1e-7);
}

// By hand, beta = 0.3: 5.969 - 0.0645 + 0.22788 - 0.28971 + 0.0451494 + 0.00059535 = 5.88841475.
TEST(MitsubaOptics, InvertsTheColorOfMuchHair) {
    const glm::dvec3 absorption = absorptionOf({1.0, std::exp(-1.0), std::exp(-2.0)}, 0.3);
    const double one = 1.0 / (5.88841475 * 5.88841475);
    EXPECT_EQ(absorption.x, 0.0);
    EXPECT_NEAR(absorption.y, one, 1e-12);
    EXPECT_NEAR(absorption.z, 4.0 * one, 1e-12);
}

TEST(MitsubaMesh, HasTheMaterialsTrianglesWhereTheHeadIs) {
    hair::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.normals = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    mesh.triangle_materials = {0, 1};
    mesh.materials.resize(2);
    // Half a turn about z, then 5 up: (x, y, z) -> (-x, 5 - y, z).
    const hair::RigidMotion pose{.rotation = {0.0, 0.0, 0.0, 1.0}, .translation = {0, 5, 0}};
    std::ostringstream out;
    writeMaterialPly(out, mesh, 1, pose);
    const std::string text = out.str();
    EXPECT_THAT(text, HasSubstr("element vertex 3\n"));
    EXPECT_THAT(text, HasSubstr("element face 1\n"));
    std::istringstream body(text.substr(text.find("end_header\n") + 11));
    const double expected[3][6] = {{0, 5, 0, -1, 0, 0}, {0, 5, 1, -1, 0, 0}, {-1, 5, 0, -1, 0, 0}};
    for (const auto& vertex : expected) {
        for (const double coordinate : vertex) {
            double read = 0.0;
            body >> read;
            EXPECT_EQ(read, coordinate);
        }
    }
    std::string rest;
    std::getline(body >> std::ws, rest);
    EXPECT_EQ(rest, "3 0 1 2");
}

}  // namespace
}  // namespace benchmarks
