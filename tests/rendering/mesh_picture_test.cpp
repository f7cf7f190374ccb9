#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/mesh_pictures.h"
#include "tests/rendering/surface_reference.h"

namespace hair::rendering {
namespace {

constexpr Rgb kRed{255, 0, 0};
constexpr Rgb kGreen{0, 255, 0};
constexpr Rgb kBlue{0, 0, 255};
constexpr Rgb kGrey{100, 150, 200};

engine::Pixels picture(std::uint32_t width, const std::vector<Rgb>& colors, int opacity = 255) {
    engine::Pixels pixels{width, static_cast<std::uint32_t>(colors.size()) / width, {}};
    for (const Rgb& color : colors) {
        for (const int channel : color) pixels.rgba.push_back(static_cast<std::uint8_t>(channel));
        pixels.rgba.push_back(static_cast<std::uint8_t>(opacity));
    }
    return pixels;
}

// A texture with pixels that show as squares.
groom::MaterialTexture sharp(std::uint32_t index = 0) {
    return {.picture = index, .is_smooth = false};
}

class MeshPictureTest : public GpuTest {
protected:
    static groom::Mesh painted() {
        groom::Mesh mesh = quad({.base_color = {1, 1, 1}, .base_color_texture = sharp()});
        mesh.pictures = {picture(2, {kRed, kGreen, kBlue, kGrey})};
        return mesh;
    }

    // A square of white with this normal everywhere, as bytes of the map.
    static groom::Mesh tilted(const Rgb& normal) {
        groom::Mesh mesh = quad({.base_color = {1, 1, 1}, .normal_texture = sharp()});
        mesh.pictures = {picture(1, {normal})};
        return mesh;
    }

