// Effects of orders on the drawing code, without its thread.
#include "benchmarks/viewer/studio.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

#include <gmock/gmock.h>

#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::viewer {
namespace {

using testing::HasSubstr;

// Settings with moving hair.
hair::Settings movingSettings() {
    hair::Settings settings = hair::plainSettings();
    settings.simulation.solver = hair::Solver::shape;
    settings.simulation.wind.strength = 2.0f;
    settings.strands.density = 16;
    return settings;
}

class StudioTest : public GpuTest {
protected:
    StudioTest() : studio_(device(), "no shaders are watched") {}

    static SideOrder side(std::uint64_t number, const hair::Settings& settings) {
        return {
            .side = number,
            .revision = ++revision_,
            .settings = settings,
            .directory = HAIRBENCH_SCENES_DIR};
    }
    Reply perform(const Order& order) {
        return studio_.perform(order, [] { return false; });
    }
    static std::string hashOf(const hair::Settings& settings, std::uint32_t frame) {
        Player player(device(), settings, HAIRBENCH_SCENES_DIR);
        player.seek(frame);
        return player.played().pictureHash();
    }

    static inline std::uint64_t revision_ = 0;
    Studio studio_;
};

TEST_F(StudioTest, DrawsFewerStrandsAndPixelsInAPreview) {
    const hair::Settings settings = movingSettings();
    Order order{.sides = {side(1, settings)}};
    const Shown whole = *perform(order).sides.front().shown;
    EXPECT_EQ(whole.level, 0u);
    EXPECT_TRUE(whole.isExact());
    order.level = 3;
    const Reply reply = perform(order);
    const Shown coarse = *reply.sides.front().shown;
    EXPECT_EQ(reply.level, 3u);
    EXPECT_GT(reply.milliseconds, 0.0);
    EXPECT_EQ(coarse.level, 3u);
    EXPECT_FALSE(coarse.isExact());
    EXPECT_EQ(coarse.width, std::lround(0.375 * settings.render.width));
    EXPECT_EQ(coarse.height, std::lround(0.375 * settings.render.height));
    EXPECT_EQ(coarse.picture.size(), std::size_t{4} * coarse.width * coarse.height);
    // 16 strands per root triangle at level 0, and 2^-3 of them at level 3: thesis 2.3.8.1.
    EXPECT_DOUBLE_EQ(coarse.strand_share, 2.0 / 16.0);
    EXPECT_EQ(coarse.guides, whole.guides);
}

TEST_F(StudioTest, OpensASceneAtTheLevelThatIsAskedFor) {
    const hair::Settings settings = movingSettings();
    Order order{.sides = {side(1, settings)}, .level = PreviewControl::kFirst};
    const Reply first = perform(order);
    EXPECT_EQ(first.level, PreviewControl::kFirst);
    EXPECT_GT(first.milliseconds, 0.0);
    EXPECT_EQ(first.sides.front().shown->level, PreviewControl::kFirst);
    order.level = 0;
    EXPECT_EQ(perform(order).sides.front().shown->pictureHash(), hashOf(settings, 0));
}

// Previews only change the drawing: frames that were played in previews are refined to the runner's
// picture.
TEST_F(StudioTest, RefinesPreviewsToTheRunnersPicture) {
    const hair::Settings settings = movingSettings();
    Order order{.sides = {side(1, settings)}, .frames = 1, .level = 4};
    perform(order);
    for (int i = 0; i < 2; ++i) {
        const Reply reply = perform(order);
        EXPECT_FALSE(reply.sides.front().timed.has_value());  // only whole pictures are timed
    }
    order.frames = 0;
    order.level = 0;
    const Reply refined = perform(order);
    ASSERT_TRUE(refined.sides.front().shown.has_value());
    EXPECT_EQ(refined.sides.front().shown->frame, 3u);
    EXPECT_EQ(refined.sides.front().shown->pictureHash(), hashOf(settings, 3));
    // Nothing more is left to draw.
    const Reply again = perform(order);
    EXPECT_FALSE(again.sides.front().shown.has_value());
    EXPECT_EQ(again.milliseconds, 0.0);
}

TEST_F(StudioTest, MovesTheCameraOfEveryLevel) {
    hair::Settings settings = movingSettings();
    Order order{.sides = {side(1, settings)}, .level = 2};
    const std::string before = perform(order).sides.front().shown->pictureHash();
    settings.camera.position.x += 0.1f;
    order.sides = {side(1, settings)};
    EXPECT_NE(perform(order).sides.front().shown->pictureHash(), before);
    order.level = 0;
    EXPECT_EQ(perform(order).sides.front().shown->pictureHash(), hashOf(settings, 0));
}

TEST_F(StudioTest, KeepsWhatItPlaysWhereSettingsAreRefused) {
    const hair::Settings settings = movingSettings();
    const std::string before =
        perform({.sides = {side(1, settings)}}).sides.front().shown->pictureHash();
    hair::Settings broken = settings;
    broken.groom.file = "there is no such file.hair";
    Order order{.sides = {side(1, broken)}};
    const SideReply refused = std::move(perform(order).sides.front());
    EXPECT_THAT(refused.problem, HasSubstr("there is no such file.hair"));
    EXPECT_EQ(refused.revision, order.sides.front().revision);
    EXPECT_FALSE(refused.failure);
    // The problem is repeated while it persists, and frames continue.
    order.frames = 1;
    const SideReply played = std::move(perform(order).sides.front());
    EXPECT_NE(played.problem, "");
    EXPECT_EQ(played.shown->frame, 1u);
    EXPECT_EQ(played.shown->settings.groom.file, settings.groom.file);
    order = {.sides = {side(1, settings)}, .seek = 0};
    const SideReply good = std::move(perform(order).sides.front());
    EXPECT_EQ(good.problem, "");
    EXPECT_EQ(good.shown->pictureHash(), before);
}

TEST_F(StudioTest, SaysWhyASideCannotBeMade) {
    hair::Settings broken = movingSettings();
    broken.groom.file = "there is no such file.hair";
    const Reply reply = perform({.sides = {side(1, broken)}});
    ASSERT_TRUE(reply.sides.front().failure);
    EXPECT_THROW(std::rethrow_exception(reply.sides.front().failure), engine::Error);
    EXPECT_FALSE(reply.sides.front().shown.has_value());
}

TEST_F(StudioTest, LetsGoOfSidesThatAreNotWanted) {
    const auto bytes = [](const Reply& reply) {
        std::uint64_t sum = 0;
        for (const auto& [entry, held] : reply.memory) sum += held;
        return sum;
    };
    const SideOrder a = side(1, movingSettings()), b = side(2, movingSettings());
    const std::uint64_t one = bytes(perform({.sides = {a}}));
    EXPECT_GT(bytes(perform({.sides = {a, b}})), one);
    EXPECT_EQ(bytes(perform({.sides = {a}})), one);
}

TEST_F(StudioTest, BeginsASecondSideAtTheFrameOfTheFirst) {
    Order order{.sides = {side(1, movingSettings())}};
    perform(order);
    order.frames = 2;
    perform(order);
    order.frames = 0;
    order.sides.push_back(side(2, movingSettings()));
    order.sides.back().beside = 1;
    const Reply reply = perform(order);
    EXPECT_EQ(reply.sides.back().shown->frame, 2u);
    EXPECT_EQ(reply.sides.back().shown->pictureHash(), hashOf(movingSettings(), 2));
}

// A seek that is stopped ends at the next frame, and the reply has the frame that was reached.
TEST_F(StudioTest, StopsBetweenFrames) {
    Order order{.sides = {side(1, movingSettings())}};
    perform(order);
    order.seek = 1000000;
    int asked = 0;
    const Reply reply = studio_.perform(order, [&] { return ++asked > 3; });
    EXPECT_EQ(asked, 4);
    EXPECT_EQ(reply.sides.size(), 1u);
}

TEST_F(StudioTest, CountsTheSideThatWasAskedFor) {
    if (!device().hasPipelineStatistics()) GTEST_SKIP() << "no pipeline statistics";
    Order order{.sides = {side(1, movingSettings())}};
    EXPECT_FALSE(perform(order).counted.has_value());
    order.count = 1;
    const Reply reply = perform(order);
    ASSERT_TRUE(reply.counted.has_value());
    EXPECT_EQ(reply.counted->statistics.size(), engine::statisticNames(device()).size());
}

// A GLSL file beside the scene: docs/extending.md.
TEST_F(StudioTest, DrawsByAFileOnceItIsSaved) {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& body) {
        folder.write("mine.glsl", "vec3 shadeHair(HairPoint point) {\n" + body + "\n}\n");
    };
    write("return vec3(1.0, 0.0, 0.0);");
    hair::Settings settings = hair::plainSettings();
    settings.groom.grow.mesh = HAIRBENCH_SCENES_DIR "/assets/head.glb";
    settings.render.head = false;
    settings.strands.density = 8;
    settings.shading.model = hair::ShadingModel::extension;
    settings.shading.model_file = "mine.glsl";
    SideOrder own = side(1, settings);
    own.directory = folder.path();
    const Order order{.sides = {own}};
    const auto shows = [](const Shown& shown, const std::array<int, 3>& color) {
        for (std::size_t i = 0; i < shown.picture.size(); i += 4)
            if (shown.picture[i] == color[0] && shown.picture[i + 1] == color[1] &&
                shown.picture[i + 2] == color[2])
                return true;
        return false;
    };
    // Returns the next reply after a save was noticed. Files are checked twice, a quarter of a
    // second apart.
    const auto afterSave = [&] {
        for (int i = 0; i < 100; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            SideReply reply = std::move(perform(order).sides.front());
            if (reply.reread) return reply;
        }
        return SideReply{};
    };
    EXPECT_TRUE(shows(*perform(order).sides.front().shown, {255, 0, 0}));

    write("return colour;");
    const SideReply wrong = afterSave();
    EXPECT_THAT(wrong.problem, HasSubstr("mine.glsl:2: 'colour' : undeclared identifier"));
    EXPECT_FALSE(wrong.shown.has_value());  // the last valid one stays

    write("return vec3(0.0, 1.0, 0.0);");
    const SideReply right = afterSave();
    EXPECT_EQ(right.problem, "");
    ASSERT_TRUE(right.shown.has_value());
    EXPECT_TRUE(shows(*right.shown, {0, 255, 0}));
    EXPECT_FALSE(shows(*right.shown, {255, 0, 0}));
}

}  // namespace
}  // namespace benchmarks::viewer
