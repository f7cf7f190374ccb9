// The environment on the device: the values that shaders read, and the background.
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/buffer_image.h"
#include "engine/float_pictures.h"
#include "engine/transfer.h"
#include "hair/gpu_structs.h"
#include "hair/rendering/environment.h"
#include "tests/gpu_fixture.h"
#include "tests/probe_shaders.h"
#include "tests/rendering/device_hair.h"
#include "tests/rendering/environments.h"
#include "tests/rendering/pictures.h"

namespace hair::rendering {
namespace {

Settings bald(std::uint32_t size) {
    Settings settings = thesisAtRest();
    settings.render.width = size;
    settings.render.height = size;
    settings.render.hair = false;
    settings.render.head = false;
    settings.render.tone_map = ToneMap::srgb;
    settings.render.environment = "given";
    return settings;
}

struct Probed {
    std::vector<glm::vec3> radiance;
    std::vector<glm::vec3> light;
};

class EnvironmentTest : public GpuTest {
protected:
    static Probed
    probe(const Settings& settings, engine::FloatPixels picture, const std::vector<glm::vec3>& at) {
        RenderAssets assets;
        assets.environment = std::move(picture);
        const EnvironmentPass environment(device(), settings, assets);
        probe_shaders::addTo(device());
        const engine::ComputePipeline pipeline(
            device(),
            {.shader = "probe_environment.comp",
             .constants = {{gpu::kLinearLightConstant, settings.render.tone_map != ToneMap::none}},
             .push_size = sizeof(gpu::EnvironmentProbePush)});
        const engine::Buffer directions = engine::makeBuffer(device(), at, "directions", "tests");
        const engine::Buffer radiance = engine::makeBuffer(device(), at, "radiance", "tests");
        const engine::Buffer light = engine::makeBuffer(device(), at, "light", "tests");
        runOnce(device(), [&](engine::Commands& commands) {
            commands.bind(
                pipeline, gpu::EnvironmentProbePush{
                              .environment = environment.address(),
                              .directions = directions.address(),
                              .radiance = radiance.address(),
                              .light = light.address(),
                              .count = static_cast<std::uint32_t>(at.size())});
            commands.dispatch(static_cast<std::uint32_t>(at.size() + 63) / 64);
        });
        return {
            engine::downloadAs<glm::vec3>(device(), radiance),
            engine::downloadAs<glm::vec3>(device(), light)};
    }

    struct Picture {
        std::uint32_t size;
        std::vector<float> light;  // [row][column] RGB
        std::vector<std::uint8_t> display;

        double at(std::uint32_t column, std::uint32_t row) const {
            return double{light[3 * (row * size + column) + 1]};
        }
        // The middle of the light over 1, in pixels from the upper left.
        glm::dvec2 middleOfLight() const {
            glm::dvec3 sum(0);
            for (std::uint32_t row = 0; row < size; ++row)
                for (std::uint32_t column = 0; column < size; ++column)
                    if (at(column, row) > 1) sum += glm::dvec3(column + 0.5, row + 0.5, 1);
            return glm::dvec2(sum) / sum.z;
        }
    };

