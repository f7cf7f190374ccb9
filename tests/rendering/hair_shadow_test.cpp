#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "tests/gpu_fixture.h"
#include "tests/rendering/shadow_probe.h"

// Maps of strands with a known number before a point, drawn by the rasteriser and in compute.
namespace hair::rendering {
namespace {

// Parallel straight strands in planes perpendicular to z, all of one length, one strand every
// `pitch`.
struct Fans {
    std::vector<float> depths{0.0f};  // m, along -z from z = 0
    float pitch = 0.001f;             // m
    float angle = 0.0f;               // of the strands, to y, rad
    std::uint32_t segments = 2;       // of a strand
};

constexpr float kReach = 0.1f;  // m: fans are from -kReach to kReach across and along strands

groom::Groom fansOfStrands(const Fans& fans) {
    groom::Groom groom{.vertices_per_strand = fans.segments + 1};
    const glm::vec3 along(std::sin(fans.angle), std::cos(fans.angle), 0.0f);
    const glm::vec3 across(along.y, -along.x, 0.0f);
    const int half = static_cast<int>(kReach / fans.pitch);
    for (const float depth : fans.depths) {
        for (int i = -half; i <= half; ++i) {
            const glm::vec3 middle =
                static_cast<float>(i) * fans.pitch * across - glm::vec3(0.0f, 0.0f, depth);
            for (std::uint32_t v = 0; v <= fans.segments; ++v) {
                const float place =
                    2.0f * static_cast<float>(v) / static_cast<float>(fans.segments);
                groom.points.push_back(middle + (place - 1.0f) * kReach * along);
            }
            groom.root_triangles.push_back(
                {groom.strand_count, groom.strand_count, groom.strand_count});
            ++groom.strand_count;
        }
    }
    return groom;
}

// One light, which shines on the fans from +z.
Settings litFromAbove(float width, Backend backend) {
    Settings settings;
    settings.strands.backend = backend;
    settings.strands.density = 1;
    settings.strands.tessellation = 1;
    settings.strands.root_width = width;
    settings.strands.tip_width = width;
    settings.shading.lights = {
        {.type = LightType::directional, .direction = glm::vec3(0.0f, 0.0f, -1.0f)}};
    settings.shading.shadows.hair = HairShadows::deep_opacity;
    settings.shading.shadows.resolution = 128;
    return settings;
}

class HairShadowTest : public GpuTest, public testing::WithParamInterface<Backend> {
protected:
    static Settings litFromAbove(float width) { return rendering::litFromAbove(width, GetParam()); }
    // For deep shadow maps.
    static Settings litByRays(float width) {
        Settings settings = litFromAbove(width);
        settings.shading.shadows.hair = HairShadows::deep_shadow;
        settings.shading.shadows.resolution = 1024;
        settings.shading.shadows.layer_depth = 0.01f;
        settings.shading.shadows.softness = 0.0f;
        return settings;
    }
};

INSTANTIATE_TEST_SUITE_P(
    BackEnds, HairShadowTest, testing::Values(Backend::tessellation, Backend::software),
    [](const testing::TestParamInfo<Backend>& row) { return std::string(backendName(row.param)); });

// A grid in the plane z = -depth, well inside the fans.
std::vector<glm::vec3> plane(float depth, float reach = 0.5f * kReach) {
    std::vector<glm::vec3> points;
    constexpr int kSide = 40;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const auto place = [&](int i) {
                return reach * (2.0f * (static_cast<float>(i) + 0.5f) / kSide - 1.0f);
            };
            points.emplace_back(place(x), place(y), -depth);
        }
    }
    return points;
}

// Texels of a fan's map: 128 a side for a sphere about the roots' middle. The sphere is as wide as
// the fan and as high as the strands are long: at most hypot(0.1, 0.2) or 0.1 + 0.2 m.
constexpr float kTexel = 2.0f * (kReach + 2.0f * kReach) / 128.0f;

