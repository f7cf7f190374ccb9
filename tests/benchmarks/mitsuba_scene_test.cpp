// Scenes for Mitsuba: well-formed, and with the values of the settings.
#include <numbers>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/reference/mitsuba.h"

namespace benchmarks {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string sceneOf(const hair::Settings& settings, const reference::MitsubaParts& parts) {
    std::ostringstream out;
    reference::writeMitsubaScene(out, settings, parts);
    return out.str();
}

// Whether every element is closed by its own name and the root comes last.
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
    const std::string text = sceneOf(
        settings,
        {.hair_file = "hair.txt", .meshes = {{.file = "head_0.ply", .color = {1, 0, 0}}}});
    EXPECT_TRUE(isWellFormed(text)) << text;
    for (const char* part :
         {R"(<float name="fov" value="35"/>)", R"(<string name="fov_axis" value="y"/>)",
          R"(origin="25, 5, 47" target="0, -7, 0" up="0, 1, 0")",
          R"(<integer name="width" value="320"/>)", R"(<integer name="height" value="240"/>)",
          R"(<rgb name="radiance" value="1, 0, 1"/>)",
          R"(<point name="position" value="0, -7, 200"/>)",
          // 4 pi m^2 in cm^2, as a float: 125663.706
          R"(<rgb name="intensity" value="125663.7, 125663.7, 0"/>)",
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

// Mitsuba refuses colours above 1 here. Near-black hair absorbs more, so a factor has the rest.
TEST(MitsubaScene, ScalesWhatAbsorbsMuch) {
    hair::Settings settings;
    settings.shading.color = {1.0f, 1.0f, 0.0f};
    const std::string text = sceneOf(settings, {.hair_file = "hair.txt"});
    EXPECT_THAT(text, HasSubstr(R"(<rgb name="sigma_a" value="0, 0, 1"/>)"));
    // (ln 1e-4 / 5.88841475)^2, see below.
    EXPECT_THAT(text, HasSubstr(R"(<float name="scale" value="2.4465)"));
}

// By hand, for a light 2 m from the target with the display colour (1, 0.5, 0). 0.5 in sRGB is
// 0.21404114, as printed.
TEST(MitsubaOptics, LightsHaveTheirColorsAsRadianceOfMattWhite) {
    hair::RenderSettings linear, display;
    linear.tone_map = hair::ToneMap::srgb;
    const hair::LightSettings light{
        .position = {1, 0, 2}, .color = {1.0f, 0.5f, 0.0f}, .strength = 2.0f, .radius = 0.5f};
    EXPECT_NEAR(reference::lightColor(linear, light).y, 2.0 * 0.21404114, 1e-7);
    // twice the light of 0.5 in display colours
    EXPECT_NEAR(reference::lightColor(display, light).y, 1.0, 1e-12);
    const glm::dvec3 target(1, 0, 0), color(1.0, 0.25, 0.0);
    EXPECT_NEAR(
        reference::lightIntensity(light, color, target).y, std::numbers::pi, 1e-12);  // pi 4 / 4
    EXPECT_NEAR(reference::lightRadiance(light, color, target).x, 16.0, 1e-12);  // (2 / 0.5)^2
    hair::LightSettings weakening = light;
    weakening.reference_distance = 3.0f;
    EXPECT_NEAR(
        reference::lightIntensity(weakening, color, target).x, 9.0 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(reference::lightRadiance(weakening, color, target).x, 36.0, 1e-12);
}

TEST(MitsubaScene, HasEveryKindOfLight) {
    hair::Settings settings;
    settings.render.tone_map = hair::ToneMap::srgb;
    settings.camera.target = {0, 0, 0};
    settings.shading.lights = {
        {.type = hair::LightType::directional, .direction = {0, -0.5f, 0.25f}},
        {.type = hair::LightType::sphere, .position = {0, 3, 0}, .radius = 1.5f},
        {.type = hair::LightType::rectangle,
         .position = {0, 0, 0.5f},
         .direction = {0, 0, -2},
         .reference_distance = 0.5f,
         .up = {0, 1, 0},
         .width = 2.0f,
         .height = 1.0f},
        {.position = {0, 1, 0}, .reference_distance = 2.0f}};
    const std::string text = sceneOf(settings, {});
    EXPECT_TRUE(isWellFormed(text)) << text;
    for (const char* part :
         {R"(<emitter type="directional">)", R"(<vector name="direction" value="0, -0.5, 0.25"/>)",
          R"(<rgb name="irradiance" value="3.1415927, 3.1415927, 3.1415927"/>)",
          R"(<shape type="rectangle">)",
          // Sides along y x -z = -x and along y, so that the third column, their product, is the
          // normal.
          R"(<matrix value="-100 0 0 0 0 50 0 0 0 0 -1 50 0 0 0 1"/>)", R"(<shape type="sphere">)",
          R"(<point name="center" value="0, 300, 0"/>)", R"(<float name="radius" value="150"/>)",
          R"(<rgb name="radiance" value="4, 4, 4"/>)",
          R"(<rgb name="intensity" value="125663.7, 125663.7, 125663.7"/>)"})
        EXPECT_THAT(text, HasSubstr(part));
}

TEST(MitsubaScene, HasTheFibresOptics) {
    hair::Settings settings;
    settings.shading.color_from = hair::ColorSource::melanin;
    settings.shading.eumelanin = 0.5f;
    settings.shading.pheomelanin = 0.0f;
    settings.shading.longitudinal_roughness = 0.25f;
    settings.shading.azimuthal_roughness = 0.75f;
    settings.shading.cuticle_tilt = 3.0f;
    settings.shading.refractive_index = 1.5f;
    const std::string text = sceneOf(settings, {.hair_file = "hair.txt"});
    for (const char* part :
         {R"(<rgb name="sigma_a" value="0.2095, 0.3485, 0.685"/>)",
          R"(<float name="longitudinal_roughness" value="0.25"/>)",
          R"(<float name="azimuthal_roughness" value="0.75"/>)",
          R"(<float name="scale_tilt" value="-3"/>)", R"(<float name="int_ior" value="1.5"/>)"})
        EXPECT_THAT(text, HasSubstr(part));
}

// Surroundings then replace the background, and its colour gives no light.
TEST(MitsubaScene, HasSurroundingsInsteadOfABackground) {
    hair::Settings settings;
    settings.render.environment_strength = 2.0f;
    settings.render.environment_turn = -90.0f;
    const std::string text = sceneOf(settings, {.environment_file = "environment.exr"});
    EXPECT_TRUE(isWellFormed(text)) << text;
    EXPECT_THAT(text, HasSubstr(R"(<string name="filename" value="environment.exr"/>)"));
    EXPECT_THAT(text, HasSubstr(R"(<float name="scale" value="2"/>)"));
    EXPECT_THAT(text, HasSubstr(R"(<rotate y="1" angle="-90"/>)"));
    EXPECT_THAT(text, Not(HasSubstr("constant")));
}

TEST(MitsubaScene, TakesTheAbsorptionOfSingleStrandsFromAPicture) {
    const std::string text =
        sceneOf({}, {.hair_file = "hair.txt", .absorption_file = "absorption.exr"});
    EXPECT_TRUE(isWellFormed(text)) << text;
    EXPECT_THAT(text, HasSubstr(R"(<texture type="bitmap" name="sigma_a">)"));
    EXPECT_THAT(text, HasSubstr(R"(<string name="filename" value="absorption.exr"/>)"));
    EXPECT_THAT(text, Not(HasSubstr("\"scale\"")));
}

TEST(MitsubaScene, HasTheMaterialsOfMeshes) {
    hair::Settings settings;
    const reference::MitsubaParts parts{
        .meshes = {
            {.file = "a.ply", .color = {1, 1, 0}, .metallic = 1.0f, .roughness = 0.5f},
            {.file = "b.ply", .texture = "b.png", .wrap = "mirror", .two_sided = true}}};
    const std::string matt = sceneOf(settings, parts);
    EXPECT_TRUE(isWellFormed(matt)) << matt;
    EXPECT_THAT(matt, HasSubstr(R"(<rgb name="reflectance" value="1, 1, 0"/>)"));
    EXPECT_THAT(matt, HasSubstr(R"(<texture type="bitmap" name="reflectance">)"));
    EXPECT_THAT(matt, HasSubstr(R"(<string name="wrap_mode" value="mirror"/>)"));
    EXPECT_THAT(matt, HasSubstr(R"(<bsdf type="twosided">)"));
    settings.render.tone_map = hair::ToneMap::srgb;
    const std::string glossy = sceneOf(settings, parts);
    EXPECT_TRUE(isWellFormed(glossy)) << glossy;
    EXPECT_THAT(glossy, HasSubstr(R"(<rgb name="base_color" value="1, 1, 0"/>)"));
    EXPECT_THAT(glossy, HasSubstr(R"(<float name="metallic" value="1"/>)"));
    // A dielectric of index 1.5 lets 1 - (0.5 / 2.5)^2 of the light in.
    const std::string dielectric = sceneOf(settings, {.meshes = {{.color = {1, 1, 0}}}});
    EXPECT_THAT(dielectric, HasSubstr(R"(<rgb name="base_color" value="0.96, 0.96, 0"/>)"));
    EXPECT_THAT(glossy, HasSubstr(R"(<float name="roughness" value="0.5"/>)"));
}

TEST(MitsubaMesh, HasTheMaterialsTrianglesWhereTheHeadIs) {
    hair::groom::Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.normals = {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    mesh.triangle_materials = {0, 1};
    mesh.materials.resize(2);
    // Half a turn about z, then 5 up: (x, y, z) -> (-x, 5 - y, z).
    const hair::simulation::RigidMotion pose{
        .rotation = {0.0, 0.0, 0.0, 1.0}, .translation = {0, 5, 0}};
    std::ostringstream out;
    reference::writeMaterialPly(out, mesh, 1, pose);
    const std::string text = out.str();
    EXPECT_THAT(text, HasSubstr("element vertex 3\n"));
    EXPECT_THAT(text, HasSubstr("element face 1\n"));
    std::istringstream body(text.substr(text.find("end_header\n") + 11));
    const double expected[3][6] = {
        {0, 500, 0, -1, 0, 0}, {0, 500, 100, -1, 0, 0}, {-100, 500, 0, -1, 0, 0}};
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
