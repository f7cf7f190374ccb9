#include "benchmarks/measure.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/error_text.h"
#include "tests/gpu_fixture.h"

namespace benchmarks {
namespace {

using testing::IsEmpty;

// A little of the thesis's hair in the wind, in a small picture.
hair::Settings smallCase() {
    hair::Settings settings;
    settings.strands.density = 2;
    settings.strands.tessellation = 1;
    settings.render.width = 64;
    settings.render.height = 36;
    settings.simulation.wind.strength = 10.0f;
    settings.run = {.warmup = 2, .frames = 5, .max_time = 0.0f};
    return settings;
}

const Metric* find(const CaseResult& result, const std::string& name) {
    const auto found = std::ranges::find(result.metrics, name, &Metric::name);
    return found == result.metrics.end() ? nullptr : &*found;
}

std::size_t samplesOf(const CaseResult& result, const std::string& name) {
    const Metric* metric = find(result, name);
    return metric ? metric->samples.size() : 0;
}

class MeasureTest : public GpuTest {
protected:
    static CaseResult
    measured(const hair::Settings& settings, const MeasureHooks& hooks = {.stop = [] {
                                                 return false;
                                             }}) {
        Case test_case(device(), settings, HAIRBENCH_SOURCE_DIR "/scenes");
        CaseResult result;
        measure(device(), test_case, settings.run, hooks, result);
        return result;
    }
};

TEST_F(MeasureTest, PlaysOneRoundOfEachModeWithoutTime) {
    const CaseResult result = measured(smallCase());
    EXPECT_EQ(samplesOf(result, "frame.time"), 5u);
    EXPECT_EQ(samplesOf(result, "frame.isolated.time"), 5u);
    EXPECT_EQ(samplesOf(result, "frame.first.time"), 1u);
    EXPECT_EQ(samplesOf(result, "pass.strands.time"), 5u);
    ASSERT_GE(result.sampling.size(), 2u);
    EXPECT_EQ(result.sampling[0].mode, "overlapped");
    EXPECT_EQ(result.sampling[1].mode, "isolated");
    for (const Sampling& mode : result.sampling) EXPECT_EQ(mode.rounds, 1u);
}

// Every sample of every round is kept, and the hooks are told of each round.
TEST_F(MeasureTest, KeepsTheSamplesOfAllRounds) {
    hair::Settings settings = smallCase();
    settings.run.precision = 0.0f;
    settings.run.max_time = 0.2f;
    std::set<std::string> modes;
    std::uint32_t told = 0;
    const CaseResult result = measured(
        settings, {.stop = [] { return false; },
                   .progress =
                       [&](const SamplingState& state) {
                           modes.insert(state.mode);
                           ++told;
                       }});
    std::uint32_t rounds = 0;
    std::uint32_t throttled = 0;
    for (const Sampling& mode : result.sampling) {
        rounds += mode.rounds + mode.warmup_rounds;
        throttled += mode.throttled_rounds;
    }
    EXPECT_GE(told, rounds);
    EXPECT_LE(told, rounds + throttled);
    EXPECT_EQ(modes.size(), result.sampling.size());
    EXPECT_EQ(samplesOf(result, "frame.time"), 5 * result.sampling[0].rounds);
    EXPECT_EQ(samplesOf(result, "frame.isolated.time"), 5 * result.sampling[1].rounds);
    EXPECT_GE(result.sampling[0].seconds, 0.2);
}

// Rounds start over, so however many there are, they end with the same hair.
TEST_F(MeasureTest, EndsWithTheSameHairAfterAnyNumberOfRounds) {
    hair::Settings settings = smallCase();
    const CaseResult one = measured(settings);
    settings.run.precision = 0.0f;
    settings.run.max_time = 0.1f;
    const CaseResult more = measured(settings);
    EXPECT_EQ(more.image_hash, one.image_hash);
    EXPECT_EQ(more.state_hash, one.state_hash);
    EXPECT_THAT(more.trust.warnings, testing::Not(testing::Contains(testing::HasSubstr("differ"))));
    settings.run.frames = 6;  // the hair moves: another number of frames ends elsewhere
    EXPECT_NE(measured(settings).state_hash, one.state_hash);
}

TEST_F(MeasureTest, BusyWorkChangesNoPictureNoStateAndNoCount) {
    hair::Settings settings = smallCase();
    const CaseResult plain = measured(settings);
    settings.run.busy_work = 2000;
    for (const char* pass : {"wind", "simulate", "scene", "strands", "resolve"}) {
        settings.run.busy_pass = pass;
        const CaseResult busy = measured(settings);
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
        "/run/busy_pass: there is no pass 'shadow'; there are wind, simulate, scene, strands, "
        "resolve");
}

// On a software device what a frame costs the processor is what a frame costs.
TEST_F(MeasureTest, TellsWhatASoftwareDeviceUses) {
    const bool software = device().info().type == "cpu";
    const CaseResult result = measured(smallCase());
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
    EXPECT_THROW(measured(settings, {.stop = [&] { return ++asked > 30; }}), Interrupted);
    EXPECT_EQ(asked, 31);
}

}  // namespace
}  // namespace benchmarks