// A point behind k fans of coverage c has met k c strands. Layers of 0.01, 0.02, 0.04 and 0.08 m
// have one fan each, so their ends are behind one fan more. Between, the number is linear in depth
// (Yuksel and Keyser 2008, section 3), with the fan anywhere in the layer. It is off by c times
// the part of the layer before or behind the fan.
TEST_P(HairShadowTest, CountsTheFansBeforeAPoint) {
    const Fans fans{.depths = {0.0f, 0.02f, 0.05f, 0.11f}, .pitch = 0.0015f};
    constexpr float kWidth = 0.0004f;
    ASSERT_LT(fans.pitch, 0.5f * kTexel);  // the first fan, a texel wide, is in every texel
    const double c = kWidth / fans.pitch;
    const groom::Groom groom = fansOfStrands(fans);
    Settings settings = litFromAbove(kWidth);
    settings.shading.shadows.layer_depth = 0.01f;
    for (const LightType type : {LightType::directional, LightType::point, LightType::sphere}) {
        settings.shading.lights[0].type = type;
        settings.shading.lights[0].position = {0.0f, 0.0f, 2.0f};
        const DeviceHair hair(device(), groom, settings);
        struct Row {
            float depth;
            double fans;  // in front of it
            double tolerance;
        };
        // A texel is 3.1 pitches, so the number of strands in a column of texels varies by one;
        // the test averages 21 columns. The tolerance is that of coverage: 2 % of each fan
        // involved.
        constexpr std::array kRows{
            Row{-0.01f, 0.0, 0.0},   Row{0.0101f, 1.0, 0.02}, Row{0.0301f, 2.0, 0.04},
            Row{0.0701f, 3.0, 0.06}, Row{0.15f, 4.0, 0.08},   Row{0.16f, 4.0, 0.08},
            Row{0.005f, 0.5, 0.02},  Row{0.02f, 1.5, 0.04},   Row{0.06f, 2.75, 0.06}};
        std::vector<glm::vec3> points;
        for (const Row& row : kRows) {
            const std::vector<glm::vec3> there = plane(row.depth);
            points.insert(points.end(), there.begin(), there.end());
        }
        const std::vector<FoundPath> paths = findPaths(device(), settings, hair.view(), {}, points);
        const std::size_t each = paths.size() / kRows.size();
        for (std::size_t i = 0; i < kRows.size(); ++i) {
            const double found = meanStrands(std::span(paths).subspan(i * each, each));
            EXPECT_NEAR(found, kRows[i].fans * c, kRows[i].tolerance * c) << kRows[i].depth;
        }
    }
}

// The coverage is width / pitch for any width of the strands in texels.
TEST_P(HairShadowTest, ThinStrandsCoverTheirArea) {
    constexpr float kFine = 0.25f * kTexel;  // a texel in maps of 512 by 512
    // A pitch of 5.7 texels and an angle make strands lie at all places within texels. Points are
    // spread over 14 whole pitches.
    const Fans fans{.pitch = 5.7f * kFine, .angle = 0.3f};
    std::vector<glm::vec3> points = plane(0.0f, 7.0f * fans.pitch);
    for (glm::vec3& p : points) {
        p = {
            p.x * std::cos(fans.angle) + p.y * std::sin(fans.angle),
            p.y * std::cos(fans.angle) - p.x * std::sin(fans.angle), -0.05f};
    }
    const groom::Groom groom = fansOfStrands(fans);
    struct Row {
        float texels;
        std::uint32_t pieces;  // of 170 texels together
    };
    for (const auto& [texels, pieces] :
         {Row{0.1f, 1}, Row{0.3f, 1}, Row{0.7f, 1}, Row{1.0f, 1}, Row{1.3f, 1}, Row{2.0f, 1},
          Row{0.1f, 8}, Row{1.3f, 8}, Row{40.0f, 1}, Row{40.0f, 8}}) {
        Settings settings = litFromAbove(texels * kFine);
        settings.strands.tessellation = pieces;
        settings.shading.shadows.softness = 3.0f;
        settings.shading.shadows.layer_depth = 0.001f;
        settings.shading.shadows.resolution = 512;
        const DeviceHair hair(device(), groom, settings);
        const double covered = meanStrands(findPaths(device(), settings, hair.view(), {}, points));
        const double expected = texels / 5.7;
        EXPECT_NEAR(covered, expected, 0.02 * expected) << texels << ' ' << pieces;
    }
}

