// Tests the pictures of stops on a device.
#include <map>
#include <memory>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "benchmarks/ablate/ladder_walk.h"
#include "engine/queries.h"
#include "engine/transfer.h"
#include "tests/gpu_fixture.h"
#include "tests/rendering/pictures.h"
#include "tests/required.h"

namespace benchmarks::ablate {
namespace {

// The thesis's hair: 136 root triangles of 7 guide segments, with 16 strands of 4 pieces.
constexpr std::uint64_t kPatches = 136 * 7;
constexpr std::uint64_t kLines = kPatches * 16 * 4;

class StopViewTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (isOver()) return;
        settings_ = hair::rendering::thesisAtRest();
        settings_.strands.density = 16;
        settings_.strands.root_width = 0.002f;  // m; thick, to be visible in a small picture
        settings_.strands.tip_width = 0.001f;
        settings_.render.width = 160;
        settings_.render.height = 90;
        settings_.render.msaa = device().supportsSamples(4) ? 4 : 1;
        watch_.emplace(device());
    }

    // Returns the views of the settings' first frame. Only those of the last call may draw.
    std::map<Stop, std::unique_ptr<StopView>>
    views(const hair::Settings& settings, const std::set<Stop>& wanted = {}) {
        hair_.emplace(device(), settings, HAIRBENCH_SCENES_DIR, 0, cache_);
        std::map<Stop, std::unique_ptr<StopView>> views;
        for (StopPlan& plan : planStops(settings, watch_->address()))
            if (wanted.empty() || wanted.contains(plan.stop))
                views[plan.stop] =
                    std::make_unique<StopView>(device(), plan, hair_->view(), hair_->assets());
        return views;
    }

    // Returns the sum over the invocations of the stop's watched stage.
    std::uint32_t sumOf(StopView& view) {
        watch_->countAll();
        engine::FrameLoop loop(device(), engine::Timing::isolated);
        view.draw(loop);
        loop.finish();
        const std::uint32_t sum = watch_->counts().sum;
        watch_->countNone();
        return sum;
    }

    hair::rendering::Pixels pictureOf(StopView& view) {
        engine::FrameLoop loop(device(), engine::Timing::isolated);
        view.draw(loop);
        loop.finish();
        return view.picture();
    }

    // Counts of a stage that makes vertices. A GPU may run it more often.
    static void expectRun(std::uint64_t count, std::uint64_t expected) {
        if (device().info().type == engine::DeviceType::cpu)
            EXPECT_EQ(count, expected);
        else
            EXPECT_GE(count, expected);
    }

    hair::Settings settings_;
    measure::HairCache cache_;
    std::optional<hair::rendering::StageWatch> watch_;
    std::optional<StillHair> hair_;
};

TEST_F(StopViewTest, DoesTheWorkOfItsStages) {
    std::map<Stop, std::map<std::string, std::uint64_t>> counts;
    for (auto& [stop, view] : views(settings_)) {
        const std::vector<report::Statistic> lines =
            stopStatistics(view->stop(), view->plan(), view->count(*watch_), false);
        for (const report::Statistic& each : lines) counts[stop][each.name] = each.measured;
        for (const std::string& warning : countWarnings(view->stop(), lines, device().info()))
            ADD_FAILURE() << warning;
    }
    if (device().hasPipelineStatistics()) {
        EXPECT_EQ(counts[Stop::empty]["input_assembly_vertices"], 0u);
        expectRun(counts[Stop::vertex]["vertex_invocations"], kPatches);
        const char* const evaluations = "tessellation_evaluation_invocations";
        expectRun(counts[Stop::tessellation_1][evaluations], kPatches * 16 * 2);
        expectRun(counts[Stop::tessellation][evaluations], kPatches * 16 * 5);
        EXPECT_EQ(counts[Stop::geometry]["geometry_invocations"], kLines);
        EXPECT_EQ(counts[Stop::geometry]["geometry_primitives"], 2 * kLines);
        EXPECT_EQ(counts[Stop::clipped]["fragment_invocations"], 0u);
        EXPECT_GT(counts[Stop::fragment]["fragment_invocations"], 0u);
    }
    expectRun(counts[Stop::vertex]["seen"], kPatches);
    expectRun(counts[Stop::tessellation_1]["seen"], kPatches * 16 * 2);
    expectRun(counts[Stop::tessellation]["seen"], kPatches * 16 * 5);
    EXPECT_EQ(counts[Stop::geometry]["seen"], kLines);
    EXPECT_EQ(counts[Stop::watched_geometry]["seen"], kLines);
    if (!counts[Stop::raster].contains("samples_passed")) return;
    EXPECT_EQ(counts[Stop::geometry]["samples_passed"], 0u);
    EXPECT_GT(counts[Stop::raster]["samples_passed"], 0u);
    EXPECT_EQ(counts[Stop::raster]["samples_passed"], counts[Stop::fragment]["samples_passed"]);
    EXPECT_EQ(counts[Stop::raster_msaa]["samples_passed"], counts[Stop::msaa]["samples_passed"]);
}

