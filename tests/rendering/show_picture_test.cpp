#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"

// Tests pictures of /render/show and of the overlay of bodies.
namespace hair::rendering {
namespace {

class ShowPictureTest : public GpuTest {
protected:
    // Straight strands along +y before the camera, 5 mm wide.
    static Settings settings(Show show) {
        Settings settings;
        settings.strands = {
            .density = 12, .tessellation = 2, .root_width = 0.005f, .tip_width = 0.005f};
        settings.render.width = 128;
        settings.render.height = 128;
        settings.render.show = show;
        settings.camera.field_of_view = 40.0f;
        return settings;
    }

    static groom::Groom straight() {
        const auto guide = [](float x) {
            return std::vector<glm::vec3>{{x, -0.1f, 0}, {x, 0, 0}, {x, 0.1f, 0}};
        };
        return oneTriangle({guide(-0.1f), guide(0.0f), guide(0.1f)});
    }

    static Pixels draw(const Settings& settings) {
        return drawGroom(device(), settings, straight(), nullptr);
    }

    // Colours other than the background's.
    static std::set<std::array<int, 3>> colors(const Pixels& pixels) {
        std::set<std::array<int, 3>> found;
        for (std::size_t i = 0; i < pixels.size(); i += 4)
            found.insert({pixels[i], pixels[i + 1], pixels[i + 2]});
        found.erase({64, 38, 46});  // 0.25, 0.15 and 0.18 of 255
        return found;
    }
};

// (0, 1, 0) as 0.5 + 0.5 v is (127.5, 255, 127.5).
TEST_F(ShowPictureTest, TangentsAreDirectionsAsRgb) {
    const auto found = colors(draw(settings(Show::tangents)));
    ASSERT_FALSE(found.empty());
    for (const auto& [red, green, blue] : found) {
        EXPECT_NEAR(red, 127.5, 1.0);
        EXPECT_NEAR(green, 255, 1.0);
        EXPECT_NEAR(blue, 127.5, 1.0);
    }
}

// Normals of a strand along y are across it: no y, and towards the camera at +z.
TEST_F(ShowPictureTest, NormalsFaceTheCamera) {
    const auto found = colors(draw(settings(Show::normals)));
    ASSERT_GT(found.size(), 3u);  // they turn across the strand
    for (const auto& [red, green, blue] : found) {
        EXPECT_NEAR(green, 127.5, 1.5);
        // The camera sees the outermost strands 11 degrees from the side: cos 101 is -0.2.
        EXPECT_GT(blue, 127.5 * (1.0 - 0.2) - 1.0);
    }
}

TEST_F(ShowPictureTest, LevelsGoFromBlueToRed) {
    Settings shown = settings(Show::lod);
    const auto zero = colors(draw(shown));
    ASSERT_EQ(zero.size(), 1u);
    EXPECT_GT((*zero.begin())[2], (*zero.begin())[0] + 100);
    shown.lod.level = shown.lod.maximum_level;
    const auto most = colors(draw(shown));
    ASSERT_EQ(most.size(), 1u);
    EXPECT_GT((*most.begin())[0], (*most.begin())[2] + 100);
}

// Each strand has one colour of its own, in all back ends and levels. With this seed the strands,
// 3 px wide, are 7 px apart or more: they are in one plane, so if two overlapped, chance would
// decide which is
// seen.
TEST_F(ShowPictureTest, StrandsKeepColorsOfTheirOwn) {
    Settings shown = settings(Show::strands);
    shown.seed = 230;
    shown.render.width = shown.render.height = 512;
    shown.strands.root_width = shown.strands.tip_width = 0.002f;
    const Pixels all = draw(shown);
    const auto found = colors(all);
    EXPECT_EQ(found.size(), 12u);
    shown.lod.level = 1.0f;
    for (const auto& color : colors(draw(shown)))
        EXPECT_TRUE(found.contains(color)) << color[0] << ' ' << color[1] << ' ' << color[2];
    shown.lod.level = 0.0f;
    shown.strands.backend = Backend::pulling_geometry;
    EXPECT_EQ(differingPixels(draw(shown), all), 0u);
}

// Strands between guides have the colour of the first guide's group, strands of the groom that of
// their own, in all back ends. Without groups there is one colour.
TEST_F(ShowPictureTest, GroupsHaveColorsOfTheirOwn) {
    Settings shown = settings(Show::groups);
    EXPECT_EQ(colors(draw(shown)).size(), 1u);
    groom::Groom groom = straight();
    groom.guide_groups = {7, 2, 2};
    const auto of_guide = colors(drawGroom(device(), shown, groom, nullptr));
    EXPECT_EQ(of_guide.size(), 1u);
    groom.guide_groups = {2, 7, 7};
    const auto of_other = colors(drawGroom(device(), shown, groom, nullptr));
    EXPECT_EQ(of_other.size(), 1u);
    EXPECT_NE(of_guide, of_other);

    std::set<std::array<int, 3>> both = of_guide;
    both.insert(of_other.begin(), of_other.end());
    const auto expectBoth = [&](const char* what) {
        for (const Backend backend : {Backend::tessellation, Backend::pulling, Backend::expanded}) {
            shown.strands.backend = backend;
            EXPECT_EQ(colors(drawGroom(device(), shown, groom, nullptr)), both)
                << what << ", " << static_cast<int>(backend);
        }
    };
    groom.root_triangles = {{0, 1, 2}, {1, 2, 0}};
    expectBoth("two root triangles, with first guides of two groups");

    for (std::uint32_t i = 0; i < 3; ++i) groom.bindings.push_back({.guides = {i, i, i}});
    groom.groups = {2, 7, 2};
    shown.strands.source = StrandSource::groom;
    expectBoth("three strands, one on each guide, in two groups");
}

// The number of fragments of a pixel in a picture that counts them; -1 if its three colours
// match no number.
int countOf(const std::uint8_t* pixel) {
    // Green is full at 32, in steps of 8 of 255.
    const int count = static_cast<int>(std::lround(pixel[1] * 32.0 / 255.0));
    // Each fragment is rounded by up to half of a step of 255.
    const bool agrees = std::abs(pixel[0] - std::min(count * 255.0 / 8.0, 255.0)) <= 0.5 * count &&
                        std::abs(pixel[2] - count * 255.0 / 128.0) <= 0.5 * count;
    return agrees ? count : -1;
}

// The fragments have the area of the strands' quads: 12 of 5 mm by 0.2 m, where 512 px are 2 * 0.5
// m * tan 20 degrees. The edges' places on the grid of pixels are random: an error of 0.29 px in a
// width of 7 px for one strand, and less by the root of 12 in the mean of all: 1.2 %. The
// tolerance is three times that.
TEST_F(ShowPictureTest, DensityCountsAllStrands) {
    Settings shown = settings(Show::density);
    shown.render.width = shown.render.height = 512;
    const Pixels all = draw(shown);
    shown.render.show = Show::overdraw;
    const Pixels drawn = draw(shown);
    double sum = 0.0;
    int most = 0;
    for (std::size_t i = 0; i < all.size(); i += 4) {
        const int count = countOf(&all[i]);
        ASSERT_GE(count, 0) << "pixel " << i / 4;
        sum += count;
        most = std::max(most, count);
        // At least one of these is drawn, and no others.
        const int passed = countOf(&drawn[i]);
        ASSERT_GE(passed, count > 0 ? 1 : 0) << "pixel " << i / 4;
        ASSERT_LE(passed, count) << "pixel " << i / 4;
    }
    EXPECT_GT(most, 1);
    const double pixels_per_metre = 512.0 / (2.0 * 0.5 * std::tan(20.0 * 3.14159265358979 / 180.0));
    const double expected = 12 * 0.005 * 0.2 * pixels_per_metre * pixels_per_metre;
    EXPECT_NEAR(sum, expected, 0.036 * expected);
}

// White without shadows. With shadows of hair, light from the side reaches only the first strands;
// the others are darker, in grey.
TEST_F(ShowPictureTest, ShadowIsThePartOfTheLights) {
    Settings shown = settings(Show::shadow);
    const auto without = colors(draw(shown));
    EXPECT_EQ(without, (std::set<std::array<int, 3>>{{255, 255, 255}}));
    shown.shading.shadows.hair = HairShadows::deep_shadow;
    shown.shading.lights = {{.position = {5.0f, 0.0f, 0.01f}}};
    const auto found = colors(draw(shown));
    ASSERT_GT(found.size(), 1u);
    for (const auto& [red, green, blue] : found) {
        EXPECT_EQ(red, green);
        EXPECT_EQ(red, blue);
    }
    EXPECT_LT((*found.begin())[0], 200);
}

// Hair of the colour (1/2, 1/4, 1/8) in even light from everywhere. Absorption times a
// gives (2^-a, 2^-2a, 2^-3a).
class OwnColorTest : public ShowPictureTest {
protected:
    static Settings lit() {
        Settings lit = settings(Show::shading);
        lit.seed = 230;  // as above
        lit.render.width = lit.render.height = 512;
        lit.strands.root_width = lit.strands.tip_width = 0.002f;
        lit.shading.color = {0.5f, 0.25f, 0.125f};
        lit.shading.ambient = 1.0f;
        lit.shading.diffuse = lit.shading.specular = 0.0f;
        return lit;
    }