using LargePieceTest = GpuTest;

// More large pieces than compute has a list for, and than 256 of them a work group can draw on
// lavapipe, which ends an invocation's loops after 65,535 iterations: 53 strands of 1,280 pieces,
// each 1.1 texels long and 311 wide, so an invocation that has a row of each would need 80,000.
TEST_F(LargePieceTest, ManyCoverTheirArea) {
    const Fans fans{.pitch = 0.0038f, .segments = 20};
    constexpr std::uint32_t kPieces = 64;  // of a segment
    const groom::Groom groom = fansOfStrands(fans);
    ASSERT_GT(groom.strand_count * fans.segments * kPieces, gpu::kMostLargePieces);
    Settings settings = litFromAbove(12.0f * fans.pitch, Backend::software);
    settings.strands.tessellation = kPieces;
    settings.shading.shadows.resolution = 4096;
    const DeviceHair hair(device(), groom, settings);
    const std::vector<glm::vec3> points = plane(0.05f, 0.07f);
    const double met = meanStrands(findPaths(device(), settings, hair.view(), {}, points));
    EXPECT_NEAR(met, 12.0, 0.02 * 12.0);
}

// Light goes through strands at random as exp(-stopped n), n the mean number.
TEST_P(HairShadowTest, VisibilityIsThatOfRandomStrands) {
    const Fans fans{.depths = {0.0f}, .pitch = 0.0015f};
    Settings settings = litFromAbove(0.0006f);
    settings.shading.shadows.stopped = 0.7f;
    const DeviceHair hair(device(), fansOfStrands(fans), settings);
    const std::vector<FoundPath> paths =
        findPaths(device(), settings, hair.view(), {}, plane(0.2f));
    // Powers on the device are accurate to 3 + 2 |exponent| units of 2^-23, Vulkan's precision of
    // exp.
    for (const FoundPath& path : paths)
        ASSERT_NEAR(path.visibility, std::exp(-0.7 * path.strands), 1e-6);
}

TEST_P(HairShadowTest, OpacityCountsWhereItIsDrawn) {
    const Fans fans{.pitch = 0.0015f};
    Settings settings = litFromAbove(0.0006f);
    settings.strands.opacity = 0.25f;
    const DeviceHair hair(device(), fansOfStrands(fans), settings);
    const auto strands = [&] {
        return meanStrands(findPaths(device(), settings, hair.view(), {}, plane(0.2f)));
    };
    const double opaque = strands();
    settings.render.transparency = Transparency::weighted_blended;
    // A quarter is exact, but sums of 20 are rounded. In compute, the coverage of each strand is
    // rounded to 2^-16, and a texel has 3.1 strands.
    EXPECT_NEAR(strands(), 0.25 * opaque, 1e-5 + 3.1 * 1.25 * 0.5 / 65536);
}

// Hair, points and light turn and move together: the result changes only by rounding.
TEST_P(HairShadowTest, FollowsTheHead) {
    glm::mat4 head = glm::translate(glm::mat4(1.0f), {0.4f, -0.2f, 0.3f});
    head = glm::rotate(head, 2.0f, glm::normalize(glm::vec3(1.0f, -2.0f, 3.0f)));
    const groom::Groom groom = fansOfStrands({.pitch = 0.0015f});
    groom::Groom moved = groom;
    for (glm::vec3& point : moved.points) point = glm::vec3(head * glm::vec4(point, 1.0f));
    std::vector<glm::vec3> points = plane(0.2f);
    for (glm::vec3& point : points) point = glm::vec3(head * glm::vec4(point, 1.0f));

    Settings settings = litFromAbove(0.0006f);
    settings.shading.lights[0].direction =
        glm::vec3(head * glm::vec4(settings.shading.lights[0].direction, 0.0f));
    const DeviceHair still(device(), groom, settings);
    const DeviceHair turned(device(), moved, settings);
    StrandView view = still.view();
    view.guides = turned.view().guides;
    view.head = head;
    EXPECT_NEAR(meanStrands(findPaths(device(), settings, view, {}, points)), 0.4, 0.02 * 0.4);
}