    static void expectNear(const Rgb& found, double expected) {
        for (const int channel : found) EXPECT_NEAR(channel, expected, 1.0);  // two roundings
    }
};

void expectQuarters(const Pixels& pixels) {
    EXPECT_EQ(at(pixels, 16, 4, 4), kRed);
    EXPECT_EQ(at(pixels, 16, 11, 4), kGreen);
    EXPECT_EQ(at(pixels, 16, 4, 11), kBlue);
    EXPECT_EQ(at(pixels, 16, 11, 11), kGrey);
}

TEST_F(MeshPictureTest, ShowsPicturesWithTheFirstRowUp) {
    expectQuarters(drawQuad(device(), quadSettings(16), painted()));
}

// White ambient light leaves colours as they are after conversion to linear light and back.
TEST_F(MeshPictureTest, ShowsPicturesInLinearLight) {
    const Pixels pixels = drawQuad(device(), linearSettings(16), painted());
    const Rgb shown = at(pixels, 16, 11, 11);
    for (std::size_t i = 0; i < 3; ++i) {
        // (1 - 0.04) c + 0.04 of the light: see shadeSurface().
        const double display = kGrey[i] / 255.0;
        const double linear = std::pow((display + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(shown[i], displayByte(0.96 * linear + 0.04), 1.0);  // bytes, half floats
    }
}

TEST_F(MeshPictureTest, RepeatsMirrorsAndClampsPictures) {
    groom::Mesh mesh = painted();
    // Coordinates run from -1 to 2, so the picture is in the middle third.
    for (glm::vec2& c : mesh.texture_coordinates) c = 3.0f * c - 1.0f;
    mesh.materials[0].base_color_texture->vertical = groom::Wrap::clamp;
    Pixels pixels = drawQuad(device(), quadSettings(24), mesh);
    EXPECT_EQ(at(pixels, 24, 2, 2), kRed);
    EXPECT_EQ(at(pixels, 24, 6, 2), kGreen);
    EXPECT_EQ(at(pixels, 24, 2, 21), kBlue);
    mesh.materials[0].base_color_texture->horizontal = groom::Wrap::mirror;
    pixels = drawQuad(device(), quadSettings(24), mesh);
    EXPECT_EQ(at(pixels, 24, 2, 2), kGreen);
    EXPECT_EQ(at(pixels, 24, 6, 2), kRed);
}

TEST_F(MeshPictureTest, LeavesPicturesWithoutCoordinates) {
    groom::Mesh mesh = painted();
    mesh.texture_coordinates.clear();
    EXPECT_EQ(at(drawQuad(device(), quadSettings(16), mesh), 16, 4, 4), (Rgb{255, 255, 255}));
}

// A distant board of black and white is grey: half of white's light is 188 of 255.
TEST_F(MeshPictureTest, AveragesPicturesFromFar) {
    constexpr std::uint32_t kSide = 64;
    std::vector<Rgb> board;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i)
        board.push_back((i + i / kSide) % 2 == 0 ? Rgb{0, 0, 0} : Rgb{255, 255, 255});
    groom::Mesh mesh =
        quad({.base_color = {1, 1, 1}, .base_color_texture = groom::MaterialTexture{}});
    mesh.pictures = {picture(kSide, board)};
    const Pixels display = drawQuad(device(), quadSettings(8), mesh);
    const Pixels light = drawQuad(device(), linearSettings(8), mesh);
    for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
        expectNear(at(display, 8, pixel % 8, pixel / 8), 188.0);
        expectNear(at(light, 8, pixel % 8, pixel / 8), displayByte(0.96 * 0.5 + 0.04));
    }
}

// Bytes of a map are 2 b / 255 - 1, turned into a unit vector.
glm::dvec3 normalOf(const Rgb& bytes, double scale = 1.0) {
    const glm::dvec3 vector = 2.0 * glm::dvec3(bytes[0], bytes[1], bytes[2]) / 255.0 - 1.0;
    return glm::normalize(glm::dvec3(scale, scale, 1.0) * vector);
}

TEST_F(MeshPictureTest, TiltsNormalsByTheirMap) {
    constexpr Rgb kTilt{200, 100, 230};
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    Settings settings = quadSettings(9);
    lightFrom(settings, to_light);
    groom::Mesh mesh = tilted(kTilt);
    // Red is to the right of the picture, green up.
    expectNear(
        at(drawQuad(device(), settings, mesh), 9, 4, 4),
        255.0 * glm::dot(normalOf(kTilt), to_light));
    mesh.materials[0].normal_scale = 0.5f;
    expectNear(
        at(drawQuad(device(), settings, mesh), 9, 4, 4),
        255.0 * glm::dot(normalOf(kTilt, 0.5), to_light));
}

TEST_F(MeshPictureTest, TiltsNormalsWithThePicture) {
    constexpr Rgb kTilt{200, 100, 230};
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    Settings settings = quadSettings(9);
    lightFrom(settings, to_light);
    const glm::dvec3 normal = normalOf(kTilt);

    groom::Mesh mirrored = tilted(kTilt);
    for (glm::vec2& c : mirrored.texture_coordinates) c.x = 1.0f - c.x;
    expectNear(
        at(drawQuad(device(), settings, mirrored), 9, 4, 4),
        255.0 * glm::dot(glm::dvec3(-normal.x, normal.y, normal.z), to_light));

    // u grows upward and v to the right: a quarter turn anticlockwise.
    groom::Mesh turned = tilted(kTilt);
    for (glm::vec2& c : turned.texture_coordinates) c = {1.0f - c.y, c.x};
    expectNear(
        at(drawQuad(device(), settings, turned), 9, 4, 4),
        255.0 * glm::dot(glm::dvec3(-normal.y, normal.x, normal.z), to_light));
}

TEST_F(MeshPictureTest, ReflectsByItsMaterialInLinearLight) {
    constexpr Rgb kFactors{255, 153, 102};  // roughness 0.6, metallic 0.4
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(0.4, 0.3, 1.0));
    Settings settings = quadSettings(9);
    settings.render.tone_map = ToneMap::srgb;
    settings.shading.lights = {{.type = LightType::directional, .direction = -glm::vec3(to_light)}};
    settings.shading.ambient = 0.0f;
    groom::Mesh mesh = quad(
        {.base_color = {1, 1, 1},
         .metallic = 0.5f,
         .roughness = 0.5f,
         .metallic_roughness_texture = sharp()});
    mesh.pictures = {picture(1, {kFactors})};
    const glm::dvec3 f =
        reference::surfaceBrdf({glm::dvec3(1.0), 0.2, 0.3}, {0, 0, 1}, {0, 0, 1}, to_light);
    // The middle of the picture looks along -z.
    expectNear(
        at(drawQuad(device(), settings, mesh), 9, 4, 4),
        displayByte(std::min(std::numbers::pi * f.x * to_light.z, 1.0)));
}

TEST_F(MeshPictureTest, IsNotWhereItsMaskIsNot) {
    groom::Mesh mesh = painted();
    mesh.pictures[0].rgba[3] = 100;  // red
    mesh.materials[0].opacity = 0.5f;
    EXPECT_EQ(at(drawQuad(device(), quadSettings(16), mesh), 16, 4, 4), kRed);  // opaque
    mesh.materials[0].cutoff = 0.25f;  // above 0.5 * 100 / 255, below 0.5
    const Pixels pixels = drawQuad(device(), quadSettings(16), mesh);
    EXPECT_EQ(at(pixels, 16, 4, 4), kBackground);
    EXPECT_EQ(at(pixels, 16, 11, 4), kGreen);
}

TEST_F(MeshPictureTest, HasTwoSidesIfItsMaterialHas) {
    Settings settings = quadSettings(9);
    settings.camera.position.z = -0.5f;  // behind
    const glm::vec3 to_light(0.0f, 0.6f, -0.8f);
    lightFrom(settings, to_light);
    groom::Mesh mesh = quad({.base_color = {1, 1, 1}});
    EXPECT_EQ(at(drawQuad(device(), settings, mesh), 9, 4, 4), kBackground);
    mesh.materials[0].double_sided = true;
    expectNear(at(drawQuad(device(), settings, mesh), 9, 4, 4), 255.0 * 0.8);
}

// ---- Indirect light ----

// A floor at y = 0 before a wall at z = 0. Light falls straight down, so it misses the wall.
class IndirectLightTest : public GpuTest {
protected:
    static constexpr float kSide = 0.2f;  // m, of the floor and the wall
    static constexpr std::uint32_t kPixels = 20;  // of the wall's side
    static constexpr std::uint32_t kSteps = 20;  // of the meshes, along each side
    static constexpr glm::vec3 kColor{0.8f, 0.5f, 0.2f};  // display RGB

