// The viewer measures the same as the runner, without changing what it shows.
#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <semaphore>
#include <thread>

#include <gmock/gmock.h>

#include "benchmarks/viewer/player.h"
#include "benchmarks/viewer/timings_panel.h"
#include "engine/buffer_image.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"

namespace benchmarks::viewer {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Settings with moving hair.
hair::Settings tinySettings() {
    hair::Settings settings = hair::plainSettings();
    settings.simulation.solver = hair::Solver::shape;
    settings.simulation.wind.strength = 2.0f;
    settings.strands.density = 8;
    settings.run.warmup = 2;
    settings.run.frames = 2;
    settings.run.max_time = 0.0f;  // one round per mode
    return settings;
}

std::map<std::string, double> memoryOf(const report::CaseResult& result) {
    std::map<std::string, double> memory;
    for (const report::Metric& metric : result.metrics)
        if (metric.name().starts_with("memory.")) memory[metric.name()] = metric.samples.front();
    return memory;
}

class MeasuredSide : public GpuTest {
protected:
    static SideMeasurement measured(const measure::MeasureHooks& hooks) {
        return measureSide(device(), tinySettings(), HAIRBENCH_SCENES_DIR, "tiny", hooks);
    }
    static bool goOn() { return false; }
};

TEST_F(MeasuredSide, EndsWithTheFrameThatTheViewerShowsThere) {
    Player player(device(), tinySettings(), HAIRBENCH_SCENES_DIR);
    player.seek(1);
    const std::string picture = player.played().pictureHash();
    const SideMeasurement side = measured({.stop = goOn});
    EXPECT_EQ(player.played().pictureHash(), picture);
    EXPECT_EQ(player.frame(), 1u);
    // A round plays frame 0, warms up to frame 1, and draws one more frame than it measures.
    player.seek(4);
    EXPECT_EQ(side.result.image_hash, player.played().pictureHash());
    EXPECT_EQ(side.result.state_hash, player.played().stateHash());
    EXPECT_EQ(side.picture, player.played().picture());
    EXPECT_NE(side.result.image_hash, picture);
}

TEST_F(MeasuredSide, HasTheMetricsOfARun) {
    report::CaseResult run;
    {
        measure::Case test_case(device(), tinySettings(), HAIRBENCH_SCENES_DIR);
        const hair::RunSettings settings = tinySettings().run;
        measure::measure(device(), test_case, settings, {.stop = goOn}, run);
    }
    // Others use the device too, and one more starts to use it during the measurement.
    Player player(device(), tinySettings(), HAIRBENCH_SCENES_DIR);
    std::optional<engine::Buffer> window;
    std::vector<std::string> modes;
    const SideMeasurement side = measured(
        {.stop = goOn, .progress = [&](const measure::SamplingState& state) {
             modes.push_back(state.mode);
             window.emplace(
                 device(),
                 engine::BufferDescription{.size = 1u << 20, .name = "window", .purpose = "tests"});
         }});
    EXPECT_THAT(modes, testing::IsSupersetOf({"overlapped", "isolated"}));
    EXPECT_EQ(memoryOf(side.result), memoryOf(run));
    EXPECT_EQ(side.result.counts, run.counts);
    const auto names = [](const report::CaseResult& result) {
        std::vector<std::string> all;
        for (const report::Metric& metric : result.metrics)
            if (metric.mode != report::Mode::wall_clock) all.push_back(metric.name());
        std::ranges::sort(all);
        return all;
    };
    // Leaves out passes, which use another clock if the device's timestamps are wrong.
    const auto whole = [&](const report::CaseResult& result) {
        std::vector<std::string> all = names(result);
        std::erase_if(all, [](const std::string& name) { return name.starts_with("pass."); });
        return all;
    };
    EXPECT_EQ(whole(side.result), whole(run));
    EXPECT_THAT(side.result.trust.warnings, testing::Contains(testing::HasSubstr("in the viewer")));
}

TEST_F(MeasuredSide, IsNoneWhereTheUserCancels) {
    int asked = 0;
    EXPECT_THROW(measured({.stop = [&] { return ++asked > 3; }}), engine::Interrupted);
}

// The window plots what `run` reports, and its frames are those without probes.
TEST_F(MeasuredSide, HasTheRunnersProbes) {
    hair::Settings settings = tinySettings();
    Player without(device(), settings, HAIRBENCH_SCENES_DIR);
    without.seek(3);
    EXPECT_THAT(without.shown().probes.names, IsEmpty());
    settings.run.probes = {.tip_displacement = true, .momentum = true};
    measure::Case test_case(device(), settings, HAIRBENCH_SCENES_DIR);
    const measure::PlayedProbes expected = measure::playProbes(device(), test_case, 4, goOn);
    ASSERT_EQ(expected.times.size(), 5u);

    Player player(device(), settings, HAIRBENCH_SCENES_DIR);
    player.next();
    player.skip();
    player.next(engine::Timing::overlapped);
    const Shown shown = player.shown();
    EXPECT_EQ(shown.probes.names, expected.names);
    EXPECT_EQ(shown.probes.times, expected.times);
    EXPECT_EQ(shown.probes.values, expected.values);
    EXPECT_EQ(shown.pictureHash(), without.shown().pictureHash());
    EXPECT_EQ(shown.stateHash(), without.shown().stateHash());
    player.seek(1);
    EXPECT_EQ(player.shown().probes.times.size(), 3u);  // the start and two frames

    settings.run.probes.first_guide = 1u << 20;
    EXPECT_THROW(player.apply(settings), engine::Error);
    EXPECT_EQ(player.frame(), 1u);
    EXPECT_EQ(player.shown().probes.times.size(), 3u);
}

TEST_F(MeasuredSide, CountsWithoutTouchingTheFrame) {
    if (!device().hasPipelineStatistics()) GTEST_SKIP() << "no pipeline statistics";
    Player player(device(), tinySettings(), HAIRBENCH_SCENES_DIR);
    player.seek(2);
    const std::string picture = player.played().pictureHash();
    const std::string state = player.played().stateHash();
    const report::CaseResult counted = countStatistics(device(), player.played());
    EXPECT_EQ(counted.statistics.size(), engine::statisticNames(device()).size());
    EXPECT_EQ(player.frame(), 2u);
    EXPECT_EQ(player.played().pictureHash(), picture);
    EXPECT_EQ(player.played().stateHash(), state);
    // The next frame is unaffected.
    player.next();
    const std::string next = player.played().pictureHash();
    player.seek(3);
    EXPECT_EQ(player.played().pictureHash(), next);
    // All counts are as the settings imply.
    EXPECT_THAT(counted.trust.warnings, IsEmpty());
    const auto compared =
        std::ranges::count_if(counted.statistics, [](const report::Statistic& each) {
            return each.expected.has_value();
        });
    EXPECT_GT(compared, 0);
}

// ---- Between the window and the measuring thread

// The next round starts only after the window has shown the last one.
TEST(MeasureLink, HoldsTheRoundsUntilTheWindowHasShownThem) {
    std::counting_semaphore<> told(0);
    std::atomic<std::uint32_t> rounds = 0;
    MeasureLink link([&] { told.release(); });
    std::thread measures([&, hooks = link.hooks()] {
        while (!hooks.stop() && rounds < 3) hooks.progress({.rounds = ++rounds});
    });
    for (std::uint32_t round = 1; round <= 3; ++round) {
        told.acquire();
        EXPECT_EQ(rounds, round);
        const std::optional<measure::SamplingState> state = link.take();
        EXPECT_TRUE(state && state->rounds == round);
        EXPECT_FALSE(link.take().has_value());
        link.shown();
    }
    measures.join();
}

// A window that closes shows nothing more, so the measuring thread must not wait for it.
TEST(MeasureLink, LetsGoOfWhoeverMeasuresWhenItIsCancelled) {
    std::counting_semaphore<> told(0);
    std::uint32_t rounds = 0;
    MeasureLink link([&] { told.release(); });
    std::thread measures([&, hooks = link.hooks()] {
        while (!hooks.stop()) hooks.progress({.rounds = ++rounds});
    });
    told.acquire();
    link.cancel();
    measures.join();
    EXPECT_EQ(rounds, 1u);
    EXPECT_TRUE(link.isCancelled());
    link.restart();
    EXPECT_FALSE(link.isCancelled());
    EXPECT_FALSE(link.take().has_value());
}

}  // namespace
}  // namespace benchmarks::viewer