// Each light has its part of the atlas; lights without shadows have none.
TEST_P(HairShadowTest, LightsDoNotDisturbEachOther) {
    const groom::Groom groom = fansOfStrands({.depths = {0.0f, 0.03f}, .pitch = 0.0015f});
    Settings settings = litFromAbove(0.0006f);
    settings.shading.lights = {
        {.type = LightType::directional, .direction = {0.3f, 0.0f, -1.0f}},
        {.position = {0.0f, 0.1f, 3.0f}, .shadows = false},
        {.position = {0.5f, 0.3f, 2.0f}},
        {.type = LightType::directional, .direction = {0.0f, -1.0f, -1.0f}}};
    const DeviceHair hair(device(), groom, settings);
    const std::vector<glm::vec3> points = plane(0.06f);
    for (const std::uint32_t light : {0u, 2u, 3u}) {
        Settings alone = settings;
        alone.shading.lights = {settings.shading.lights[light]};
        const auto among = findPaths(device(), settings, hair.view(), {}, points, light);
        const auto single = findPaths(device(), alone, hair.view(), {}, points);
        // The same triangles lie on the same grid of sub-pixels.
        for (std::size_t i = 0; i < points.size(); ++i)
            ASSERT_NEAR(among[i].strands, single[i].strands, 1e-4) << light;
        EXPECT_GT(meanStrands(single), 0.5);
    }
    for (const FoundPath& path : findPaths(device(), settings, hair.view(), {}, points, 1)) {
        ASSERT_EQ(path.strands, 0.0f);
        ASSERT_EQ(path.visibility, 1.0f);
    }
}

// A light among the hair casts shadows of the hair in front of it, and none of the hair behind it.
TEST_P(HairShadowTest, LightMayBeAmongTheHair) {
    const groom::Groom groom = fansOfStrands({.depths = {-0.1f, 0.0f, 0.1f}, .pitch = 0.0011f});
    Settings settings = litFromAbove(0.00044f);
    settings.shading.shadows.resolution = 512;
    settings.shading.lights = {{.position = {0.0f, -kReach, 0.05f}}};
    const DeviceHair hair(device(), groom, settings);
    // The light looks to the roots' middle, along -z.
    ASSERT_LT(glm::distance(hair.view().centre, {0.0f, -kReach, 0.0f}), 1e-6f);
    ASSERT_GT(hair.view().radius, kReach);
    const auto at = [&](float depth) {
        std::vector<glm::vec3> points = plane(depth, 0.03f);
        for (glm::vec3& point : points) point.y -= 0.07f;
        return meanStrands(findPaths(device(), settings, hair.view(), {}, points));
    };
    // Across x of up to 0.03 m at 0.1 m from the light, a ray sees a pitch that is narrower by its
    // cosine: 1 + 0.3^2 / 6 times as many strands on average. One strand in 55 is 2 %.
    EXPECT_NEAR(at(0.05f), (1 + 0.09 / 6) * 0.4, 0.02 * 0.4);
    EXPECT_EQ(at(-0.2f), 0.0);
}

using HairShadowPairTest = GpuTest;