TEST_F(StopViewTest, DrawsWhatItsStagesLeaveToSee) {
    hair::Settings single = settings_;
    single.render.msaa = 1;
    hair::Settings without = single;
    without.render.hair = false;
    const hair::rendering::Pixels hairy = hair::rendering::drawCase(device(), single);
    const hair::rendering::Pixels bald = hair::rendering::drawCase(device(), without);
    // The picture has 14,400 pixels and is 1.2 m high, the hair about 0.3 m.
    ASSERT_GT(hair::rendering::differingPixels(hairy, bald), 200u);

    std::map<Stop, std::unique_ptr<StopView>> all = views(settings_);
    for (const Stop stop :
         {Stop::empty, Stop::vertex, Stop::tessellation_1, Stop::tessellation, Stop::geometry,
          Stop::raster})
        EXPECT_EQ(pictureOf(*all.at(stop)), bald) << stopName(stop);
    for (const Stop stop :
         {Stop::fragment, Stop::watched_vertex, Stop::watched_evaluation, Stop::watched_geometry})
        EXPECT_EQ(pictureOf(*all.at(stop)), hairy) << stopName(stop);
    const hair::rendering::Pixels usual = hair::rendering::drawCase(device(), settings_);
    EXPECT_EQ(pictureOf(*all.at(Stop::pass)), usual);
    if (all.contains(Stop::msaa)) {
        EXPECT_EQ(pictureOf(*all.at(Stop::msaa)), usual);
    }
}

// The sum is 0 + 1 + ... + 951.
TEST_F(StopViewTest, SeesEveryPatchNumber) {
    EXPECT_EQ(
        sumOf(*views(settings_, {Stop::vertex}).at(Stop::vertex)), kPatches * (kPatches - 1) / 2);
}

// Another camera changes the quads but not the strands. Another width changes both, the same
// settings neither.
TEST_F(StopViewTest, SeesWhatStagesMake) {
    const auto sums = [&](const hair::Settings& settings) {
        auto all = views(settings, {Stop::tessellation, Stop::geometry});
        return std::pair{sumOf(*all.at(Stop::tessellation)), sumOf(*all.at(Stop::geometry))};
    };
    const auto [strands, quads] = sums(settings_);
    EXPECT_EQ(sums(settings_), std::pair(strands, quads));
    hair::Settings other = settings_;
    other.camera.position.x += 0.01f;
    const auto [strands_elsewhere, quads_elsewhere] = sums(other);
    EXPECT_EQ(strands_elsewhere, strands);
    EXPECT_NE(quads_elsewhere, quads);
    other = settings_;
    other.strands.root_width *= 1.5f;
    const auto [wide_strands, wide_quads] = sums(other);
    EXPECT_NE(wide_strands, strands);
    EXPECT_NE(wide_quads, quads);
}

TEST_F(StopViewTest, WatchesAlmostNothingWhileItIsTimed) {
    auto all = views(settings_, {Stop::geometry});
    watch_->countNone();
    engine::FrameLoop loop(device(), engine::Timing::isolated);
    EXPECT_EQ(all.at(Stop::geometry)->visit(loop, 3).size(), 3u);
    // The chance to see one of the 60,928 invocations in each of 4 frames is 6e-5.
    EXPECT_EQ(watch_->counts().invocations, 0u);
}

TEST_F(StopViewTest, LeavesOtherBackEndsAlone) {
    settings_.strands.backend = hair::Backend::pulling_geometry;
    EXPECT_THROW(views(settings_), engine::Unsupported);
}

// A scissor leaves the left half of the picture.
TEST_F(StopViewTest, CountsSamples) {
    std::optional<engine::SamplesQuery> query;
    try {
        query.emplace(device());
    } catch (const engine::Unsupported& error) {
        GTEST_SKIP() << error.what();
    }
    const std::uint32_t samples = settings_.render.msaa;
    const engine::Target target(device(), {.width = 64, .height = 32, .msaa = samples});
    const engine::GraphicsPipeline screen(
        device(), {.shaders = {"composite/screen.vert"},
                   .push_size = sizeof(std::uint32_t),
                   .colors = {{target.description().color_format, engine::Blend::keep}},
                   .depth_format = engine::Target::kDepthFormat,
                   .samples = samples,
                   .depth_compare = VK_COMPARE_OP_ALWAYS});
    runOnce(device(), [&](engine::Commands& commands) {
        query->begin(commands);
        target.beginRendering(commands, engine::Load::clear, {});
        const VkRect2D left{{0, 0}, {32, 32}};
        commands.bind(screen, std::uint32_t{0});
        vkCmdSetScissor(commands.get(), 0, 1, &left);
        commands.draw({.vertices = 3});
        target.endRendering(commands);
        query->end(commands);
    });
    EXPECT_EQ(query->read(), 32u * 32u * samples);
}

}  // namespace
}  // namespace benchmarks::ablate
