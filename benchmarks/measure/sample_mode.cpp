#include "benchmarks/measure/sample_mode.h"

#include <chrono>
#include <thread>

namespace benchmarks {

namespace {

using engine::FrameRecord;
using engine::Timing;
using Seconds = std::chrono::duration<double>;

Mode modeOf(Timing timing) {
    switch (timing) {
    case Timing::overlapped:
        return Mode::overlapped;
    case Timing::isolated:
        return Mode::isolated;
    case Timing::wall_clock:
        return Mode::wall_clock;
    case Timing::statistics:
        break;
    }
    return Mode::other;
}

}  // namespace

SamplingRule samplingRule(Timing timing, const hair::RunSettings& run) {
    return {
        .mode = modeName(modeOf(timing)),
        .time = timing == Timing::overlapped ? &FrameRecord::interval : &FrameRecord::wall,
        .precision = double{run.precision},
        .max_time = double{run.max_time}};
}

SampledMode sampleMode(
    const Play& play, Timing timing, const SamplingRule& rule, MachineWatch& watch,
    CaseResult& result) {
    RoundPlayer player(play, timing);
    const SamplingTools tools{
        .play =
            [&] {
                std::vector<FrameRecord> frames = player.round();
                if (play.busy) play.busy->checkThatItRan();
                return frames;
            },
        .begin_watch = [&] { watch.begin(); },
        .end_watch = [&] { return watch.end(); },
        .seconds =
            [] { return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count(); },
        .pause = [](double seconds) { std::this_thread::sleep_for(Seconds(seconds)); },
        .progress = play.hooks.progress};
    SampledMode mode{sampleRounds(rule, tools), player.firstFrame(), player.lastEnd()};
    const RoundEnd& first = player.firstEnd();
    if (mode.end.picture_hash != first.picture_hash)
        result.trust.warnings.push_back(rule.mode + " rounds made different pictures");
    if (mode.end.state_hash != first.state_hash)
        result.trust.warnings.push_back(rule.mode + " rounds made different states");
    result.sampling.push_back(mode.sampling);
    return mode;
}

}  // namespace benchmarks