TEST_F(HairShadowPairTest, BackEndsThrowTheSame) {
    const groom::Groom groom = tangledGroom(6);
    Settings settings = litFromAbove(0.002f, Backend::tessellation);
    settings.strands.density = 30;
    const DeviceHair hair(device(), groom, settings);
    const std::vector<glm::vec3> points = plane(0.1f, 0.2f);
    const auto tessellated = findPaths(device(), settings, hair.view(), {}, points);
    settings.strands.backend = Backend::pulling_geometry;
    const auto pulled = findPaths(device(), settings, hair.view(), {}, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_EQ(tessellated[i].strands, pulled[i].strands);
    EXPECT_GT(meanStrands(pulled), 0.0);
}

// ---- Deep shadow maps ---------------------------------------------------------------------------

double meanOf(std::span<const FoundPath> paths, float FoundPath::* value) {
    double sum = 0.0;
    for (const FoundPath& path : paths) sum += path.*value;
    return sum / static_cast<double>(paths.size());
}

// Fans of coverage c lie on top of each other, so a ray meets a strand of each fan or of none. Real
// light does the same, but deep opacity maps take c of each fan on every ray.
TEST_P(HairShadowTest, RaysMeetWholeStrands) {
    const Fans fans{.depths = {0.0f, 0.02f, 0.05f, 0.11f}, .pitch = 0.0015f, .angle = 0.3f};
    constexpr float kWidth = 0.0004f;
    const double c = kWidth / fans.pitch;
    const groom::Groom groom = fansOfStrands(fans);
    for (const std::uint32_t resolution : {512u, 1024u, 2048u}) {
        Settings settings = litByRays(kWidth);
        settings.shading.shadows.resolution = resolution;
        const DeviceHair hair(device(), groom, settings);
        const auto found = findPaths(device(), settings, hair.view(), {}, plane(0.15f, 0.03f));
        // There are at least 1,600 rays; the tolerance is four standard errors of a share c. Each
        // layer of the map ends behind one fan, so that counts are whole.
        const double error = 4 * std::sqrt(c * (1 - c) / 1600);
        EXPECT_NEAR(meanOf(found, &FoundPath::direct), 1 - c, error) << resolution;
        EXPECT_NEAR(meanOf(found, &FoundPath::strands), 4 * c, 4 * error) << resolution;
        for (const FoundPath& path : found) {
            if (path.direct < 0.99f) {
                ASSERT_NEAR(path.met, 4.0f, 1e-3f) << resolution;
            }
            // `stopped` halves the light four times.
            ASSERT_NEAR(path.visibility, path.direct + (1 - path.direct) / 16, 1e-4f);
        }
    }
}

// The part of the halved light that passes both ways: a_f exp(a_f - 1), as in LocalScattering.
const float kThereAndBack = 0.5f * std::exp(-0.5f);

// Points of strands one behind another, on rays that meet all of them.
TEST_P(HairShadowTest, RaysCountStrandsBeforeAndBehind) {
    constexpr float kWidth = 0.0008f;
    const Fans fans{.depths = {0.0f, 0.02f, 0.05f, 0.11f}, .pitch = 0.006f};
    const groom::Groom groom = fansOfStrands(fans);
    Settings settings = litByRays(kWidth);
    settings.shading.shadows.resolution = 4096;
    ASSERT_LT(kTexel / 32, 0.4f * kWidth);  // four texels round a strand's middle are on it
    const DeviceHair hair(device(), groom, settings);
    for (std::size_t fan = 0; fan < fans.depths.size(); ++fan) {
        std::vector<gpu::ShadowProbe> probes;
        for (int i = -5; i <= 5; ++i)
            for (int k = -20; k <= 20; ++k)
                probes.push_back(
                    {.position =
                         {static_cast<float>(i) * fans.pitch, 0.0017f * static_cast<float>(k),
                          -fans.depths[fan]},
                     .light = 0,
                     .normal = glm::vec3(0.0f),
                     .tangent = {0.0f, 1.0f, 0.0f},
                     .width = kWidth});
        const auto before = static_cast<float>(fan);
        const float behind = 3.0f - before;
        // Rounding of depths: a part of a layer of 10 mm or more.
        for (const FoundPath& path : findPaths(device(), settings, hair.view(), {}, probes)) {
            ASSERT_NEAR(path.direct, fan == 0 ? 1.0f : 0.0f, 1e-5f) << fan;
            ASSERT_NEAR(path.strands, before, 1e-3f) << fan;
            ASSERT_NEAR(path.ended, std::pow(kThereAndBack, behind), 1e-3f) << fan;
            ASSERT_EQ(path.returned, 0.0f) << fan;
        }
    }
}

// Light comes in at a cosine mu to a closed surface of strands. The kept part of the light that is
// scattered more than once is H(mu) H(0.7) - 1 over its value at 0.8; H(mu) = 1 + 2 mu.
TEST_P(HairShadowTest, KeepsLessOfGrazingLight) {
    constexpr float kWidth = 0.0008f;
    const Fans fans{.pitch = 0.0005f};
    const groom::Groom groom = fansOfStrands(fans);
    for (const float slope : {0.0f, 0.5f, 1.0f, 2.0f}) {
        for (const float turn : {0.0f, 0.8f, 1.57f}) {
            Settings settings = litByRays(kWidth);
            settings.shading.lights[0].direction =
                glm::normalize(glm::vec3(slope * std::sin(turn), -slope * std::cos(turn), -1.0f));
            const DeviceHair hair(device(), groom, settings);
            const double cosine = 1 / std::sqrt(1 + double{slope} * double{slope});
            const double expected = ((1 + 2 * cosine) * 2.4 - 1) / (2.6 * 2.4 - 1);
            // The first strand of a texel is one of two that are a pitch apart. Over 16 mm that is
            // 0.03 of slope along each axis; the cosine changes by at most 0.39 of a slope's.
            for (const FoundPath& path :
                 findPaths(device(), settings, hair.view(), {}, plane(0.001f)))
                ASSERT_NEAR(path.kept, expected, 0.02) << slope << ' ' << turn;
        }
    }
}

// At any angle to the light and any size of the map's texels, strands that stand alone are lit,
// and nothing is behind them.
TEST_P(HairShadowTest, NoStrandIsInItsOwnShadow) {
    const Fans fans{.pitch = 0.02f, .angle = 0.3f};
    const glm::vec3 along(std::sin(fans.angle), std::cos(fans.angle), 0.0f);
    const glm::vec3 across(along.y, -along.x, 0.0f);
    const groom::Groom groom = fansOfStrands(fans);
    for (const std::uint32_t resolution : {64u, 512u, 4096u}) {
        for (const float slope : {0.0f, 0.5f, 2.0f, 5.0f}) {
            Settings settings = litByRays(0.0004f);
            settings.shading.shadows.resolution = resolution;
            settings.shading.lights[0].direction = glm::normalize(glm::vec3(0.1f, -slope, -1.0f));
            const DeviceHair hair(device(), groom, settings);
            std::vector<gpu::ShadowProbe> probes;
            for (int i = -2; i <= 2; ++i) {
                for (int k = -50; k <= 50; ++k) {
                    const glm::vec3 middle = static_cast<float>(i) * fans.pitch * across;
                    probes.push_back(
                        {.position = middle + 0.0013f * static_cast<float>(k) * along,
                         .light = 0,
                         .normal = glm::vec3(0.0f),
                         .tangent = along,
                         .width = 0.0004f});
                }
            }
            // Texels of maps of 64 are wider than half of the gap between strands, so rays meet
            // the next one.
            if (resolution == 64 && slope > 0.0f) continue;
            for (const FoundPath& path : findPaths(device(), settings, hair.view(), {}, probes)) {
                ASSERT_NEAR(path.direct, 1.0f, 1e-5f) << resolution << ' ' << slope;
                ASSERT_GE(path.ended, 0.999f * kThereAndBack) << resolution << ' ' << slope;
            }
        }
    }
}

}  // namespace
}  // namespace hair::rendering
