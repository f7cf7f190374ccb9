// Linear light to display colours: tests post/develop.comp by the pictures of targets with given
// pixels.
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/transfer.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/renderer.h"
#include "tests/gpu_fixture.h"

namespace hair::rendering {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Half precision keeps 11 bits of a number.
constexpr double kHalf = 1.0 / 2048.0;
// A display colour of 8 bits is off by half a step; half-precision light moves it by less than
// another half.
constexpr double kStep = 1.0 / 255.0;

class ToneMapTest : public GpuTest {
protected:
    struct Developed {
        std::vector<glm::dvec3> display;
        std::vector<glm::dvec3> light;
    };

    // A picture of one row; its rendered pixels have these colours, row by row of its SSAA.
    static Developed develop(const RenderSettings& render, const std::vector<glm::vec3>& rendered) {
        const engine::TargetDescription description = targetDescription(render);
        const engine::Target target(device(), description);
        const ResolvePass resolve(device(), render, description);
        const std::uint32_t columns = render.width * render.ssaa;
        runOnce(device(), [&](engine::Commands& commands) {
            target.beginRendering(commands, engine::Load::clear, {});
            for (std::uint32_t i = 0; i < rendered.size(); ++i)
                paint(
                    commands,
                    {static_cast<std::int32_t>(i % columns),
                     static_cast<std::int32_t>(i / columns)},
                    rendered[i]);
            target.endRendering(commands);
            resolve.record(commands, target);
        });
        Developed result;
        const std::vector<std::uint8_t> pixels = engine::readOutput(device(), target);
        const std::vector<float> light = engine::readRadiance(device(), target);
        for (std::size_t i = 0; i < pixels.size() / 4; ++i) {
            result.display.push_back(
                glm::dvec3(pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2]) / 255.0);
            result.light.emplace_back(light[3 * i], light[3 * i + 1], light[3 * i + 2]);
            EXPECT_EQ(pixels[4 * i + 3], 255);
        }
        return result;
    }

    static Developed develop(ToneMap map, const std::vector<glm::vec3>& light, float exposure = 0) {
        RenderSettings render;
        render.width = static_cast<std::uint32_t>(light.size());
        render.height = 1;
        render.tone_map = map;
        render.exposure = exposure;
        return develop(render, light);
    }

private:
    static void paint(engine::Commands& commands, VkOffset2D at, const glm::vec3& color) {
        const VkClearAttachment clear{
            VK_IMAGE_ASPECT_COLOR_BIT, 0, {.color = {.float32 = {color.r, color.g, color.b, 1}}}};
        const VkClearRect place{{at, {1, 1}}, 0, 1};
        vkCmdClearAttachments(commands.get(), 1, &clear, 1, &place);
    }
};

struct Mapped {
    glm::vec3 light;
    glm::dvec3 display;
};

constexpr std::array kMaps{ToneMap::srgb, ToneMap::aces, ToneMap::agx};

void expectNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(value[i], expected[i], tolerance);
}

std::vector<glm::vec3> lightOf(std::span<const Mapped> table) {
    std::vector<glm::vec3> light;
    for (const Mapped& each : table) light.push_back(each.light);
    return light;
}

// IEC 61966-2-1: 12.92 x up to 0.0031308, then 1.055 x^(1/2.4) - 0.055.
TEST_F(ToneMapTest, SrgbIsTheStandardsCurveAndClips) {
    const std::array<Mapped, 3> table{
        {{{0.0f, 0.002f, 0.0031308f}, {0.0, 0.02584, 0.04045}},
         {{0.18f, 0.5f, 0.2140411f}, {0.46136, 0.73536, 0.5}},
         {{1.0f, 1.5f, 20.0f}, {1, 1, 1}}}};
    const Developed developed = develop(ToneMap::srgb, lightOf(table));
    for (std::size_t i = 0; i < table.size(); ++i)
        expectNear(developed.display[i], table[i].display, kStep);
}

