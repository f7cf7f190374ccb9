#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
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

// ---- Light that scatters in skin ----

constexpr double kBall = 0.01;  // m, radius

// A ball with the normals of a true sphere.
groom::Mesh ball() {
    constexpr std::uint32_t kRings = 64;
    constexpr std::uint32_t kSides = 128;
    groom::Mesh mesh{.materials = {{.base_color = {1, 1, 1}, .roughness = 1.0f}}};
    for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
        for (std::uint32_t side = 0; side < kSides; ++side) {
            const double polar = std::numbers::pi * ring / kRings;
            const double azimuth = 2.0 * std::numbers::pi * side / kSides;
            const glm::dvec3 normal(
                std::sin(polar) * std::sin(azimuth), std::cos(polar),
                std::sin(polar) * std::cos(azimuth));
            mesh.normals.push_back(normal);
            mesh.positions.push_back(kBall * normal);
            if (ring == kRings) continue;
            const std::uint32_t a = ring * kSides + side;
            const std::uint32_t b = ring * kSides + (side + 1) % kSides;
            mesh.triangles.push_back({a, a + kSides, b});
            mesh.triangles.push_back({b, a + kSides, b + kSides});
            mesh.triangle_materials.insert(mesh.triangle_materials.end(), {0, 0});
        }
    }
    return mesh;
}

// The light that a sphere shows where the light has this cosine, if its profile is a Gaussian of
// `variance`, in units of its radius squared: the clamped cosine, convolved with the heat kernel.
// The kernel is sqrt(x / sin x) exp(-x^2 / (4 t)) for the time t = variance / 2, up to a factor of
// 1 + O(t^2) (Minakshisundaram and Pleijel 1949); t is up to 0.037 here.
double convolved(double variance, double cosine) {
    constexpr int kParts = 200;
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double reach = std::min(8.0 * std::sqrt(variance), 0.99 * std::numbers::pi);
    double sum = 0.0;
    double whole = 0.0;
    for (int i = 0; i < kParts; ++i) {
        const double x = (i + 0.5) / kParts * reach;
        // times sin x for the ring's length
        const double weight = std::sqrt(x * std::sin(x)) * std::exp(-x * x / (2.0 * variance));
        for (int k = 0; k < kParts; ++k) {
            const double azimuth = 2.0 * std::numbers::pi * (k + 0.5) / kParts;
            sum += weight *
                   std::max(cosine * std::cos(x) + sine * std::sin(x) * std::cos(azimuth), 0.0);
            whole += weight;
        }
    }
    return sum / whole;
}

// The three-layer model of skin, d'Eon and Luebke 2007: variances in mm^2.
glm::dvec3 skinResponse(double cosine) {
    constexpr std::array<std::array<double, 4>, 6> kTerms{
        {{0.0064, 0.233, 0.455, 0.649},
         {0.0484, 0.100, 0.336, 0.344},
         {0.187, 0.118, 0.198, 0.0},
         {0.567, 0.113, 0.007, 0.007},
         {1.99, 0.358, 0.004, 0.0},
         {7.41, 0.078, 0.0, 0.0}}};
    glm::dvec3 sum(0.0);
    for (const auto& [variance, red, green, blue] : kTerms)
        sum += glm::dvec3(red, green, blue) * convolved(variance * 1e-6 / (kBall * kBall), cosine);
    return sum;
}

class SkinScatteringTest : public GpuTest {
protected:
    static constexpr std::uint32_t kPixels = 101;
    static constexpr double kDistance = 1.0;  // m
    static constexpr double kHalfView = 0.0103;  // m, at the ball

    // The ball from +z, under light from this direction alone.
    static Settings settings(const glm::vec3& to_light) {
        Settings settings = linearSettings(kPixels);
        lightFrom(settings, to_light);
        settings.render.background = glm::vec3(0.0f);
        settings.camera.position = {0.0f, 0.0f, static_cast<float>(kDistance)};
        settings.camera.field_of_view =
            static_cast<float>(2.0 * std::atan(kHalfView / kDistance) * 180.0 / std::numbers::pi);
        settings.shading.skin_scattering = 1.0f;
        return settings;
    }

