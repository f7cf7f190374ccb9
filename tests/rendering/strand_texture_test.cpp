#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/mesh_pictures.h"

// One wide strand runs from the picture's lower edge to the upper one and shows only its colour.
namespace hair::rendering {
namespace {

constexpr std::uint32_t kPictureSide = 40;

class StrandTextureTest : public GpuTest {
protected:
    static Settings wideStrand() {
        Settings settings = quadSettings(kPictureSide);
        settings.render.hair = true;
        settings.shading.specular = 0.0f;
        settings.shading.color = {1.0f, 1.0f, 1.0f};
        settings.strands.density = 1;
        settings.strands.root_width = settings.strands.tip_width = 0.5f;
        settings.strands.texture = "bands";
        return settings;
    }

    static Pixels draw(const Settings& settings, const engine::Pixels& texture) {
        std::vector<glm::vec3> guide;
        for (int i = 0; i <= 4; ++i)
            guide.emplace_back(0.0f, -0.5f + 0.25f * static_cast<float>(i), 0.0f);
        return drawScene(
            device(), settings, {.strand_texture = texture}, glm::mat4(1.0f), oneTriangle(guide));
    }

    // Two columns and four rows: red grows along the strand. Green is on the right of a strand that
    // hangs down, so it is on the left of this one.
    static engine::Pixels bands(std::uint8_t left_opacity = 255) {
        engine::Pixels pixels{2, 4, {}};
        for (int row = 0; row < 4; ++row) {
            const auto red = static_cast<std::uint8_t>(40 + 60 * row);
            pixels.rgba.insert(pixels.rgba.end(), {red, 0, 0, left_opacity, red, 255, 0, 255});
        }
        return pixels;
    }

    // Samples the middle of the texture's pixels, so that linear filtering gives each pixel alone.
    // The strand is half as wide as the picture.
    static Rgb shown(const Pixels& pixels, int column, int row) {
        const auto x = static_cast<std::uint32_t>(3 * kPictureSide / 4 - 5 - 10 * column);
        return at(pixels, kPictureSide, x, kPictureSide - 5 - 10 * static_cast<std::uint32_t>(row));
    }
};

TEST_F(StrandTextureTest, RunsFromRootToTip) {
    const Pixels pixels = draw(wideStrand(), bands());
    for (int row = 0; row < 4; ++row) {
        const Rgb left = shown(pixels, 0, row);
        const Rgb right = shown(pixels, 1, row);
        // A pixel's centre is up to half a pixel of ten off the middle: a twentieth of a step of 60
        // in red, and of 255 across.
        EXPECT_NEAR(left[0], 40 + 60 * row, 4) << row;
        EXPECT_NEAR(right[0], 40 + 60 * row, 4) << row;
        EXPECT_LT(left[1], 14);
        EXPECT_GT(right[1], 241);
    }
}

TEST_F(StrandTextureTest, IsDecodedWhereLightIsLinear) {
    Settings settings = wideStrand();
    settings.render.tone_map = ToneMap::srgb;
    const Pixels pixels = draw(settings, bands());
    for (int row = 0; row < 4; ++row)
        EXPECT_NEAR(shown(pixels, 0, row)[0], 40 + 60 * row, 5) << row;  // plus half floats
}

TEST_F(StrandTextureTest, HasHolesWhereItIsLessThanHalfOpaque) {
    const Pixels pixels = draw(wideStrand(), bands(100));
    EXPECT_EQ(shown(pixels, 0, 1), (Rgb{64, 38, 46}));
    EXPECT_GT(shown(pixels, 1, 1)[1], 241);
}

}  // namespace
}  // namespace hair::rendering
