// Tests frames that are drawn between two steps: /run/interpolate.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/measure/case.h"
#include "engine/frame_loop.h"
#include "hair/groom/files.h"
#include "tests/golden/features.h"
#include "tests/gpu_fixture.h"
#include "tests/temporary_folder.h"

namespace benchmarks::measure {
namespace {

constexpr float kSpeed = 0.25f;  // m/s
constexpr float kFrame = 1.0f / 60.0f;  // s
constexpr int kPlayedFrames = 112;

hair::Settings uniformMotion(float time_step, bool interpolate) {
    hair::Settings settings = hair::plainSettings();
    settings.render.width = 32;
    settings.render.height = 24;
    settings.strands.density = 2;
    settings.simulation.solver = hair::Solver::shape;
    settings.simulation.time_step = time_step;
    // Slopes at inner keyframes are those of both neighbours, so the motion is uniform between
    // them.
    for (const float time : {0.0f, 1.0f, 2.0f, 3.0f})
        settings.simulation.motion.keyframes.push_back(
            {.time = time, .translation = {time * kSpeed, 0.0f, 0.0f}});
    settings.run.frame_time = kFrame;
    settings.run.interpolate = interpolate;
    return settings;
}

struct Played {
    std::vector<double> roots;  // [frame], x of the first guide's drawn root, m
    std::vector<double> heads;  // [frame], x of the head, m
    std::string state;
};

Played play(const engine::Device& device, const hair::Settings& settings) {
    Case played(device, settings, HAIRBENCH_SCENES_DIR);
    engine::FrameLoop loop(device, engine::Timing::isolated);
    Played result;
    const double rest = played.groom().points.front().x;
    for (int i = 0; i < kPlayedFrames; ++i) {
        loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        result.roots.push_back(double{played.drawnGuides().front().x} - rest);
        result.heads.push_back(played.head()(glm::vec3(0.0f)).x);
    }
    result.state = played.stateHash();
    return result;
}

// The first frame of which both steps are in the uniform motion, for steps of up to 1/15 s.
constexpr std::size_t kFirst = 70;

// Returns the greatest deviation of a frame's displacement from that of the uniform motion, m.
double unevenness(const std::vector<double>& positions) {
    double most = 0.0;
    for (std::size_t i = kFirst + 1; i < positions.size(); ++i)
        most = std::max(
            most, std::abs(positions[i] - positions[i - 1] - double{kSpeed} * double{kFrame}));
    return most;
}

using InterpolatedFrames = GpuTest;

// A frame advances the head by 4.17 mm. Positions of up to 0.5 m are rounded to 3e-8 m a few times.
// The count of steps is off by less than 1e-6 steps a frame, 112e-6 steps or 2 µm of motion at the
// end, and by as much of one step between two frames.
TEST_F(InterpolatedFrames, MoveEvenlyIfStepsDoNotDivideThem) {
    constexpr double kTolerance = 2e-6;  // m
    for (const float time_step : {0.01f, 1.0f / 15.0f}) {
        const Played even = play(device(), uniformMotion(time_step, true));
        EXPECT_LT(unevenness(even.roots), kTolerance) << time_step;
        EXPECT_LT(unevenness(even.heads), kTolerance) << time_step;
        for (std::size_t i = kFirst; i < even.roots.size(); ++i) {
            // One step late.
            const double time = (static_cast<double>(i) + 1.0) * double{kFrame} - double{time_step};
            EXPECT_NEAR(even.roots[i], double{kSpeed} * time, kTolerance) << i;
            EXPECT_NEAR(even.heads[i], even.roots[i], kTolerance) << i;
        }
        // Without it, frames of 0, 1, 2 steps differ by half a step's displacement or more.
        const Played uneven = play(device(), uniformMotion(time_step, false));
        EXPECT_GT(unevenness(uneven.roots), 0.3 * double{kSpeed} * double{time_step});
        EXPECT_EQ(even.state, uneven.state);  // the simulation is the same
    }
}

// Guides of files; the thesis's own above are of .hgl.
TEST_F(InterpolatedFrames, MoveEvenlyWithFilesOfOtherFormats) {
    constexpr double kTolerance = 2e-6;  // m, as above
    hair::groom::StrandSet strands{.metres_per_unit = 1.0};
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 4; ++k)
            strands.points.emplace_back(0.02f * i, 0.02f * k, 0.002f * i * i);
        strands.ends.push_back(static_cast<std::uint32_t>(strands.points.size()));
    }
    const TemporaryFolder folder;
    for (const std::string extension : {".hair", ".abc", ".npz", ".ply"}) {
        SCOPED_TRACE(extension);
        hair::Settings settings = uniformMotion(0.01f, true);
        const auto path = folder.file("guides" + extension);
        hair::groom::exportStrands(strands, path);
        settings.groom.file = path.string();
        const Played even = play(device(), settings);
        EXPECT_LT(unevenness(even.roots), kTolerance);
        EXPECT_LT(unevenness(even.heads), kTolerance);
    }
}

TEST_F(InterpolatedFrames, StartAgainAfterAReset) {
    Case played(device(), uniformMotion(0.01f, true), HAIRBENCH_SCENES_DIR);
    engine::FrameLoop loop(device(), engine::Timing::isolated);
    const auto frame = [&] {
        loop.frame([&](engine::Passes& passes) { played.frame(passes); });
        return played.pictureHash();
    };
    std::vector<std::string> first;
    for (int i = 0; i < 4; ++i) first.push_back(frame());
    played.reset();
    for (int i = 0; i < 4; ++i) EXPECT_EQ(frame(), first[static_cast<std::size_t>(i)]) << i;
}

TEST_F(InterpolatedFrames, CountStepsOfAFrame) {
    const auto stepsOf = [&](float time_step) {
        Case played(device(), uniformMotion(time_step, false), HAIRBENCH_SCENES_DIR);
        std::vector<std::uint64_t> steps;
        for (const auto& [name, count] : played.counts())
            if (name.ends_with("steps_per_frame")) steps.push_back(count);
        return steps;
    };
    EXPECT_EQ(stepsOf(0.01f), (std::vector<std::uint64_t>{1, 2}));
    EXPECT_EQ(stepsOf(1.0f / 15.0f), (std::vector<std::uint64_t>{0, 1}));
    EXPECT_EQ(stepsOf(1.0f / 120.0f), (std::vector<std::uint64_t>{2, 2}));
}

}  // namespace
}  // namespace benchmarks::measure