    // The a of each colour in the picture, in ascending order.
    static std::vector<double> absorptions(const Pixels& pixels) {
        std::vector<double> found;
        for (const auto& color : colors(pixels)) {
            const double a = -std::log2(color[0] / 255.0);
            // Half a step of 255, and the rounding of the colour itself, to half floats in some
            // back ends.
            EXPECT_NEAR(color[1], 255.0 * std::exp2(-2.0 * a), 1.6) << a;
            EXPECT_NEAR(color[2], 255.0 * std::exp2(-3.0 * a), 1.6) << a;
            found.push_back(a);
        }
        std::ranges::sort(found);
        return found;
    }
};

TEST_F(OwnColorTest, TipsAbsorbLess) {
    Settings lit = OwnColorTest::lit();
    lit.shading.tip_lightening = 0.5f;
    const std::vector<double> found = absorptions(draw(lit));
    ASSERT_GT(found.size(), 20u);
    EXPECT_NEAR(found.front(), 0.5, 0.02);  // one pixel in a hundred, and a step of colour
    EXPECT_NEAR(found.back(), 1.0, 0.02);
}

// As many colours as strands, within the bound and on either side of the hair's colour, and equal
// in all back ends.
TEST_F(OwnColorTest, StrandsDiffer) {
    Settings lit = OwnColorTest::lit();
    lit.shading.strand_variation = 0.4f;
    const Pixels all = draw(lit);
    const std::vector<double> found = absorptions(all);
    EXPECT_GE(found.size(), 10u);  // two may be the same to a step of colour
    EXPECT_LE(found.size(), 12u);
    EXPECT_GE(found.front(), 0.6 - 0.02);
    EXPECT_LE(found.back(), 1.4 + 0.02);
    EXPECT_LT(found.front(), 0.9);
    EXPECT_GT(found.back(), 1.1);
    for (const Backend backend :
         {Backend::tessellation, Backend::pulling_geometry, Backend::pulling, Backend::expanded,
          Backend::software}) {
        lit.strands.backend = backend;
        EXPECT_EQ(differingPixels(draw(lit), all), 0u) << backendName(backend);
    }
}

// The power a of a strand is evenly distributed over 1 - v to 1 + v. So its mean is 1, its variance
// v^2 / 3, and the mean of c^a is c sinh(v l) / (v l) with l = -ln c: hair with variation is a
// little lighter than its colour. Tolerances are four standard errors of as many strands as are
// seen.
TEST_F(OwnColorTest, PowersAreEvenlyDistributed) {
    constexpr double kVariation = 0.8;
    Settings lit = OwnColorTest::lit();
    lit.shading.strand_variation = static_cast<float>(kVariation);
    lit.strands.density = 4096;
    lit.strands.root_width = lit.strands.tip_width = 0.0001f;
    lit.camera.field_of_view = 1.1f;  // 0.15 m from side to side
    lit.render.width = 1024;
    lit.render.height = 64;
    const Pixels pixels = draw(lit);
    double strands = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    std::array<double, 3> colors{};
    const std::size_t row = std::size_t{4} * lit.render.width * (lit.render.height / 2);
    for (std::size_t i = row + 4; i < row + std::size_t{4} * lit.render.width; i += 4) {
        if (std::equal(&pixels[i], &pixels[i] + 3, &pixels[i - 4])) continue;  // the same strand
        if (pixels[i] == 64 && pixels[i + 1] == 38) continue;  // the background
        const double a = -std::log2(pixels[i] / 255.0);
        ++strands;
        sum += a;
        squares += a * a;
        for (std::size_t c = 0; c < 3; ++c) colors[c] += pixels[i + c] / 255.0;
    }
    ASSERT_GT(strands, 300.0);
    const double variance = kVariation * kVariation / 3.0;
    const double mean = sum / strands;
    EXPECT_NEAR(mean, 1.0, 4.0 * std::sqrt(variance / strands));
    // The fourth moment of an even distribution is 9/5 of the variance squared.
    EXPECT_NEAR(
        squares / strands - mean * mean, variance, 4.0 * variance * std::sqrt(0.8 / strands));
    for (std::size_t c = 0; c < 3; ++c) {
        const double log = std::numbers::ln2 * static_cast<double>(c + 1);
        const auto moment = [&](double power) {  // of the colour
            const double of = kVariation * power * log;
            return std::exp(-power * log) * std::sinh(of) / of;
        };
        const double error = std::sqrt((moment(2.0) - moment(1.0) * moment(1.0)) / strands);
        EXPECT_NEAR(colors[c] / strands, moment(1.0), 4.0 * error) << c;
        EXPECT_GT(moment(1.0) - std::exp(-log), c == 0 ? 0.0 : 4.0 * error) << c;  // it is seen
    }
}

// A sphere of 0.05 m behind the strands: no line is farther than that from its middle, and the
// hair hides none of the lines.
TEST_F(ShowPictureTest, BodiesAreSeenThroughHair) {
    Settings shown = settings(Show::shading);
    const Pixels without = draw(shown);
    shown.simulation.colliders = {{.a = {0, 0, -0.1f}, .b = {0, 0, -0.1f}, .radius = 0.05f}};
    shown.render.overlays.bodies = true;
    const Pixels with = draw(shown);
    Settings bald = shown;
    bald.strands.root_width = 0.0f;
    bald.strands.tip_width = 0.0f;
    const Pixels alone = draw(bald);
    bald.render.overlays.bodies = false;
    const Pixels empty = draw(bald);
    // A circle of 94 px and two lines of 30 px, 0.5 px wide, cover 77 px, or half of that in the
    // worst case.
    EXPECT_GT(differingPixels(alone, empty), 38u);
    for (std::size_t i = 0; i < with.size(); i += 4) {
        const bool wire = !std::equal(&alone[i], &alone[i] + 3, &empty[i]);
        const Pixels& expected = wire ? alone : without;
        ASSERT_TRUE(std::equal(&with[i], &with[i] + 3, &expected[i])) << "pixel " << i / 4;
        if (!wire) continue;
        // 64 px are 0.6 m tan 20 degrees = 0.218 m at the sphere; its outline is 15 px out.
        const double x = static_cast<double>(i / 4 % 128) - 63.5;
        const double y = static_cast<double>(i / 4 / 128) - 63.5;
        ASSERT_LT(std::hypot(x, y), 64.0 * 0.05 / 0.218 + 2.0);
    }
}

}  // namespace
}  // namespace hair::rendering
