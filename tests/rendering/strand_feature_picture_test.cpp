#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/flip_errors.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

// Features of strands beyond the thesis: every back end draws them alike and counts them correctly.
namespace hair::rendering {
namespace {

struct Feature {
    const char* name;
    StrandSettings strands;
    bool has_residuals = false;
};

const StrandCurlSettings kThinCurl{.radius = 0.01f, .frequency = 40.0f};
const StrandVariationSettings kVariation{.amplitude = 0.01f};

const Feature kFeatures[] = {
    {"curl", {.curl = kThinCurl}},
    {"variation", {.variation = kVariation}},
    {"offsets", {.offsets = "a model"}},
    {"widths", {.width = WidthSource::groom}},
    {"groom", {.source = StrandSource::groom}},
    {"residuals", {.source = StrandSource::groom}, true},
    {"single", {.interpolation = Interpolation::single}},
    {"mixed", {.interpolation = Interpolation::mixed}},
    {"collision_rule", {.collision_rule = true}},
    {"push_out", {.collision = StrandCollision::push_out}},
    {"thesis_randomness", {.randomness = Randomness::thesis}},
    {"catmull_rom", {.curve = Curve::catmull_rom}},
    {"taper_start", {.taper_start = 0.5f}},
    {"all",
     {.source = StrandSource::groom,
      .interpolation = Interpolation::mixed,
      .collision_rule = true,
      .width = WidthSource::groom,
      .curl = kThinCurl,
      .variation = kVariation,
      .offsets = "a model",
      .curve = Curve::catmull_rom},
     true},
};

// The bound strands have their own points, 5 to 12 each: spirals round their guides.
void addResiduals(groom::Groom& groom) {
    for (std::uint32_t i = 0; i < groom.bindings.size(); ++i) {
        const auto guide = groom.strand(groom.bindings[i].guides[0]);
        const std::uint32_t points = 5 + i % 8;
        for (std::uint32_t k = 0; k < points; ++k) {
            const float turn = 0.9f * static_cast<float>(k) + 0.7f * static_cast<float>(i);
            const glm::vec3 aside(0.01f * std::sin(turn), 0.0f, 0.01f * std::cos(turn));
            groom.bound_points.push_back(guide[k * 7 / (points - 1)] + aside);
        }
        groom.bound_ends.push_back(static_cast<std::uint32_t>(groom.bound_points.size()));
    }
}

groom::Groom groomWithAll(bool has_residuals = false) {
    groom::Groom groom = tangledGroom(8);
    for (std::size_t i = 0; i < groom.points.size(); ++i)
        groom.widths.push_back(1e-3f * static_cast<float>(1 + i * 7 % 5));
    for (std::uint32_t i = 0; i < 200; ++i) {
        const float weight = static_cast<float>(i) / 400.0f;
        groom.bindings.push_back(
            {.guides = {i % 6, (i + 1) % 6, (i + 2) % 6},
             .weights = {weight, 0.5f, 0.5f - weight},
             .offset = {0.01f * weight, -0.02f, 0.03f * weight}});
    }
    if (has_residuals) addResiduals(groom);
    return groom;
}

groom::StrandSet zigzag() {
    groom::StrandSet set{.ends = {20, 40}};
    for (int i = 0; i < 40; ++i)
        set.points.emplace_back(i % 2 == 0 ? 0.05f : 0.0f, 0.1f * static_cast<float>(i % 20), 0.0f);
    return set;
}

class StrandFeaturePictureTest : public GpuTest {
protected:
    static Settings small(StrandSettings strands) {
        strands.backend = Backend::tessellation;
        strands.density = 30;
        strands.tessellation = 5;
        return {
            .strands = strands,
            .camera = {.position = {0.0f, 0.05f, 0.6f}, .field_of_view = 60.0f},
            .render = {.width = 160, .height = 120}};
    }

    static Pixels draw(const Settings& settings, bool has_residuals) {
        const groom::StrandSet model = zigzag();
        return drawGroom(
            device(), settings, groomWithAll(has_residuals), nullptr,
            settings.strands.offsets.empty() ? nullptr : &model);
    }

    static void
    expectEqualPictures(const Pixels& tessellated, Settings settings, bool has_residuals) {
        settings.strands.submission = Submission::batched;
        EXPECT_EQ(differingPixels(tessellated, draw(settings, has_residuals)), 0u);
        settings.strands.backend = Backend::pulling_geometry;
        EXPECT_EQ(differingPixels(tessellated, draw(settings, has_residuals)), 0u);
    }