// The sRGB output transform of ACES 1.0 itself, as OpenColorIO 2.5 and later build it in
// ("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0"). The fit is of greys (0.18 becomes a
// tenth of the display's white); it leaves out the transform's glow and darker reds.
TEST_F(ToneMapTest, AcesIsNearTheAcademysTransform) {
    const std::array<Mapped, 10> table{
        {{{0.02f, 0.02f, 0.02f}, {0.0412, 0.0412, 0.0412}},
         {{0.18f, 0.18f, 0.18f}, {0.3560, 0.3560, 0.3560}},
         {{1.0f, 1.0f, 1.0f}, {0.8120, 0.8120, 0.8120}},
         {{4.0f, 4.0f, 4.0f}, {0.9553, 0.9553, 0.9553}},
         {{16.0f, 16.0f, 16.0f}, {0.9997, 0.9997, 0.9997}},
         {{0.5f, 0.2f, 0.1f}, {0.6234, 0.3941, 0.2512}},
         {{0.1f, 0.3f, 0.6f}, {0.2441, 0.4955, 0.6891}},
         {{2.0f, 0.5f, 0.2f}, {0.9375, 0.6880, 0.4595}},
         {{0.05f, 0.5f, 0.05f}, {0.1474, 0.6423, 0.1741}},
         {{0.8f, 0.05f, 0.05f}, {0.7354, 0.1498, 0.1561}}}};
    const Developed developed = develop(ToneMap::aces, lightOf(table));
    for (std::size_t i = 0; i < table.size(); ++i) {
        const bool grey = table[i].light == glm::vec3(table[i].light.r);
        expectNear(developed.display[i], table[i].display, grey ? 0.005 + kStep : 0.05);
    }
}

// The published polynomial for AgX's curve (Wrensch 2023, Minimal AgX Implementation) in the way
// that Filament and three.js use it; its stated mean square error is 3.7e-6, which is 0.002; the
// matrices may enlarge it up to four times.
TEST_F(ToneMapTest, AgxIsNearThePublishedFit) {
    const std::array<Mapped, 10> table{
        {{{0.02f, 0.02f, 0.02f}, {0.1439, 0.1439, 0.1439}},
         {{0.18f, 0.18f, 0.18f}, {0.5005, 0.5005, 0.5005}},
         {{1.0f, 1.0f, 1.0f}, {0.7919, 0.7919, 0.7918}},
         {{4.0f, 4.0f, 4.0f}, {0.9362, 0.9362, 0.9361}},
         {{16.0f, 16.0f, 16.0f}, {0.9979, 0.9978, 0.9978}},
         {{0.5f, 0.2f, 0.1f}, {0.6954, 0.5239, 0.4246}},
         {{0.1f, 0.3f, 0.6f}, {0.4491, 0.6115, 0.7279}},
         {{2.0f, 0.5f, 0.2f}, {0.9118, 0.7063, 0.5997}},
         {{0.05f, 0.5f, 0.05f}, {0.4324, 0.6743, 0.3643}},
         {{0.8f, 0.05f, 0.05f}, {0.8115, 0.4015, 0.3623}}}};
    const Developed developed = develop(ToneMap::agx, lightOf(table));
    for (std::size_t i = 0; i < table.size(); ++i)
        expectNear(developed.display[i], table[i].display, 0.008 + kStep / 2);
}

// Sobotka's curve goes through (10 / 16.5, 0.5) by its definition, and 0.5^2.2 = 0.21764 of linear
// light is 0.50384 on sRGB's curve; it ends at 0 and 1, ten stops below the grey and 6.5 above.
TEST_F(ToneMapTest, AgxKeepsItsPivotAndItsEnds) {
    const float black = 0.18f * 0x1p-10f;
    const float white = 0.18f * 90.6f;  // 2^6.5 = 90.51
    const Developed developed =
        develop(ToneMap::agx, {glm::vec3(0.18f), glm::vec3(black), glm::vec3(0), glm::vec3(white)});
    expectNear(developed.display[0], glm::dvec3(0.50384), kStep);
    expectNear(developed.display[1], glm::dvec3(0), kStep);
    expectNear(developed.display[2], glm::dvec3(0), 0);
    expectNear(developed.display[3], glm::dvec3(1), kStep);
}