    // Linear light, [row][column] RGB. The strands, which are not drawn, are within the ball, so
    // that the lights' maps show little more than that.
    static std::vector<float> draw(const Settings& settings, const RenderAssets& assets) {
        const DeviceHair hair(
            device(), oneTriangle(std::vector{glm::vec3(0, 0, 0), glm::vec3(0, 0.001, 0)}),
            settings);
        Renderer renderer(device(), settings, hair.view(), assets);
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
        loop.finish();
        return engine::readRadiance(device(), renderer.target());
    }

    // The cosine of the light from +x at the columns of the middle row.
    static double cosineAt(std::uint32_t column) {
        const double x = (2.0 * (column + 0.5) / kPixels - 1.0) * kHalfView;
        // The ray from (0, 0, d) by (x, 0, 0) to the ball: |d + t (x, 0, -d)| = r.
        const double a = x * x + kDistance * kDistance;
        const double b = -kDistance * kDistance;
        const double root = b * b - a * (kDistance * kDistance - kBall * kBall);
        return root < 0.0 ? std::numeric_limits<double>::quiet_NaN()
                          : x * (-b - std::sqrt(root)) / a / kBall;
    }

    static std::vector<glm::dvec3> middleRow(const std::vector<float>& light) {
        std::vector<glm::dvec3> row;
        for (std::size_t i = 0; i < kPixels; ++i) {
            const std::size_t at = 3 * (std::size_t{kPixels} * (kPixels / 2) + i);
            row.emplace_back(light[at], light[at + 1], light[at + 2]);
        }
        return row;
    }
};

TEST(SkinScattering, KeepsTheEnergyOfEverySphere) {
    const std::vector<glm::vec3> table = scatteringResponses();
    ASSERT_EQ(table.size(), std::size_t{gpu::kScatteringCosines} * gpu::kScatteringCurvatures);
    for (std::uint32_t row = 0; row < gpu::kScatteringCurvatures; ++row) {
        glm::dvec3 sum(0.0);
        for (std::uint32_t i = 0; i < gpu::kScatteringCosines; ++i) {
            const bool is_end = i == 0 || i + 1 == gpu::kScatteringCosines;
            sum += (is_end ? 0.5 : 1.0) * glm::dvec3(table[row * gpu::kScatteringCosines + i]);
        }
        sum *= 2.0 / (gpu::kScatteringCosines - 1.0);
        // The integral of max(x, 0) over -1 to 1; the sum's error is h^2 / 12 times the change of
        // the slope, 2e-5.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 0.5, 5e-5) << row << ' ' << c;
    }
    // A flat surface shows the clamped cosine.
    for (std::uint32_t i = 0; i < gpu::kScatteringCosines; ++i)
        EXPECT_NEAR(
            table[i].x, std::max(2.0 * i / (gpu::kScatteringCosines - 1.0) - 1.0, 0.0), 1e-6);
}

TEST(SkinScattering, KnowsTheCurvatureOfSpheresAndPlanes) {
    for (const float curvature : curvatures(ball()))
        EXPECT_NEAR(curvature * kBall, 1.0, 1e-4);  // normals and positions are floats
    for (const float curvature : curvatures(quad())) EXPECT_EQ(curvature, 0.0f);
}

TEST_F(SkinScatteringTest, IsTheConvolutionOverTheSphere) {
    const groom::Mesh mesh = ball();
    Settings lit = settings({1.0f, 0.0f, 0.0f});
    const std::vector<glm::dvec3> scattered = middleRow(draw(lit, {.head = &mesh}));
    lit.shading.skin_scattering = 0.0f;
    const std::vector<glm::dvec3> sharp = middleRow(draw(lit, {.head = &mesh}));
    lit.shading.skin_scattering = 1.0f;
    lit.shading.shadows.meshes = true;
    const std::vector<glm::dvec3> shadowed = middleRow(draw(lit, {.head = &mesh}));
    // The eye is at a right angle to the light, so its grazing factor is the same everywhere.
    const double matt = 0.96 * (1.0 - std::pow(1.0 - std::sqrt(0.5), 5.0));
    glm::dvec3 energy(0.0);
    double last_cosine = -1.0;
    glm::dvec3 last = skinResponse(-1.0);
    for (std::uint32_t i = 0; i < kPixels; ++i) {
        const double cosine = cosineAt(i);
        if (std::isnan(cosine)) continue;
        const glm::dvec3 expected = skinResponse(cosine);
        const glm::dvec3 glossy = sharp[i] - matt * std::max(cosine, 0.0);
        const glm::dvec3 found = (scattered[i] - glossy) / matt;
        // Interpolation between rows and columns of the table, the kernel's series, and half floats
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.004) << cosine << ' ' << c;
        // The ball throws no shadow on what it scatters to.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(shadowed[i][c], scattered[i][c], 0.004) << cosine;
        energy += 0.5 * (found + last) * (cosine - last_cosine);
        last = found;
        last_cosine = cosine;
    }
    energy += 0.5 * (last + skinResponse(1.0)) * (1.0 - last_cosine);
    // Lambert's sphere has 1/2. The sum over 101 pixels is off by up to 0.2 %.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(energy[c], 0.5, 0.002) << c;
    EXPECT_GT(skinResponse(0.0).x, 0.03);  // so a response without scattering fails
}

