#include "benchmarks/doctor/play_pairs.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/doctor/doctor_scene.h"
#include "benchmarks/measure/check_timestamps.h"
#include "benchmarks/measure/round_player.h"
#include "benchmarks/scratch_folder.h"
#include "benchmarks/statistics.h"
#include "benchmarks/trust.h"
#include "engine/process_use.h"

namespace benchmarks {

namespace {

constexpr int kPairs = 12;
constexpr int kRounds = 3;  // of isolated frames

// What a round took.
struct Cost {
    double frame;  // ms, median from one frame's start to the next one's
    double cpu;    // ms, of all threads of this process
};

Cost costOf(RoundPlayer& player) {
    const engine::ProcessUse before = engine::processUse();
    std::vector<double> intervals;
    for (const engine::FrameRecord& frame : player.round()) intervals.push_back(frame.interval);
    return {summarize(intervals).median, (engine::processUse() - before).cpu};
}

}  // namespace

PassFacts examinePasses(const engine::Device& device, const MeasureHooks& hooks) {
    const ScratchFolder folder;
    writeDoctorScene(folder.path());
    const hair::Settings settings = doctorSettings();
    Case test_case(device, settings, folder.path());
    const Play play{.device = device, .test_case = test_case, .run = settings.run, .hooks = hooks};
    RoundPlayer player(play, engine::Timing::isolated);
    // A busy machine only ever adds time outside the passes or between them: the round whose sum is
    // nearest to the wall clock tells most of the device.
    PassFacts facts;
    double nearest = INFINITY;
    for (int i = 0; i < kRounds; ++i) {
        const double ratio = passSumOverWall(player.round());
        if (std::abs(ratio - 1.0) >= nearest) continue;
        nearest = std::abs(ratio - 1.0);
        facts.sum_over_wall = ratio;
    }
    facts.faults = checkTimestamps(device, [&](engine::FrameLoop& loop) { playFrame(loop, play); });
    return facts;
}

RepeatFacts examineRepeat(const engine::Device& device, const MeasureHooks& hooks) {
    const ScratchFolder folder;
    writeDoctorScene(folder.path());
    const hair::Settings settings = doctorSettings();
    Case case_a(device, settings, folder.path());
    Case case_b(device, settings, folder.path());
    RoundPlayer a(
        {.device = device, .test_case = case_a, .run = settings.run, .hooks = hooks},
        engine::Timing::overlapped);
    RoundPlayer b(
        {.device = device, .test_case = case_b, .run = settings.run, .hooks = hooks},
        engine::Timing::overlapped);
    // Pipelines and caches warm up.
    a.round();
    b.round();
    RepeatFacts facts;
    for (int pair = 0; pair < kPairs; ++pair) {
        const bool a_first = pair % 2 == 0;
        const Cost first = costOf(a_first ? a : b);
        const Cost second = costOf(a_first ? b : a);
        const double sign = a_first ? 1.0 : -1.0;
        facts.frame.push_back(sign * std::log(second.frame / first.frame));
        facts.cpu.push_back(sign * std::log(second.cpu / first.cpu));
    }
    const RoundEnd end_a = a.lastEnd();
    const RoundEnd end_b = b.lastEnd();
    facts.same_picture =
        end_a.picture_hash == a.firstEnd().picture_hash && end_a.picture_hash == end_b.picture_hash;
    facts.same_state =
        end_a.state_hash == a.firstEnd().state_hash && end_a.state_hash == end_b.state_hash;
    return facts;
}

}  // namespace benchmarks
