#include <algorithm>
#include <numbers>

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

}  // namespace
}  // namespace hair::rendering