// Light from all directions: 16 lights at the nodes of Gauss and Legendre's rule in their cosine
// at the ball's middle.
TEST_F(SkinScatteringTest, LeavesTheFurnaceTrue) {
    constexpr std::array<std::pair<double, double>, 8> kNodes{
        {{0.0950125098376374, 0.1894506104550685},
         {0.2816035507792589, 0.1826034150449236},
         {0.4580167776572274, 0.1691565193950025},
         {0.6178762444026438, 0.1495959888165767},
         {0.7554044083550030, 0.1246289712555339},
         {0.8656312023878318, 0.0951585116824928},
         {0.9445750230732326, 0.0622535239386479},
         {0.9894009349916499, 0.0271524594117541}}};
    const groom::Mesh mesh = ball();
    Settings around = settings({0.0f, 0.0f, 1.0f});
    around.shading.lights.clear();
    for (const auto& [node, weight] : kNodes) {
        for (const double cosine : {node, -node}) {
            const double sine = std::sqrt(1.0 - cosine * cosine);
            around.shading.lights.push_back(
                {.type = LightType::directional,
                 .direction = -glm::vec3(sine, 0.0, cosine),
                 .strength = static_cast<float>(2.0 * weight)});
        }
    }
    const glm::dvec3 scattered = middleRow(draw(around, {.head = &mesh}))[kPixels / 2];
    around.shading.skin_scattering = 0.0f;
    const glm::dvec3 sharp = middleRow(draw(around, {.head = &mesh}))[kPixels / 2];
    // Fresnel's factor takes 0.2 % of the matt light at 90 degrees, and more beyond. The rule's
    // error at the clamped cosine's edge is 0.1 %.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(scattered[c] / sharp[c], 1.0, 0.005) << c;
    EXPECT_NEAR(sharp.y, 1.0, 0.05);  // a white sphere; the rough reflection misses some light
}

TEST_F(SkinScatteringTest, IsOnlyWhereHairGrowsAndTheSurfaceBends) {
    const groom::Mesh mesh = ball();
    Settings lit = settings({1.0f, 0.0f, 0.0f});
    lit.render.meshes = {{}};
    const std::vector<float> beside = draw(lit, {.meshes = {mesh}});
    Settings flat = linearSettings(9);
    lightFrom(flat, glm::normalize(glm::vec3(0.4f, 0.3f, 1.0f)));
    flat.shading.skin_scattering = 1.0f;
    const groom::Mesh square = quad({.base_color = {1, 1, 1}});
    const std::vector<float> plane = draw(flat, {.head = &square});
    lit.shading.skin_scattering = flat.shading.skin_scattering = 0.0f;
    const std::vector<float> beside_sharp = draw(lit, {.meshes = {mesh}});
    const std::vector<float> plane_sharp = draw(flat, {.head = &square});
    for (std::size_t i = 0; i < beside.size(); ++i)
        ASSERT_NEAR(beside[i], beside_sharp[i], 1e-3) << i;  // a step of half floats
    for (std::size_t i = 0; i < plane.size(); ++i) ASSERT_NEAR(plane[i], plane_sharp[i], 1e-3) << i;
}

}  // namespace
}  // namespace hair::rendering
