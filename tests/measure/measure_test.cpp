#include "benchmarks/measure/measure.h"

#include <algorithm>
#include <map>
#include <new>
#include <set>
#include <span>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/run/run.h"
#include "tests/error_text.h"
#include "tests/gpu_fixture.h"

namespace benchmarks::measure {
namespace {

using testing::ContainsRegex;
using testing::Each;
using testing::Not;

// A little of the thesis's hair in the wind, in a small picture.
hair::Settings smallCase() {
    hair::Settings settings;
    settings.strands.backend = hair::Backend::tessellation;
    settings.strands.density = 2;
    settings.strands.tessellation = 1;
    settings.render.width = 64;
    settings.render.height = 36;
    settings.simulation.wind.strength = 10.0f;
    settings.run = {.warmup = 2, .frames = 5, .max_time = 0.0f};
    return settings;
}

const report::Metric* find(const report::CaseResult& result, const std::string& name) {
    const auto found = std::ranges::find(result.metrics, name, &report::Metric::name);
    return found == result.metrics.end() ? nullptr : &*found;
}

double onlySample(const report::CaseResult& result, const std::string& name) {
    const report::Metric* metric = find(result, name);
    EXPECT_TRUE(metric && metric->samples.size() == 1) << name;
    return metric && !metric->samples.empty() ? metric->samples.front() : 0.0;
}

std::size_t samplesOf(const report::CaseResult& result, const std::string& name) {
    const report::Metric* metric = find(result, name);
    return metric ? metric->samples.size() : 0;
}

class MeasureTest : public GpuTest {
protected:
    static report::CaseResult
    measured(const hair::Settings& settings, const MeasureHooks& hooks = {.stop = [] {
                                                 return false;
                                             }}) {
        Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
        report::CaseResult result;
        measure(device(), test_case, settings.run, hooks, result);
        return result;
    }
};

TEST_F(MeasureTest, PlaysOneRoundOfEachModeWithoutTime) {
    const report::CaseResult result = measured(smallCase());
    EXPECT_EQ(samplesOf(result, "frame.time"), 5u);
    EXPECT_EQ(samplesOf(result, "frame.isolated.time"), 5u);
    EXPECT_EQ(samplesOf(result, "frame.first.time"), 1u);
    EXPECT_EQ(samplesOf(result, "pass.strands.time"), 5u);
    ASSERT_GE(result.sampling.size(), 2u);
    EXPECT_EQ(result.sampling[0].mode, "overlapped");
    EXPECT_EQ(result.sampling[1].mode, "isolated");
    for (const report::Sampling& mode : result.sampling) EXPECT_EQ(mode.rounds, 1u);
}

// A round has five frames: the middle one of the reported times is the judged one.
TEST_F(MeasureTest, JudgesEachModeByTheTimeThatItReports) {
    std::map<std::string, double> medians;
    const report::CaseResult result = measured(
        smallCase(),
        {.stop = [] { return false; },
         .progress = [&](const SamplingState& state) { medians[state.mode] = state.median; }});
    for (const auto& [mode, name] :
         {std::pair{"overlapped", "frame.time"}, std::pair{"isolated", "frame.isolated.time"}}) {
        ASSERT_EQ(samplesOf(result, name), 5u);
        std::vector<double> times = find(result, name)->samples;
        std::ranges::sort(times);
        EXPECT_GT(times.front(), 0.0) << name;
        EXPECT_EQ(medians[mode], times[2]) << mode;
    }
}

// With one frame, every median is its only sample. The passes sum to their share of its wall clock.
// The time that they save by overlapping is that less the frame and less a number of empty passes.
TEST_F(MeasureTest, TellsWhatOverlapSaves) {
    hair::Settings settings = smallCase();
    settings.run.frames = 1;
    const report::CaseResult result = measured(settings);
    const double frame = onlySample(result, "frame.time");
    const double passes =
        result.trust.pass_sum_over_wall.value() * onlySample(result, "frame.isolated.time");
    EXPECT_GT(passes, 0.0);
    const double empty = result.trust.empty_pass.value();
    const double count = (passes - frame - onlySample(result, "frame.overlap")) / empty;
    EXPECT_NEAR(count, std::round(count), 1e-9 * (passes + frame) / empty);  // rounding
    EXPECT_GE(
        std::round(count), std::ranges::count_if(result.metrics, [](const report::Metric& metric) {
            return metric.id.of == report::MetricOf::pass &&
                   metric.id.what == report::Measured::time;
        }));
}

// The next case may need less memory.
TEST_F(MeasureTest, FailsACaseForWhichThereIsNoMemory) {
    const run::PlannedCase planned{
        .spec = {.name = "small", .axes = {}, .settings = smallCase()},
        .directory = HAIRBENCH_SOURCE_DIR "/scenes",
        .index = 7};
    HairCache cache = userHairCache(false);
    run::CaseComparisons comparisons;
    bool is_full = true;
    const MeasureHooks hooks{
        .stop = [] { return false; },
        .progress =
            [&](const SamplingState&) {
                if (is_full) throw std::bad_alloc();
            }};
    const report::CaseResult failed =
        run::runCase(device(), planned, hooks, {}, comparisons, cache).result;
    EXPECT_EQ(failed.status, report::Status::failed);
    EXPECT_EQ(failed.reason, "the host has not enough memory");
    EXPECT_EQ(failed.index, 7u);
    is_full = false;
    EXPECT_EQ(
        run::runCase(device(), planned, hooks, {}, comparisons, cache).result.status,
        report::Status::ok);
}

TEST_F(MeasureTest, TellsHowLongTheDeviceWasAtWork) {
    const report::CaseResult result = measured(smallCase());
    ASSERT_EQ(samplesOf(result, "frame.device.time"), 5u);
    for (const double time : find(result, "frame.device.time")->samples) EXPECT_GT(time, 0.0);
}

// `run` asks the driver for them before the first frame.
TEST_F(MeasureTest, KeepsTheCostsOfShaders) {
    const hair::Settings settings = smallCase();
    Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    report::CaseResult result;
    addShaderCosts(
        std::vector<engine::ShaderProgram>{
            {.name = "Compute", .shaders = {"a.comp"}, .figures = {{"VGPRs", 24.0}}}},
        result);
    measure(device(), test_case, settings.run, {.stop = [] { return false; }}, result);
    EXPECT_EQ(onlySample(result, "shader.a:comp.registers"), 24.0);
    ASSERT_EQ(result.shaders.size(), 1u);
    EXPECT_EQ(samplesOf(result, "frame.time"), 5u);
}

// Plays by hand 2 warm-up frames, 5 counted frames and the one that ends the last of them.
TEST_F(MeasureTest, HashesWhatTheLastFrameLeaves) {
    const hair::Settings settings = smallCase();
    Case by_hand(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    engine::FrameLoop loop(device(), engine::Timing::isolated);
    std::set<std::string> earlier_states;
    for (int i = 0; i < 2 + 5 + 1; ++i) {
        earlier_states.insert(by_hand.stateHash());
        loop.frame([&](engine::Passes& passes) { by_hand.frame(passes); });
        loop.finish();
    }
    const std::vector<std::uint8_t> last = by_hand.picture();
    ASSERT_EQ(earlier_states.size(), 8u);  // so that one frame more or less would be noticed
    ASSERT_FALSE(earlier_states.contains(by_hand.stateHash()));

    Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    report::CaseResult result;
    const std::vector<std::uint8_t> picture =
        measure(device(), test_case, settings.run, {.stop = [] { return false; }}, result);
    ASSERT_EQ(picture.size(), 64u * 36u * 4u);
    EXPECT_EQ(picture, last);
    EXPECT_EQ(result.image_hash, report::hashBytes(std::as_bytes(std::span(last))));
    const std::vector<glm::vec3> guides = by_hand.guides();
    EXPECT_EQ(result.state_hash, report::hashBytes(std::as_bytes(std::span(guides))));
}

// 256 times the work, so that the time of an empty pass is negligible.
TEST_F(MeasureTest, FramesOfWorkAloneTakeLongerTheMoreItIs) {
    const hair::Settings settings = smallCase();
    Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    const MeasureHooks hooks{.stop = [] { return false; }};
    DeviceStage stage(device(), test_case, settings.run, hooks);
    const auto timeOf = [&](std::uint32_t steps) {
        const auto player = stage.emptyPlayer(engine::Timing::isolated, steps);
        player->frame();
        player->frame();
        return player->finish().back();
    };
    EXPECT_TRUE(timeOf(0).passes.empty());
    const engine::FrameRecord little = timeOf(256);
    const engine::FrameRecord much = timeOf(65536);
    ASSERT_TRUE(little.device && much.device);
    EXPECT_GT(*much.device, *little.device);
    EXPECT_GE(much.wall, *much.device);
}

// Every sample of every round is kept, and the hooks are called for each round.
TEST_F(MeasureTest, KeepsTheSamplesOfAllRounds) {
    hair::Settings settings = smallCase();
    settings.run.precision = 0.0f;
    settings.run.max_time = 0.2f;
    std::set<std::string> modes;
    std::uint32_t told = 0;
    const report::CaseResult result = measured(
        settings, {.stop = [] { return false; },
                   .progress =
                       [&](const SamplingState& state) {
                           modes.insert(state.mode);
                           ++told;
                       }});
    std::uint32_t rounds = 0;
    std::uint32_t throttled = 0;
    for (const report::Sampling& mode : result.sampling) {
        rounds += mode.rounds + mode.warmup_rounds;
        throttled += mode.throttled_rounds;
    }
    // A GPU continues to play while the first round of a mode is assessed.
    EXPECT_GE(told + result.sampling.size(), rounds);
    EXPECT_LE(told, rounds + throttled);
    EXPECT_EQ(modes.size(), result.sampling.size());
    const auto samplesIn = [](const report::Sampling& mode) {
        return 5 * mode.rounds * mode.plays;
    };
    EXPECT_EQ(samplesOf(result, "frame.time"), samplesIn(result.sampling[0]));
    EXPECT_EQ(samplesOf(result, "frame.isolated.time"), samplesIn(result.sampling[1]));
    EXPECT_GE(result.sampling[0].seconds, 0.2);
}

// Rounds start over, so any number of them ends with the same hair.
TEST_F(MeasureTest, EndsWithTheSameHairAfterAnyNumberOfRounds) {
    hair::Settings settings = smallCase();
    const report::CaseResult one = measured(settings);
    settings.run.precision = 0.0f;
    settings.run.max_time = 0.1f;
    const report::CaseResult more = measured(settings);
    EXPECT_EQ(more.image_hash, one.image_hash);
    EXPECT_EQ(more.state_hash, one.state_hash);
    EXPECT_THAT(more.trust.warnings, testing::Not(testing::Contains(testing::HasSubstr("differ"))));
    settings.run.frames = 6;  // the hair moves, so another number of frames ends with another state
    EXPECT_NE(measured(settings).state_hash, one.state_hash);
}

// The scene is drawn as lists of triangles: three vertices each.
TEST_F(MeasureTest, CountsEveryPassThatDraws) {
    if (!device().hasPipelineStatistics()) GTEST_SKIP() << "this device counts nothing";
    const report::CaseResult result = measured(smallCase());
    const auto count = [&](const std::string& name) {
        const auto found = std::ranges::find(result.statistics, name, &report::Statistic::name);
        return found == result.statistics.end() ? 0 : found->measured;
    };
    EXPECT_GT(count("tessellation_control_patches"), 0u);
    EXPECT_GT(count("scene.input_assembly_primitives"), 0u);
    EXPECT_EQ(count("scene.input_assembly_vertices"), 3 * count("scene.input_assembly_primitives"));
    EXPECT_EQ(count("strands.vertex_invocations"), 0u);
}

TEST_F(MeasureTest, BusyWorkChangesNoPictureNoStateAndNoCount) {
    hair::Settings settings = smallCase();
    settings.render.ssaa = 2;  // so that there is a resolve pass
    const report::CaseResult plain = measured(settings);
    settings.run.busy_work = 2000;
    for (const char* pass : {"wind", "simulate", "scene", "strands", "resolve"}) {
        settings.run.busy_pass = pass;
        const report::CaseResult busy = measured(settings);
        EXPECT_EQ(busy.image_hash, plain.image_hash) << pass;
        EXPECT_EQ(busy.state_hash, plain.state_hash) << pass;
        ASSERT_EQ(busy.statistics.size(), plain.statistics.size());
        for (std::size_t i = 0; i < busy.statistics.size(); ++i)
            EXPECT_EQ(busy.statistics[i].measured, plain.statistics[i].measured)
                << pass << ' ' << busy.statistics[i].name;
    }
}

TEST_F(MeasureTest, SlowsDownNoPassThatIsNotThere) {
    hair::Settings settings = smallCase();
    settings.run.busy_pass = "shadow";
    EXPECT_EQ(
        errorText([&] { measured(settings); }),
        "/run/busy_pass: unknown pass 'shadow'; known: wind, simulate, scene, strands");
}

// On a software device, a frame costs what it costs the processor.
TEST_F(MeasureTest, TellsWhatASoftwareDeviceUses) {
    const bool software = device().info().type == engine::DeviceType::cpu;
    const report::CaseResult result = measured(smallCase());
    for (const char* name : {"frame.cpu.time", "pass.wind.cpu.time", "pass.strands.cpu.time"}) {
        ASSERT_EQ(samplesOf(result, name), software ? 5u : 0u) << name;
        if (!software) continue;
        for (const double time : find(result, name)->samples) EXPECT_GE(time, 0.0) << name;
    }
    if (software) {
        EXPECT_GT(std::ranges::max(find(result, "frame.cpu.time")->samples), 0.0);
    }
}

TEST_F(MeasureTest, StopsWhenAsked) {
    int asked = 0;
    hair::Settings settings = smallCase();
    settings.run.max_time = 3600.0f;
    settings.run.precision = 0.0f;
    EXPECT_THROW(measured(settings, {.stop = [&] { return ++asked > 30; }}), engine::Interrupted);
    EXPECT_EQ(asked, 31);
}

class RoundPlayerTest : public GpuTest {
protected:
    // Frames advance by a third of a step, so that only every third frame simulates. The passes
    // then identify these frames; their times do not matter.
    static hair::Settings thirdsOfSteps() {
        hair::Settings settings = smallCase();
        settings.simulation.time_step = 1.0f / 60.0f;
        settings.run.frame_time = 1.0f / 180.0f;
        return settings;
    }

    static std::vector<bool> simulating(const std::vector<engine::FrameRecord>& frames) {
        std::vector<bool> all;
        for (const engine::FrameRecord& frame : frames)
            all.push_back(
                std::ranges::find(frame.passes, "simulate", &engine::PassTime::name) !=
                frame.passes.end());
        return all;
    }
};

TEST_F(RoundPlayerTest, GivesTheFramesAfterTheWarmUpInEveryRound) {
    const hair::Settings settings = thirdsOfSteps();
    Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    std::uint32_t played = 0;
    const MeasureHooks hooks{.stop = [&] {
        ++played;
        return false;
    }};
    for (const engine::Timing timing :
         {engine::Timing::overlapped, engine::Timing::isolated, engine::Timing::wall_clock})
        for (const auto& [warmup, frames] :
             {std::pair{2u, 5u}, std::pair{3u, 4u}, std::pair{6u, 1u}}) {
            const hair::RunSettings run{
                .warmup = warmup, .frames = frames, .overlapped_stamps = true};
            DeviceStage stage(device(), test_case, run, hooks);
            RoundPlayer player(stage.player(timing), run);
            std::vector<bool> expected;
            for (std::uint32_t frame = warmup + 1; frame <= warmup + frames; ++frame)
                expected.push_back(frame % 3 == 0);
            for (int round = 0; round < 3; ++round) {
                played = 0;
                EXPECT_EQ(simulating(player.round()), expected)
                    << warmup << " to warm up, " << frames << ", round " << round;
                EXPECT_EQ(played, warmup + frames + 1);  // the additional frame ends the last of
                                                         // them
            }
        }
}

TEST_F(RoundPlayerTest, HashesEveryRowAndEveryGuide) {
    const hair::Settings settings = smallCase();
    Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    const MeasureHooks hooks{.stop = [] { return false; }};
    DeviceStage stage(device(), test_case, settings.run, hooks);
    RoundPlayer player(stage.player(engine::Timing::isolated), settings.run);
    player.round();
    const RoundEnd& end = player.firstEnd();
    ASSERT_EQ(end.picture.size(), 64u * 36u * 4u);
    EXPECT_EQ(end.picture, test_case.picture());
    const std::string picture = report::hashBytes(std::as_bytes(std::span(end.picture)));
    EXPECT_EQ(end.picture_hash, picture);
    EXPECT_EQ(test_case.pictureHash(), picture);
    const std::vector<glm::vec3> guides = test_case.guides();
    ASSERT_EQ(
        guides.size(),
        std::size_t{test_case.groom().strand_count} * test_case.groom().vertices_per_strand);
    EXPECT_EQ(end.state_hash, report::hashBytes(std::as_bytes(std::span(guides))));
}

// A round has two frames of warm-up, five that are measured and one more; the start comes before
// them. Times and hashes belong to frames without probes.
TEST_F(MeasureTest, PlaysProbesApartFromTheFrames) {
    hair::Settings settings = smallCase();
    const report::CaseResult without = measured(settings);
    settings.run.probes = {.tip_displacement = true, .energy = true};
    const report::CaseResult with = measured(settings);
    EXPECT_EQ(with.state_hash, without.state_hash);
    EXPECT_EQ(with.image_hash, without.image_hash);
    // "... made different states", "frames with probes made other states". A busy machine may earn
    // other warnings, which are about times.
    EXPECT_THAT(with.trust.warnings, Each(Not(ContainsRegex("made (different|other)"))));
    std::set<std::string> added;
    for (const report::Metric& each : with.metrics) added.insert(each.name());
    for (const report::Metric& each : without.metrics) added.erase(each.name());
    EXPECT_THAT(
        added, testing::UnorderedElementsAre(
                   "probe.time", "probe.tip_displacement.mean", "probe.tip_displacement.median",
                   "probe.tip_displacement.percentile_90", "probe.tip_displacement.maximum",
                   "probe.kinetic_energy", "probe.gravitational_energy", "probe.pass.time"));
    for (const std::string& name : added) EXPECT_EQ(samplesOf(with, name), 9u) << name;
    const std::vector<double>& times = find(with, "probe.time")->samples;
    for (std::size_t frame = 0; frame < times.size(); ++frame)
        EXPECT_NEAR(times[frame], static_cast<double>(frame) / 60.0, 1e-6);
    EXPECT_EQ(find(with, "memory.device")->samples, find(without, "memory.device")->samples);
}

// The last sample is of the state that is hashed: the tips of a case that played the same frames.
TEST_F(MeasureTest, ProbesEndWithTheHashedState) {
    hair::Settings settings = smallCase();
    settings.run.probes.tip_displacement = true;
    const report::CaseResult result = measured(settings);
    Case again(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
    const std::uint32_t vertices = again.groom().vertices_per_strand;
    engine::FrameLoop loop(device(), engine::Timing::isolated);
    for (int i = 0; i < 8; ++i) loop.frame([&](engine::Passes& passes) { again.simulate(passes); });
    loop.finish();
    ASSERT_EQ(again.stateHash(), result.state_hash);
    const std::vector<glm::vec3> guides = again.guides();
    double sum = 0.0;
    for (std::size_t tip = vertices - 1; tip < guides.size(); tip += vertices)
        sum += glm::distance(glm::dvec3(guides[tip]), glm::dvec3(again.groom().points[tip]));
    const double mean = sum / again.groom().strand_count;
    // Distances of 32-bit positions.
    EXPECT_NEAR(find(result, "probe.tip_displacement.mean")->samples.back(), mean, 1e-7);
}

}  // namespace
}  // namespace benchmarks::measure