    static Picture draw(
        const Settings& settings, engine::FloatPixels environment,
        const groom::Mesh* head = nullptr) {
        const std::vector<glm::vec3> line{{0, 0, 0}, {0, 0.1f, 0}};
        const DeviceHair hair(device(), oneTriangle({line, line, line}), settings);
        RenderAssets assets{.head = head};
        assets.environment = std::move(environment);
        Renderer renderer(device(), settings, hair.view(), assets);
        engine::FrameLoop loop(device(), engine::Timing::overlapped);
        loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
        loop.finish();
        Picture picture{settings.render.width, {}, engine::readOutput(device(), renderer.target())};
        if (renderer.target().hasRadiance())
            picture.light = engine::readRadiance(device(), renderer.target());
        return picture;
    }
};

std::vector<glm::vec3> floats(const std::vector<glm::dvec3>& directions) {
    return {directions.begin(), directions.end()};
}

// Light of l = 0 and 1 is reproduced exactly (irradiance_test.cpp), also by the shader, with the
// strength and turned. The tolerance of 1e-3 covers the picture's texels and the arithmetic.
TEST_F(EnvironmentTest, LightsSurfacesAsTheHarmonicsSay) {
    Settings settings = bald(8);
    settings.render.environment_strength = 3.0f;
    settings.render.environment_turn = 30.0f;
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
    const auto picture = environmentOf([&](const auto& d) { return 1 + 0.6 * glm::dot(d, axis); });
    const glm::dvec3 turned_axis = turned(axis, glm::radians(30.0));
    const std::vector<glm::dvec3> directions = someDirections();
    const Probed probed = probe(settings, picture, floats(directions));
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double x = glm::dot(directions[i], turned_axis);
        EXPECT_NEAR(probed.light[i].g, 3 * (1 + 0.4 * x), 1e-3);
        EXPECT_NEAR(probed.radiance[i].g, 3 * (1 + 0.6 * x), 3e-2);  // texels of 1.4 degrees
    }
}

// Without a tone map, colours are the display's: 0.25 of linear light is 0.5371 there.
TEST_F(EnvironmentTest, LightIsAColourOfTheDisplayWithoutAToneMap) {
    Settings settings = bald(8);
    settings.render.tone_map = ToneMap::none;
    const auto even = environmentOf([](auto) { return 0.25; }, 64);
    const Probed probed = probe(settings, even, floats(someDirections()));
    for (const glm::vec3& light : probed.light) EXPECT_NEAR(light.g, 0.5371f, 1e-3f);
    const Picture picture = draw(settings, even);
    for (std::size_t i = 0; i < picture.display.size(); i += 4)
        ASSERT_EQ(picture.display[i], 137);  // 0.5371 of 255
}

// A picture with different texels. Each texel's middle gives the texel, also at both sides of the
// seam and at the poles. A place half-way between two texels gives their mean.
TEST_F(EnvironmentTest, IsBilinearBetweenTexelsAndRoundTheHorizon) {
    engine::FloatPixels picture{4, 2, {}};
    for (int i = 0; i < 8; ++i) picture.rgb.insert(picture.rgb.end(), 3, static_cast<float>(i));
    std::vector<glm::dvec3> at;
    std::vector<double> expected;
    const auto expect = [&](double column, double row, double value) {
        at.push_back(directionOf((column + 0.5) / 4, (row + 0.5) / 2));
        expected.push_back(value);
    };
    for (int i = 0; i < 8; ++i) expect(i % 4, i / 4, i);
    expect(0.5, 0, 0.5);
    expect(2, 0.5, 4);
    expect(3.5, 0, 1.5);  // between 3 and 0
    expect(3.5, 1, 5.5);
    expect(1, -0.25, 1);  // beyond the middle of the top row
    const Probed probed = probe(bald(8), picture, floats(at));
    for (std::size_t i = 0; i < at.size(); ++i)
        EXPECT_NEAR(probed.radiance[i].r, expected[i], 1e-3) << i;
}

TEST_F(EnvironmentTest, LeavesOutWhatLightCannotBe) {
    engine::FloatPixels picture = environmentOf([](auto) { return 1.0; }, 32);
    picture.rgb[10] = std::nanf("");
    picture.rgb[11] = -1e30f;
    const Probed probed = probe(bald(8), picture, floats(someDirections()));
    for (const glm::vec3& light : probed.light) EXPECT_NEAR(light.g, 1.0f, 0.01f);
}

// A bright spot of 3 degrees at (u, v) of the picture, and its place for a camera of 90 degrees at
// the origin. The camera looks along +z with +y up, so +x is on the left. A spot at u = 0.4 is 36
// degrees to the left of the middle, at tan 36 of the half width.
struct Spot {
    double u, v;
    float turn;
    glm::vec3 looks;
    glm::dvec2 seen;  // -1 to 1, right and down
};

TEST_F(EnvironmentTest, IsSeenWhereItIs) {
    const double off = std::tan(glm::radians(36.0));
    const std::vector<Spot> spots{
        {0.5, 0.5, 0.0f, {0, 0, 1}, {0, 0}},
        {0.25, 0.5, 0.0f, {1, 0, 0}, {0, 0}},
        {0.75, 0.5, 0.0f, {-1, 0, 0}, {0, 0}},
        {0.0, 0.5, 0.0f, {0, 0, -1}, {0, 0}},
        {0.4, 0.5, 0.0f, {0, 0, 1}, {-off, 0}},
        {0.5, 0.3, 0.0f, {0, 0, 1}, {0, -off}},  // 36 degrees up
        // +z turned by 90 degrees about +y is +x.
        {0.5, 0.5, 90.0f, {1, 0, 0}, {0, 0}},
        {0.5, 0.5, -36.0f, {0, 0, 1}, {off, 0}},
    };
    for (const Spot& spot : spots) {
        Settings settings = bald(90);
        settings.camera = {.position = {0, 0, 0}, .target = spot.looks, .field_of_view = 90.0f};
        settings.render.environment_turn = spot.turn;
        const glm::dvec3 middle = directionOf(spot.u, spot.v);
        const Picture picture =
            draw(settings, environmentOf([&](const glm::dvec3& d) {
                     return glm::dot(d, middle) > std::cos(glm::radians(3.0)) ? 4.0 : 0.0;
                 }));
        const glm::dvec2 seen = picture.middleOfLight() / 45.0 - 1.0;
        // One pixel, plus the spot's texels of 1.4 degrees, which look wider away from the middle.
        EXPECT_NEAR(seen.x, spot.seen.x, 0.035) << spot.u << ' ' << spot.v << ' ' << spot.turn;
        EXPECT_NEAR(seen.y, spot.seen.y, 0.035) << spot.u << ' ' << spot.v << ' ' << spot.turn;
    }
}

// A square of 0.2 m that faces the camera 0.5 m away.
groom::Mesh wall() {
    return {
        .positions =
            {{-0.1f, -0.1f, 0.0f}, {0.1f, -0.1f, 0.0f}, {0.1f, 0.1f, 0.0f}, {-0.1f, 0.1f, 0.0f}},
        .normals = std::vector<glm::vec3>(4, {0.0f, 0.0f, 1.0f}),
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .triangle_materials = {0, 0},
        .materials = {{.name = "wall"}}};
}

// Multisampling: a pixel on the edge of a mesh has a whole number of its four samples in each of
// the two lights, and its light is their mean.
TEST_F(EnvironmentTest, IsBehindMeshesSampleBySample) {
    Settings settings = bald(64);
    settings.render.head = true;
    settings.render.msaa = 4;
    settings.camera.up = {0.3f, 1.0f, 0.0f};  // slanted edges
    settings.shading.diffuse = 0.0f;  // the same light all over the wall
    const groom::Mesh mesh = wall();
    const Picture picture = draw(settings, environmentOf([](auto) { return 8.0; }, 16), &mesh);
    const double front = picture.at(32, 32);
    ASSERT_LT(front, 4.0);
    EXPECT_NEAR(picture.at(0, 0), 8.0, 1e-2);
    std::size_t mixed = 0;
    for (std::uint32_t row = 0; row < 64; ++row) {
        for (std::uint32_t column = 0; column < 64; ++column) {
            const double samples = 4 * (picture.at(column, row) - front) / (8.0 - front);
            // Half precision rounds each sample by up to 8 / 4096.
            EXPECT_NEAR(samples, std::round(samples), 0.02) << column << ' ' << row;
            mixed += std::round(samples) > 0 && std::round(samples) < 4;
        }
    }
    EXPECT_GT(mixed, 20u);
}

}  // namespace
}  // namespace hair::rendering