    static std::vector<engine::FrameRecord> record(
        const Settings& settings, bool has_residuals, engine::Timing timing,
        std::optional<ExpectedCounts>& expected) {
        const groom::StrandSet model = zigzag();
        const DeviceHair hair(device(), groomWithAll(has_residuals), settings, &model);
        Renderer renderer(device(), settings, hair.view(), RenderAssets{});
        engine::FrameLoop loop(device(), timing);
        loop.frame([&](engine::Passes& passes) { renderer.record(passes, hair.view()); });
        expected = renderer.expected();
        return loop.finish();
    }
};

TEST_F(StrandFeaturePictureTest, BackEndsDrawTheSame) {
    const Pixels plain = draw(small({}), false);
    for (const Feature& feature : kFeatures) {
        SCOPED_TRACE(feature.name);
        const Settings settings = small(feature.strands);
        const Pixels picture = draw(settings, feature.has_residuals);
        EXPECT_GT(differingPixels(picture, plain), 100u);  // the feature is visible
        expectEqualPictures(picture, settings, feature.has_residuals);
    }
}

TEST_F(StrandFeaturePictureTest, BackEndsDrawTheSameAtAnyLevelOfDetail) {
    for (const Feature& feature : kFeatures) {
        SCOPED_TRACE(feature.name);
        Settings settings = small(feature.strands);
        settings.lod.level = 1.0f;
        const auto draw_and_compare = [&] {
            expectEqualPictures(
                draw(settings, feature.has_residuals), settings, feature.has_residuals);
        };
        draw_and_compare();
        settings.lod = {.mode = LodMode::distance, .near_distance = 0.4f, .far_distance = 0.8f};
        draw_and_compare();
    }
}

// Back ends that make triangles in another way. Their pictures differ by as much as those of plain
// strands (tests/rendering/points_picture_test.cpp; mean FLIP errors), or by a twentieth of the
// feature's change: half of a small picture's pixels are edges of strands. `pulling` rounds a few
// pixels differently.
TEST_F(StrandFeaturePictureTest, OtherBackEndsDrawThemToo) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    struct Other {
        Backend backend;
        const char* name;
        double most_different;
    };
    constexpr std::array<Other, 3> kOthers{
        {{Backend::pulling, "pulling", 0.001},
         {Backend::expanded, "expanded", 0.005},
         {Backend::software, "software", 0.02}}};
    constexpr std::array<std::string_view, 3> kLate{"residuals", "push_out", "all"};
    const TemporaryFolder folder;
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> pairs;
    const auto plain = writePicture(folder.file("plain.png"), small({}), draw(small({}), false));
    for (const Feature& feature : kFeatures) {
        if (std::ranges::find(kLate, feature.name) == kLate.end()) continue;
        const Settings settings = small(feature.strands);
        const auto write = [&](Backend backend, const std::string& name) {
            return writePicture(
                folder.file(std::string(feature.name) + " " + name + ".png"), settings,
                draw(with(settings, backend), feature.has_residuals));
        };
        const auto tessellated = write(Backend::tessellation, "tessellation");
        pairs.emplace_back(tessellated, plain);
        for (const Other& way : kOthers)
            pairs.emplace_back(tessellated, write(way.backend, way.name));
    }
    ASSERT_EQ(pairs.size(), kLate.size() * (1 + kOthers.size()));
    const std::vector<double> errors = flipErrors(pairs);
    for (std::size_t i = 0; i < pairs.size(); i += 1 + kOthers.size()) {
        for (std::size_t k = 0; k < kOthers.size(); ++k) {
            const double bound = std::max(kOthers[k].most_different, 0.05 * errors.at(i));
            EXPECT_LE(errors.at(i + 1 + k), bound) << pairs[i + 1 + k].second;
        }
    }
}

TEST_F(StrandFeaturePictureTest, CountsAreThoseOfThePlan) {
    if (!device().hasPipelineStatistics()) GTEST_SKIP() << "no pipeline statistics";
    for (const auto& [level, strands, pieces] : {std::tuple{0.0f, 200u, 6u}, {1.0f, 100u, 3u}}) {
        Settings settings = small({.source = StrandSource::groom});
        settings.strands.tessellation = 6;
        settings.lod.level = level;
        std::optional<ExpectedCounts> expected;
        const auto records = record(settings, false, engine::Timing::statistics, expected);
        const auto pass = std::ranges::find(
            records.at(0).statistics, std::string("strands"), &engine::PassStatistics::name);
        ASSERT_NE(pass, records.at(0).statistics.end());
        const auto count = [&](std::string_view name) -> std::uint64_t {
            const auto at = std::ranges::find(engine::kStatisticNames, name);
            return pass->counts[static_cast<std::size_t>(at - engine::kStatisticNames.begin())];
        };
        const std::uint64_t patches = strands * 7u;
        // GPUs may run these stages more than once for a patch or a vertex.
        EXPECT_GE(count("tessellation_control_patches"), patches);
        EXPECT_GE(count("tessellation_evaluation_invocations"), patches * (pieces + 1));
        if (device().info().type == engine::DeviceType::cpu) {
            EXPECT_EQ(count("tessellation_control_patches"), patches);
            EXPECT_EQ(count("tessellation_evaluation_invocations"), patches * (pieces + 1));
        }
        EXPECT_EQ(count("geometry_invocations"), patches * pieces);
        EXPECT_EQ(expected->tessellation_control_patches, patches);
        EXPECT_EQ(expected->tessellation_evaluation_invocations, patches * (pieces + 1));
        EXPECT_EQ(expected->geometry_primitives, 2 * patches * pieces);
    }
}

TEST_F(StrandFeaturePictureTest, FramesAreAPassWhereStrandsAreOffOfTheirCurvesOnly) {
    for (const Feature& feature : kFeatures) {
        std::optional<ExpectedCounts> expected;
        const auto records = record(
            small(feature.strands), feature.has_residuals, engine::Timing::isolated, expected);
        const auto& passes = records.at(0).passes;
        const bool there =
            std::ranges::find(passes, std::string("frames"), &engine::PassTime::name) !=
            passes.end();
        constexpr std::string_view kOffset[] = {"curl", "variation", "offsets", "residuals", "all"};
        const bool offset = std::ranges::find(kOffset, feature.name) != std::end(kOffset);
        EXPECT_EQ(there, offset) << feature.name;
    }
}

}  // namespace
}  // namespace hair::rendering
