#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

namespace hair::rendering {
namespace {

class PictureTest : public GpuTest {
protected:
    static Settings square(std::uint32_t pixels) {
        Settings settings = thesisAtRest();
        settings.render.width = pixels;
        settings.render.height = pixels;
        return settings;
    }
};

TEST_F(PictureTest, StrandsWithoutWidthAreNotDrawn) {
    Settings settings = square(200);
    settings.strands.root_width = 0.0f;
    settings.strands.tip_width = 0.0f;
    settings.render.head = false;
    const Pixels pixels = drawCase(device(), settings);
    // The background, 0.25, 0.15 and 0.18 of 255.
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
        ASSERT_EQ(pixels[i], 64);
        ASSERT_EQ(pixels[i + 1], 38);
        ASSERT_EQ(pixels[i + 2], 46);
        ASSERT_EQ(pixels[i + 3], 255);
    }
}

TEST_F(PictureTest, SampleCountsTheDeviceLacksAreUnsupported) {
    if (device().supportsSamples(8)) GTEST_SKIP() << "the device has 8 samples";
    Settings settings = square(16);
    settings.render.msaa = 8;
    EXPECT_THROW(drawCase(device(), settings), engine::Unsupported);
}

// A square of 0.4 m in the plane z = 0 that faces the camera.
groom::Mesh screen() {
    return {
        .positions =
            {{-0.2f, -0.2f, 0.0f}, {0.2f, -0.2f, 0.0f}, {0.2f, 0.2f, 0.0f}, {-0.2f, 0.2f, 0.0f}},
        .normals = std::vector<glm::vec3>(4, {0.0f, 0.0f, 1.0f}),
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .triangle_materials = {0, 0},
        .materials = {{.name = "wall"}}};
}

// A tuft at this depth, small enough that the wall covers it from the camera at z = 0.5.
groom::Groom tuft(float z) {
    const auto guide = [&](float x, float y) {
        return std::vector<glm::vec3>{{x, y, z}, {x, y + 0.03f, z}, {x + 0.02f, y + 0.06f, z}};
    };
    return oneTriangle({guide(-0.05f, -0.05f), guide(0.05f, -0.05f), guide(0.0f, 0.05f)});
}

TEST_F(PictureTest, HairIsHiddenBehindAMeshAndSeenBeforeIt) {
    Settings settings = square(200);
    const groom::Mesh mesh = screen();
    Settings bald = settings;
    bald.strands.root_width = 0.0f;
    bald.strands.tip_width = 0.0f;
    const Pixels wall_alone = drawGroom(device(), bald, tuft(0.1f), &mesh);
    const Pixels empty = drawGroom(device(), bald, tuft(0.1f), nullptr);

    EXPECT_EQ(differingPixels(drawGroom(device(), settings, tuft(-0.1f), &mesh), wall_alone), 0u);

    // Hair before the wall covers the same pixels with the same colours as hair without a wall.
    const Pixels hair = drawGroom(device(), settings, tuft(0.1f), nullptr);
    const Pixels both = drawGroom(device(), settings, tuft(0.1f), &mesh);
    std::size_t covered = 0;
    for (std::size_t i = 0; i < hair.size(); i += 4) {
        const bool is_hair = !std::equal(&hair[i], &hair[i] + 4, &empty[i]);
        covered += is_hair;
        const Pixels& expected = is_hair ? hair : wall_alone;
        ASSERT_TRUE(std::equal(&both[i], &both[i] + 4, &expected[i])) << "pixel " << i / 4;
    }
    // 64 strands about 0.06 m long and on average 1.25 mm wide, at 200 px / (0.8 m tan 50 degrees)
    // = 210 px/m: 212 px without overlap; a third of that shows that hair was there.
    EXPECT_GT(covered, 70u);
}

// Each pixel has its own depth. If hair passes through the wall, its nearer half is seen.
TEST_F(PictureTest, HairThroughAMeshIsCutByIt) {
    groom::Groom groom = tuft(0.0f);
    for (glm::vec3& point : groom.points) point.z = point.x;  // half before, half behind the wall
    Settings settings = square(200);
    Settings bald = settings;
    bald.strands.root_width = 0.0f;
    bald.strands.tip_width = 0.0f;
    const groom::Mesh mesh = screen();
    const Pixels both = drawGroom(device(), settings, groom, &mesh);
    const Pixels wall_alone = drawGroom(device(), bald, groom, &mesh);
    std::size_t left = 0;
    std::size_t right = 0;
    for (std::size_t i = 0; i < both.size(); i += 4) {
        if (std::equal(&both[i], &both[i] + 4, &wall_alone[i])) continue;
        const std::size_t column = i / 4 % 200;
        ++(column < 99 ? left : right);  // one column less, for the width of a strand on the border
    }
    EXPECT_EQ(left, 0u);
    EXPECT_GT(right, 50u);
}

// Crosses of strands that face a camera 20 m away, [cross][pixel]: one strand is upright and one
// level, and one is 1 mm nearer. Strands have the colours of their tangents, (0, 1, 0) and (1, 0,
// 0): all green or all red. A step of depth that grows from the near plane would be 2.4 mm there,
// and the strand that is drawn first would be seen of two at the same depth.
TEST_F(PictureTest, StrandsAMillimetreApartAt20MAreInOrder) {
    constexpr int kCrosses = 16;
    constexpr std::uint32_t kPitch = 16;  // px
    Settings settings = square(4 * kPitch);
    settings.render.width = kCrosses * kPitch;
    settings.render.show = Show::tangents;
    settings.render.head = false;
    settings.camera.position = {0.0f, 0.0f, 20.0f};
    settings.camera.field_of_view = 1.0f;
    settings.strands.density = 1;
    settings.strands.tessellation = 2;
    const float pixel = 2.0f * 20.0f * std::tan(0.5f * 0.0174533f) / (4 * kPitch);  // 5.5 mm
    settings.strands.root_width = settings.strands.tip_width = 4.0f * pixel;

    groom::Groom groom{.strand_count = 0, .vertices_per_strand = 3};
    const auto add = [&](const glm::vec3& middle, const glm::vec3& direction) {
        const std::uint32_t first = groom.strand_count;
        groom.root_triangles.push_back({first, first + 1, first + 2});
        groom.strand_count += 3;
        for (int guide = 0; guide < 3; ++guide)
            for (const float along : {-6.0f, 0.0f, 6.0f})
                groom.points.push_back(middle + along * pixel * direction);
    };
    const auto upright_is_nearer = [](int cross) { return cross / 2 % 2 == 0; };
    for (int i = 0; i < kCrosses; ++i) {
        // The distances lie at different fractions of a coarse step.
        const glm::vec3 nearer(
            (static_cast<float>(i) + 0.5f - 0.5f * kCrosses) * kPitch * pixel, 0.0f,
            -0.0004f * static_cast<float>(i));
        const glm::vec3 farther = nearer - glm::vec3(0.0f, 0.0f, 0.001f);
        const glm::vec3 x(1, 0, 0), y(0, 1, 0);
        const bool first_is_nearer = i % 2 == 0;
        for (const bool is_nearer : {first_is_nearer, !first_is_nearer})
            add(is_nearer ? nearer : farther, is_nearer == upright_is_nearer(i) ? y : x);
    }
    const Pixels pixels = drawGroom(device(), settings, groom, nullptr);
    for (int i = 0; i < kCrosses; ++i)
        for (const std::uint32_t row : {2 * kPitch - 1, 2 * kPitch})
            for (const std::uint32_t side : {kPitch / 2 - 1, kPitch / 2}) {
                const std::size_t column = static_cast<std::uint32_t>(i) * kPitch + side;
                const std::uint8_t* pixel_at =
                    &pixels.at(4 * (row * settings.render.width + column));
                EXPECT_NEAR(pixel_at[0], upright_is_nearer(i) ? 127.5 : 255.0, 1.0) << i;
                EXPECT_NEAR(pixel_at[1], upright_is_nearer(i) ? 255.0 : 127.5, 1.0) << i;
            }
}

// A straight strand of this width that faces the camera and is longer than the picture is high, on
// black. It has the colour of its tangent, (0, 1, 0): all of green. 64 px are 0.1 m there.
Pixels drawStraightStrand(const engine::Device& device, double pixels, Settings settings = {}) {
    settings.camera.position = {0.0f, 0.0f, 0.05f};
    settings.camera.field_of_view = 90.0f;
    settings.render.width = 64;
    settings.render.height = 64;
    settings.render.background = glm::vec3(0.0f);
    settings.render.show = Show::tangents;
    settings.strands.density = 1;
    settings.strands.tessellation = 2;
    settings.strands.root_width = static_cast<float>(pixels * 0.1 / 64.0);
    settings.strands.tip_width = settings.strands.root_width;
    const groom::Groom groom = oneTriangle(
        std::vector<glm::vec3>{{0.0f, -0.3f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.0f}});
    return drawGroom(device, settings, groom, nullptr);
}

int greenOf(const Pixels& pixels, std::size_t row, std::size_t column) {
    return pixels.at(4 * (64 * row + column) + 1);
}

// An even number of pixels, half of them on either side of the picture's middle: edges are half a
// pixel away from sample positions.
TEST_F(PictureTest, QuadsAreAsWideAsTheirStrands) {
    for (const Backend backend : {Backend::tessellation, Backend::pulling_geometry})
        for (const std::size_t width : {2u, 8u, 20u}) {
            const Pixels pixels = drawStraightStrand(
                device(), static_cast<double>(width), {.strands = {.backend = backend}});
            for (std::size_t row = 0; row < 64; ++row)
                for (std::size_t column = 0; column < 64; ++column) {
                    const bool is_hair = column >= 32 - width / 2 && column < 32 + width / 2;
                    ASSERT_NEAR(greenOf(pixels, row, column), is_hair ? 255 : 0, 1)
                        << width << " px, row " << row << ", column " << column;
                }
        }
}

// A cylinder's normal towards the eye is sqrt(1 - a^2) at a place `a` across it, -1 to 1, with the
// mean pi / 4. With several samples per pixel, the pixel's centre may lie outside a strand, and
// must not be the place that is shaded: that would be 4 % too little at 3.3 px, and more for
// thinner strands. A fragment is shaded once, at the mean place of its samples. The normal is
// concave, so this is too much, by 3 % at 0.7 px. The strand leans, so that samples lie everywhere
// across it: 1 % is twice the error of the mean of width x 256 equidistant places.
TEST_F(PictureTest, TheMeanNormalOfAStrandIsTheSameForAllSampleCounts) {
    constexpr std::uint32_t kRows = 256, kColumns = 64;
    const float pixel = 2.0f * 20.0f * std::tan(0.5f * 0.0174533f) / kRows;  // m, at 20 m
    Settings settings;
    settings.camera.position = {0.0f, 0.0f, 20.0f};
    settings.camera.field_of_view = 1.0f;
    settings.render.width = kColumns;
    settings.render.height = kRows;
    settings.render.head = false;
    settings.render.background = glm::vec3(0.0f);
    settings.render.show = Show::normals;
    settings.strands.density = 1;
    settings.strands.tessellation = 2;
    const glm::vec3 end(0.1618f * 160.0f * pixel, 160.0f * pixel, 0.0f);
    const groom::Groom strand = oneTriangle(std::vector<glm::vec3>{-end, glm::vec3(0.0f), end});
    for (const Backend backend : {Backend::tessellation, Backend::pulling, Backend::expanded})
        for (const std::uint32_t samples : {1u, 2u, 4u, 8u})
            for (const float width : {0.7f, 1.6f, 3.3f}) {
                if (!device().supportsSamples(samples)) continue;
                settings.strands.backend = backend;
                settings.render.msaa = samples;
                settings.strands.root_width = settings.strands.tip_width = width * pixel;
                const Pixels pixels = drawGroom(device(), settings, strand, nullptr);
                // Colours are 0.5 + 0.5 of the normal's components. The one along the picture's
                // rows has the mean 0, so that green tells the part that is covered.
                double green = 0.0, blue = 0.0;
                for (std::size_t i = 0; i < pixels.size(); i += 4) {
                    green += pixels[i + 1];
                    blue += pixels[i + 2];
                }
                EXPECT_NEAR(green / 127.5, width * kRows, 0.05 * width * kRows);
                const double ratio = (blue / green - 1.0) / 0.785398;
                const auto which = [&] {
                    return std::to_string(samples) + " samples, " + std::to_string(width) +
                           " px, back end " + std::to_string(static_cast<int>(backend));
                };
                EXPECT_GT(ratio, 0.99) << which();
                EXPECT_LT(ratio, samples == 1 ? 1.01 : 1.03) << which();
            }
}

// Samples of a pixel lie at distinct places across it, at the middles of equal parts (four of
// Vulkan's standard ones at 1/8, 3/8, 5/8 and 7/8), so an edge between two parts leaves exactly the
// part of the pixel that it cuts off. The mean is one of display colours, or of linear light if
// there is a tone map.
TEST_F(PictureTest, APixelIsTheMeanOfItsSamples) {
    struct Row {
        std::uint32_t msaa;
        std::uint32_t ssaa;
    };
    for (const Row& row : {Row{1, 2}, {1, 4}, {4, 1}, {4, 2}})
        for (const ToneMap tone_map : {ToneMap::none, ToneMap::srgb}) {
            if (!device().supportsSamples(row.msaa)) continue;
            const std::uint32_t parts = row.msaa * row.ssaa;
            for (std::uint32_t covered = 1; covered < parts; ++covered) {
                const double part = static_cast<double>(covered) / parts;
                Settings settings;
                settings.render.msaa = row.msaa;
                settings.render.ssaa = row.ssaa;
                settings.render.tone_map = tone_map;
                const Pixels pixels = drawStraightStrand(device(), 2.0 * (5.0 + part), settings);
                // IEC 61966-2-1; no part here is below its straight piece.
                const double shown =
                    tone_map == ToneMap::none ? part : 1.055 * std::pow(part, 1.0 / 2.4) - 0.055;
                for (const std::size_t column : {26u, 37u})
                    EXPECT_NEAR(greenOf(pixels, 20, column), 255.0 * shown, 1.0)
                        << row.msaa << " x " << row.ssaa << "^2 samples, " << covered << " of "
                        << parts << " parts, column " << column;
                EXPECT_NEAR(greenOf(pixels, 20, 27), 255, 1);
                EXPECT_NEAR(greenOf(pixels, 20, 36), 255, 1);
                EXPECT_EQ(greenOf(pixels, 20, 25), 0);
                EXPECT_EQ(greenOf(pixels, 20, 38), 0);
            }
        }
}

}  // namespace
}  // namespace hair::rendering
