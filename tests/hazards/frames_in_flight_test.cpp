#include <algorithm>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "engine/frame_loop.h"
#include "engine/hazards.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"

// Tests several frames in flight, and the passes of one frame that may overlap with the next.
namespace benchmarks::measure {
namespace {

hair::Settings movingHair(hair::Solver solver) {
    hair::Settings settings = hair::plainSettings();
    settings.render.width = 32;
    settings.render.height = 24;
    settings.strands.density = 2;
    settings.simulation.solver = solver;
    return settings;
}

struct Ends {
    std::string picture;
    std::string state;
    bool operator==(const Ends&) const = default;
};

// Plays the first frames twice in one stream and returns their result.
Ends ends(
    const engine::Device& device, Case& played, engine::Timing timing,
    const engine::Overlap& overlap) {
    played.reset();
    engine::FrameLoop loop(device, timing, overlap);
    for (int i = 0; i < 18; ++i)
        loop.frame([&](engine::Passes& passes) {
            if (i == 9) played.recordReset(passes);
            played.frame(passes);
        });
    loop.finish();
    return {played.pictureHash(), played.stateHash()};
}

using FramesInFlight = GpuTest;

// Expects the same result for every overlap, with offsets, shadows and substeps.
void expectEqualEnds(
    const engine::Device& device, hair::Solver solver, float steps, bool interpolate = false) {
    hair::Settings settings = movingHair(solver);
    settings.run.interpolate = interpolate;
    hair::lit(settings);
    settings.shading.shadows.resolution = 64;
    settings.strands.curl.radius = 0.004f;
    settings.simulation.substeps = 2;
    settings.simulation.motion.keyframes = {
        {.time = 0.0f}, {.time = 1.0f, .translation = {0.1f, 0.0f, 0.0f}}};
    settings.run.frame_time = steps * settings.simulation.time_step;
    Case played(device, settings, HAIRBENCH_SCENES_DIR);
    const Ends alone = ends(device, played, engine::Timing::isolated, {.frames = 1});
    for (std::uint32_t in_flight = 1; in_flight <= 4; ++in_flight)
        for (const bool async : {false, true})
            EXPECT_EQ(
                ends(
                    device, played, engine::Timing::overlapped,
                    {.frames = in_flight, .async = async}),
                alone)
                << in_flight << " frames in flight, " << steps << " steps a frame"
                << (async ? ", two submissions" : "");
}

TEST_F(FramesInFlight, EndAlikeHoweverManyThereAre) {
    for (const hair::Solver solver :
         {hair::Solver::shape, hair::Solver::ftl, hair::Solver::rod, hair::Solver::stable_cosserat,
          hair::Solver::position_based_rod, hair::Solver::augmented_mass_spring,
          hair::Solver::none})
        expectEqualEnds(device(), solver, 1.0f);
}

// The copies of the guides then swap only in some frames. A frame of several steps swaps them once.
TEST_F(FramesInFlight, EndAlikeWhereFramesAreShorterOrLongerThanSteps) {
    expectEqualEnds(device(), hair::Solver::shape, 0.4f);
    expectEqualEnds(device(), hair::Solver::shape, 2.5f);
    expectEqualEnds(device(), hair::Solver::shape, 0.4f, true);
    expectEqualEnds(device(), hair::Solver::rod, 2.5f, true);
}

// Whether nothing orders a stage of a frame's strand draws before the next frame's `simulate`.
// Plants a read of an extra buffer in the draws and a write in `simulate`: these are a hazard if
// nothing orders them.
bool mayRunBeside(
    const engine::Device& device, const hair::Settings& settings, VkPipelineStageFlags2 stage) {
    Case played(device, settings, HAIRBENCH_SCENES_DIR);
    engine::HazardLog& log = *device.hazards();
    engine::FrameLoop loop(device, engine::Timing::overlapped);
    log.keepRecordings();
    log.takeRecordings();
    for (int i = 0; i < 4; ++i) loop.frame([&](engine::Passes& passes) { played.frame(passes); });
    loop.finish();
    std::vector<engine::Recording> recordings = log.takeRecordings();
    constexpr engine::ResourceId kPlanted = 0xffffffff;
    const auto plant = [&](std::size_t frame, const std::string& pass, engine::Scope scope) {
        engine::Recording& recording = recordings.at(frame);
        for (std::size_t i = recording.size(); i-- > 0;) {
            if (recording[i].pass != pass || recording[i].uses.empty()) continue;
            recording[i].uses.push_back({kPlanted, scope});
            return;
        }
        FAIL() << "no pass " << pass;
    };
    plant(2, "strands", {stage, VK_ACCESS_2_SHADER_READ_BIT});
    plant(3, "simulate", {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_WRITE_BIT});
    engine::HazardChecker checker;
    std::size_t hazards = 0;
    for (const engine::Recording& recording : recordings)
        hazards += checker.submit(recording).size();
    return hazards == 1;
}

constexpr VkPipelineStageFlags2 kVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;

TEST_F(FramesInFlight, TheNextSimulationMayRunBesideTheDrawing) {
    for (const hair::Solver solver :
         {hair::Solver::shape, hair::Solver::ftl, hair::Solver::rod, hair::Solver::stable_cosserat,
          hair::Solver::position_based_rod, hair::Solver::augmented_mass_spring}) {
        hair::Settings settings = movingHair(solver);
        for (const VkPipelineStageFlags2 stage : {kVertex, kFragment})
            EXPECT_TRUE(mayRunBeside(device(), settings, stage));
        settings.strands.curl.radius = 0.004f;
        settings.run.frame_time = 2.0f * settings.simulation.time_step;
        for (const VkPipelineStageFlags2 stage : {kVertex, kFragment})
            EXPECT_TRUE(mayRunBeside(device(), settings, stage));
    }
}

// A resolve by compute is between them: see docs/design.md.
TEST_F(FramesInFlight, AResolveByComputeIsWaitedFor) {
    hair::Settings settings = movingHair(hair::Solver::shape);
    settings.render.ssaa = 2;
    EXPECT_FALSE(mayRunBeside(device(), settings, kFragment));
}

// Lets work beside drawing wait for one frame less than it should.
class EagerPasses : public engine::Passes {
public:
    explicit EagerPasses(engine::Passes& passes) : passes_(passes) { slot_ = passes.slot(); }

    void pass(
        const char* name, engine::PassKind kind,
        engine::FunctionRef<void(engine::Commands&)> record) override {
        passes_.pass(name, kind, record);
    }
    void asyncCompute(std::uint32_t frames, engine::FunctionRef<void()> record) override {
        passes_.asyncCompute(frames + 1, record);
    }

private:
    engine::Passes& passes_;
};

// Only semaphores order the two queues, so a missing wait is a hazard.
TEST_F(FramesInFlight, TheSecondQueueWaitsForThePicturesOfTheCopyThatItOverwrites) {
    Case played(device(), movingHair(hair::Solver::shape), HAIRBENCH_SCENES_DIR);
    const auto messages = [&](bool eager) {
        engine::FrameLoop loop(device(), engine::Timing::overlapped, {.frames = 4, .async = true});
        for (int i = 0; i < 8; ++i)
            loop.frame([&](engine::Passes& passes) {
                EagerPasses less(passes);
                played.frame(eager ? less : passes);
            });
        loop.finish();
        return device().messages().take();
    };
    EXPECT_THAT(messages(false), testing::IsEmpty());
    EXPECT_THAT(
        messages(true), testing::Contains(testing::HasSubstr("write after read of 'guide")));
}

}  // namespace
}  // namespace benchmarks::measure