TEST_F(ToneMapTest, BrighterLightIsNeverDarkerAndEndsWhite) {
    std::vector<glm::vec3> ramp{glm::vec3(0)};
    for (int i = 0; i < 128; ++i) ramp.emplace_back(std::exp2(-12.0f + 28.0f / 128 * i));
    for (const ToneMap map : kMaps) {
        const Developed developed = develop(map, ramp);
        EXPECT_EQ(developed.display.front(), glm::dvec3(0));
        EXPECT_EQ(developed.display.back(), glm::dvec3(1));
        for (std::size_t i = 1; i < ramp.size(); ++i)
            EXPECT_GE(developed.display[i].g, developed.display[i - 1].g);
    }
}

TEST_F(ToneMapTest, AStopOfExposureIsTwiceTheLight) {
    const std::vector<glm::vec3> light{{0.25f, 0.0625f, 0.5f}, {0.125f, 1.0f, 0.03125f}};
    std::vector<glm::vec3> twice;
    for (const glm::vec3& each : light) twice.push_back(2.0f * each);
    for (const ToneMap map : kMaps) {
        const Developed exposed = develop(map, light, 1.0f);
        EXPECT_EQ(exposed.display, develop(map, twice).display);
        EXPECT_EQ(exposed.light[0], glm::dvec3(light[0]));  // exposure does not change it
    }
}

// NaN, below zero, infinite and over the largest half-precision number.
TEST_F(ToneMapTest, WhatLightCannotBeIsBlackOrBrightest) {
    const float nan = std::nanf("");
    for (const ToneMap map : kMaps) {
        const Developed developed =
            develop(map, {{nan, nan, nan}, {-1.0f, -0.25f, -kInfinity}, glm::vec3(kInfinity)});
        EXPECT_EQ(developed.light[0], glm::dvec3(0));
        EXPECT_EQ(developed.display[0], glm::dvec3(0));
        EXPECT_EQ(developed.light[1], glm::dvec3(0));
        EXPECT_EQ(developed.display[1], glm::dvec3(0));
        EXPECT_EQ(developed.light[2], glm::dvec3(65504));
        EXPECT_EQ(developed.display[2], glm::dvec3(1));
    }
}

// Averages come before the tone map: a pixel half in light of 1 and half in the dark shows 0.7354,
// not a half. There are two pixels side by side with SSAA 4, and each sample has a different light.
TEST_F(ToneMapTest, SupersamplesAreAveragedAsLight) {
    RenderSettings render;
    render.width = 2;
    render.height = 1;
    render.ssaa = 4;
    render.tone_map = ToneMap::srgb;
    std::vector<glm::vec3> rendered;
    glm::dvec3 sums[2]{};
    for (std::uint32_t i = 0; i < 32; ++i) {
        const std::uint32_t pixel = i % 8 / 4;
        // Whole multiples of 1/64: exact in half precision, and so is their sum.
        const glm::vec3 light(
            static_cast<float>(i) / 64, i % 2 == pixel ? 1.0f : 0.0f,
            static_cast<float>(31 - i) / 16);
        rendered.push_back(light);
        sums[pixel] += glm::dvec3(light);
    }
    const Developed developed = develop(render, rendered);
    for (int pixel = 0; pixel < 2; ++pixel) {
        expectNear(developed.light[pixel], sums[pixel] / 16.0, 1e-6);
        EXPECT_NEAR(developed.display[pixel].g, 0.73536, kStep);
    }
}

TEST_F(ToneMapTest, OneBadSampleDoesNotSpoilItsPixel) {
    RenderSettings render;
    render.width = 1;
    render.height = 1;
    render.ssaa = 2;
    render.tone_map = ToneMap::aces;
    const Developed developed =
        develop(render, {glm::vec3(1), glm::vec3(std::nanf("")), glm::vec3(0.5f), glm::vec3(-9)});
    expectNear(developed.light[0], glm::dvec3(1.5 / 4), kHalf);
}

}  // namespace
}  // namespace hair::rendering