    static void addSquare(
        groom::Mesh& mesh, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        constexpr float kStep = 1.0f / kSteps;
        for (std::uint32_t y = 0; y <= kSteps; ++y) {
            for (std::uint32_t x = 0; x <= kSteps; ++x) {
                mesh.positions.push_back(
                    corner + kStep * (static_cast<float>(x) * right + static_cast<float>(y) * up));
                mesh.normals.push_back(glm::normalize(glm::cross(right, up)));
                if (x == kSteps || y == kSteps) continue;
                const std::uint32_t at = first + y * (kSteps + 1) + x;
                mesh.triangles.push_back({at, at + 1, at + kSteps + 2});
                mesh.triangles.push_back({at, at + kSteps + 2, at + kSteps + 1});
                mesh.triangle_materials.insert(mesh.triangle_materials.end(), {0, 0});
            }
        }
    }

    static groom::Mesh floorAndWall() {
        groom::Mesh mesh{.materials = {{.base_color = kColor, .roughness = 1.0f}}};
        const glm::vec3 right(kSide, 0.0f, 0.0f);
        addSquare(mesh, {-kSide / 2, 0.0f, kSide}, right, {0.0f, 0.0f, -kSide});
        addSquare(mesh, {-kSide / 2, 0.0f, 0.0f}, right, {0.0f, kSide, 0.0f});
        return mesh;
    }

    static Settings settings() {
        Settings settings = linearSettings(kPixels);
        settings.render.background = glm::vec3(0.0f);
        settings.camera.position = {0.0f, kSide / 2, kSide / 2};
        settings.camera.target = {0.0f, kSide / 2, 0.0f};
        settings.camera.near_plane = 0.001f;
        settings.shading.ambient = 0.0f;
        settings.shading.lights = {
            {.type = LightType::directional, .direction = {0.0f, -1.0f, 0.0f}}};
        settings.shading.shadows.meshes = true;
        settings.shading.indirect = true;
        return settings;
    }

    // Strands between floor and wall, so that the lights' maps show no more than those.
    static groom::Groom between() {
        return oneTriangle(std::vector{glm::vec3(0.0f, 0.1f, 0.1f), glm::vec3(0.0f, 0.11f, 0.1f)});
    }

