#include <gmock/gmock.h>

#include "engine/transfer.h"

namespace engine {
namespace {

using testing::ElementsAre;

Pixels grey(std::uint32_t width, std::uint32_t height, const std::vector<std::uint8_t>& values) {
    Pixels pixels{width, height, {}};
    for (const std::uint8_t value : values)
        pixels.rgba.insert(pixels.rgba.end(), {value, value, value, value});
    return pixels;
}

TEST(TextureLevels, GoDownToOnePixel) {
    const auto levels = textureLevels(grey(5, 2, std::vector<std::uint8_t>(10, 7)), Texels::data);
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[1].width, 2u);
    EXPECT_EQ(levels[1].height, 1u);
    EXPECT_EQ(levels[2].width, 1u);
    for (const Pixels& level : levels)
        for (const std::uint8_t byte : level.rgba) EXPECT_EQ(byte, 7);
}

// Half of white's light is 188 of 255 in sRGB. Opacity is averaged linearly.
TEST(TextureLevels, AverageTheLightOfColours) {
    const auto levels = textureLevels(grey(2, 2, {0, 255, 255, 0}), Texels::display_color);
    EXPECT_THAT(levels[1].rgba, ElementsAre(188, 188, 188, 128));
}

TEST(TextureLevels, AverageDataAsTheyAre) {
    const auto levels = textureLevels(grey(2, 2, {10, 20, 30, 40}), Texels::data);
    EXPECT_THAT(levels[1].rgba, ElementsAre(25, 25, 25, 25));
}

TEST(TextureLevels, AverageAllPixels) {
    const auto levels = textureLevels(grey(6, 1, {0, 90, 180, 30, 60, 0}), Texels::data);
    EXPECT_EQ(levels[1].width, 3u);
    EXPECT_EQ(levels[1].rgba[0], 45);
    EXPECT_EQ(levels[1].rgba[4], 105);
    // Three pixels, 45, 105 and 30, become their mean.
    ASSERT_EQ(levels[2].width, 1u);
    EXPECT_EQ(levels[2].rgba[0], 60);
}

TEST(TextureLevels, SplitThePixelInTheMiddleOfAnOddSide) {
    // Five pixels become two and share the third: (10 + 20 + 30/2) / 2.5 and (30/2 + 40 + 50) /
    // 2.5.
    const auto levels = textureLevels(grey(5, 1, {10, 20, 30, 40, 50}), Texels::data);
    EXPECT_EQ(levels[1].rgba[0], 18);
    EXPECT_EQ(levels[1].rgba[4], 42);
}

}  // namespace
}  // namespace engine
