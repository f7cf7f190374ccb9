// Strands seen end-on. E x T, the direction across quads and fibres' frames, is 0 there.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/buffer_image.h"
#include "engine/frame_loop.h"
#include "engine/transfer.h"
#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/linear_picture.h"
#include "tests/rendering/strand_probe.h"

namespace hair::rendering {
namespace {

constexpr ShadingModel kModels[]{
    ShadingModel::phong, ShadingModel::kajiya_kay, ShadingModel::marschner,
    ShadingModel::dual_scattering};

// Light from the eye, from the side of the strands and from directions along them.
Settings litSettings(ShadingModel model) {
    Settings settings = linearPicture(33, 33);
    settings.shading.model = model;
    settings.shading.ambient = 0.1f;
    settings.shading.longitudinal_roughness = 1.0f;  // light goes from across to along
    settings.shading.lights = {
        {.type = LightType::directional, .direction = {0, 0, -1}},
        {.type = LightType::directional, .direction = {0, -1, 0}},
        {.type = LightType::directional, .direction = {-0.6f, 0, -0.8f}}};
    return settings;
}

using EndOn = GpuTest;

// Points with tangents towards the eye or away from it, and others that are off by an angle that
// floats hardly resolve.
TEST_F(EndOn, EveryModelShadesPointsWithFiniteLight) {
    std::vector<gpu::StrandProbe> probes;
    const glm::vec3 directions[]{{1, 0, 0},       {0, 1, 0},        {0, 0, -1},
                                 {0.6f, 0, 0.8f}, {0, -0.6f, 0.8f}, {0.48f, 0.6f, 0.64f}};
    for (const glm::vec3& tangent : directions)
        for (const float sign : {1.0f, -1.0f})
            for (const glm::vec3& off : {glm::vec3(0.0f), glm::vec3(1e-8f, 2e-8f, -1e-8f)})
                for (const float across : {-1.0f, -0.3f, 0.0f, 0.8f, 1.0f})
                    probes.push_back(
                        {.tangent = tangent,
                         .to_eye = sign * tangent + off,
                         .across = across,
                         .normal = {},
                         .color = {}});
    for (const ShadingModel model : kModels)
        for (const gpu::StrandProbe& probe : shadeStrands(device(), litSettings(model), probes)) {
            // A normal of a cylinder, to some ten roundings.
            EXPECT_NEAR(glm::length(probe.normal), 1.0f, 1e-6f);
            EXPECT_NEAR(glm::dot(probe.normal, probe.tangent), 0.0f, 1e-6f);
            for (int c = 0; c < 3; ++c) {
                EXPECT_TRUE(std::isfinite(probe.color[c])) << static_cast<int>(model);
                EXPECT_GE(probe.color[c], 0.0f) << static_cast<int>(model);
            }
        }
}

// ---- Pictures -----------------------------------------------------------------------------------

// A strand that comes towards the eye's axis, touches it along the axis, and leaves it on the same
// side again. The eye sees it end-on at its middle vertex, in the middle of the picture. At z = 0
// the picture is 0.66 m wide, 2 cm a pixel.
groom::Groom bentStrand() {
    return oneTriangle(
        {{0.3f, 0, -0.2f}, {0.1f, 0, -0.1f}, {0, 0, 0}, {0.1f, 0, 0.1f}, {0.3f, 0, 0.2f}});
}

Settings bentSettings(ShadingModel model) {
    Settings settings = litSettings(model);
    settings.strands.backend = Backend::tessellation;
    settings.strands.density = 1;
    settings.strands.tessellation = 4;
    settings.strands.curve = Curve::catmull_rom;  // goes through its points, to the last bit
    settings.strands.root_width = settings.strands.tip_width = 0.2f;
    settings.camera.position = {0, 0, 1};
    settings.camera.target = {0, 0, 0};
    settings.camera.field_of_view =
        static_cast<float>(2.0 * std::atan(0.33) * 180.0 / 3.14159265358979);
    return settings;
}

// The picture before it is resolved: half floats, [row][column] RGBA.
std::vector<std::uint16_t> drawRendered(const engine::Device& device, const Settings& settings) {
    const DeviceHair hair(device, bentStrand(), settings);
    Renderer renderer(device, settings, hair.view(), {});
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
    loop.finish();
    const engine::Image& color = renderer.target().color();
    EXPECT_EQ(color.format(), VK_FORMAT_R16G16B16A16_SFLOAT);
    runOnce(device, [&](engine::Commands& commands) {
        commands.transition(
            color, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    });
    const engine::Buffer bytes = engine::readImage(device, color, 8);
    std::vector<std::uint16_t> halves(bytes.size() / 2);
    std::memcpy(halves.data(), bytes.mapped().data(), bytes.size());
    return halves;
}

bool isFiniteHalf(std::uint16_t half) { return (half & 0x7c00u) != 0x7c00u; }
bool isAboveZero(std::uint16_t half) { return half != 0 && half < 0x8000u; }

// Every sample is finite, and the strand has its full width at the vertex that the eye sees end-on:
// 0.2 m at the middle vertex are 10 px. Their column is the edge of two quads and belongs to them.
void expectSound(const std::vector<std::uint16_t>& halves, const std::string& what) {
    ASSERT_EQ(halves.size(), 4u * 33 * 33);
    EXPECT_TRUE(std::ranges::all_of(halves, isFiniteHalf)) << what;
    for (std::size_t row = 12; row <= 20; ++row)
        EXPECT_TRUE(isAboveZero(halves[4 * (33 * row + 16)])) << what << ", row " << row;
}

TEST_F(EndOn, EveryModelAndTransparencyDrawsFiniteLight) {
    for (const ShadingModel model : kModels)
        for (const Transparency transparency :
             {Transparency::none, Transparency::alpha_to_coverage, Transparency::weighted_blended,
              Transparency::fragment_list}) {
            Settings settings = bentSettings(model);
            settings.render.transparency = transparency;
            expectSound(
                drawRendered(device(), settings),
                std::to_string(static_cast<int>(model)) + ", transparency " +
                    std::to_string(static_cast<int>(transparency)));
        }
}

TEST_F(EndOn, SoDoBackEndsCoverageAndShadows) {
    for (const Backend backend : {Backend::tessellation, Backend::pulling_geometry})
        for (const bool is_analytic : {false, true}) {
            Settings settings = bentSettings(ShadingModel::dual_scattering);
            settings.strands.backend = backend;
            settings.shading.shadows.hair = HairShadows::deep_opacity;  // the first light is end-on
            if (is_analytic) {
                settings.render.coverage = Coverage::analytic;
                settings.render.transparency = Transparency::fragment_list;
            }
            expectSound(
                drawRendered(device(), settings),
                std::to_string(static_cast<int>(backend)) + (is_analytic ? ", analytic" : ""));
        }
}

// Tangents stored to 0.1 degrees have a side even if the eye sees the strand end-on, but it differs
// in the last bits, so pixels exactly on the edge may be lost.
TEST_F(EndOn, BackEndsFromPointsDrawFiniteLight) {
    for (const Backend backend : {Backend::expanded, Backend::software})
        for (const ShadingModel model : kModels) {
            Settings settings = bentSettings(model);
            settings.strands.backend = backend;
            settings.shading.shadows.hair = HairShadows::deep_opacity;
            const std::vector<std::uint16_t> halves = drawRendered(device(), settings);
            ASSERT_EQ(halves.size(), 4u * 33 * 33);
            EXPECT_TRUE(std::ranges::all_of(halves, isFiniteHalf)) << static_cast<int>(model);
            EXPECT_TRUE(std::ranges::any_of(halves, isAboveZero)) << static_cast<int>(model);
        }
}

}  // namespace
}  // namespace hair::rendering