    // Linear light, [row][column] RGB.
    static std::vector<float>
    draw(const Settings& settings, const groom::Mesh& mesh, const groom::Groom& groom = between()) {
        const DeviceHair hair(device(), groom, settings);
        Renderer renderer(device(), settings, hair.view(), {.head = &mesh});
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
        loop.finish();
        return engine::readRadiance(device(), renderer.target());
    }

    // The part of the hemisphere over a point of the wall, weighted by the cosine, that the floor
    // fills.
    static double formFactor(double x, double y) {
        constexpr int kParts = 400;
        const double step = double{kSide} / kParts;
        double sum = 0.0;
        for (int i = 0; i < kParts; ++i) {
            for (int k = 0; k < kParts; ++k) {
                const double across = (i + 0.5) * step - double{kSide} / 2 - x;
                const double z = (k + 0.5) * step;
                const double squared = across * across + y * y + z * z;
                sum += z * y / (squared * squared) * step * step;
            }
        }
        return sum / std::numbers::pi;
    }
};

double linearOf(double display) { return std::pow((display + 0.055) / 1.055, 2.4); }

TEST_F(IndirectLightTest, OfAFloorFillsItsPartOfTheWallsHemisphere) {
    const groom::Mesh mesh = floorAndWall();
    const std::vector<float> light = draw(settings(), mesh);
    for (std::uint32_t row = 0; row + 4 < kPixels; ++row) {  // from 4.5 cm above the floor on
        for (std::uint32_t column = 0; column < kPixels; ++column) {
            const double pixel = double{kSide} / kPixels;
            const double x = (column + 0.5) * pixel - double{kSide} / 2;
            const double y = double{kSide} - (row + 0.5) * pixel;
            for (std::size_t c = 0; c < 3; ++c) {
                // A dielectric returns 0.96 of the light that its matt part gets.
                const double color = 0.96 * linearOf(double{kColor[static_cast<int>(c)]});
                const double expected = color * color * formFactor(x, y);
                // The map's sources are 5 mm apart, so the floor's edges are off by up to 3 mm of
                // its 200 mm on each side.
                EXPECT_NEAR(light[3 * (row * kPixels + column) + c] / expected, 1.0, 0.06)
                    << row << ' ' << column << ' ' << c;
            }
        }
    }
}

// Opacity maps count strands behind the floor as well. Those get no light and take none.
TEST_F(IndirectLightTest, IsTheSameWithHairBehindTheFloor) {
    std::array<std::vector<glm::vec3>, 3> guides;
    for (std::size_t i = 0; i < guides.size(); ++i)
        for (int v = 0; v < 8; ++v)
            guides[i].emplace_back(
                -0.09f + 0.025f * static_cast<float>(v), -0.05f,
                i == 0 ? 0.1f : 0.02f + 0.08f * static_cast<float>(i));
    const groom::Groom groom = oneTriangle(guides);
    const groom::Mesh mesh = floorAndWall();
    Settings hairy = settings();
    hairy.render.hair = true;
    hairy.strands.density = 64;
    hairy.strands.root_width = hairy.strands.tip_width = 0.004f;
    std::vector<std::vector<float>> pictures;
    for (const HairShadows shadows :
         {HairShadows::none, HairShadows::deep_opacity, HairShadows::deep_shadow}) {
        hairy.shading.shadows.hair = shadows;
        pictures.push_back(draw(hairy, mesh, groom));
    }
    EXPECT_EQ(pictures[1], pictures[0]);
    EXPECT_EQ(pictures[2], pictures[0]);
}

TEST_F(IndirectLightTest, IsNoneWhereNothingIsLit) {
    Settings off = settings();
    off.shading.lights[0].direction = {0.0f, 1.0f, 0.0f};  // at the floor's back
    for (const float light : draw(off, floorAndWall())) EXPECT_EQ(light, 0.0f);
    off.shading.lights.clear();
    for (const float light : draw(off, floorAndWall())) EXPECT_EQ(light, 0.0f);
    off = settings();
    off.shading.indirect = false;
    const std::vector<float> light = draw(off, floorAndWall());
    for (std::size_t i = 0; i < std::size_t{3} * kPixels; ++i) EXPECT_EQ(light[i], 0.0f);
}

}  // namespace
}  // namespace hair::rendering
