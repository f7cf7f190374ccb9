#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/stage.h"
#include "benchmarks/measure/steady_state.h"
#include "benchmarks/report/report.h"
#include "engine/frame_loop.h"

// Rounds of one mode of a case, until its median frame time is known.
namespace benchmarks::measure {

// Plays a case in one mode again and again from its first frame on: /run/warmup frames, then
// /run/frames frames that count. So all plays of all modes show the same frames, and must end with
// the same picture and state.
class RoundPlayer {
public:
    // Whether the frame that ends the first round, which no sample is of, is counted
    // (Player::count()). Not where frames overlap: it ends the interval of the one before.
    enum class Counts { nothing, last_frame };

    // `queue`: how many frames have to be begun, without a wait for all between them, before the
    // first that counts; where fewer are to warm up, others are played first.
    RoundPlayer(
        std::unique_ptr<Player> player, const hair::RunSettings& run,
        Counts counts = Counts::nothing, std::uint32_t queue = 0);

    // One play, waited for: the frames that count.
    std::vector<engine::FrameRecord> round();

    // As many frames as count in a round, from where the case is: no play, as it begins nowhere.
    std::vector<engine::FrameRecord> more();

    // Plays without a pause, one after the other, and nothing read between them: the frames that
    // count of the next so many plays. What is in flight when this returns is of the play after.
    std::vector<engine::FrameRecord> stream(std::uint32_t plays);
    // Ends a stream: waits for what is in flight and drops it.
    void drain();

    // CPU ms from the start of recording the very first frame until it was complete.
    double firstFrame() const { return first_frame_; }

    // Picture and state of the first play, and of the last one so far. Reading them back takes
    // time, so it is done between plays and for these two only. Nothing may be in flight.
    const RoundEnd& firstEnd();
    RoundEnd lastEnd();

private:
    void play();

    std::unique_ptr<Player> player_;
    std::uint32_t warmup_;
    std::uint32_t frames_;
    Counts counts_;
    std::uint32_t queue_;
    std::uint64_t plays_ = 0;
    double first_frame_ = 0.0;
    std::vector<engine::FrameRecord> complete_;  // of a stream, from the first frame of a play on
    std::optional<RoundEnd> first_end_;
};

struct SamplingRule {
    std::string mode;  // "overlapped", "isolated", "wall_clock"
    double engine::FrameRecord::* time = nullptr;  // of a frame, ms: what has to be known
    double precision = 0.01;  // half the median's interval over it; 0: until max_time
    double max_time = 10.0;  // s, after which no round is begun; 0: one round
    std::uint32_t most_rounds = std::numeric_limits<std::uint32_t>::max();
    // Whether the first round's last frame is counted.
    bool counts = false;
    // Whether the samples are looked at while the next round is played, so that the device is never
    // left without work.
    bool looks_beside = false;
};

// What a series of rounds is played with.
struct SamplingTools {
    std::function<std::vector<engine::FrameRecord>()> play;  // a round; as many frames each time
    std::function<void()> begin{};  // before the first round and after a pause; may be empty
    std::function<report::Conditions()> conditions;  // of the round that was just played
    std::function<double()> seconds;  // of a clock
    std::function<void(double)> pause;  // s
    std::function<void(const SamplingState&)> progress{};  // after each round; may be empty
};

struct SampledRounds {
    std::vector<engine::FrameRecord> frames;  // of the rounds that count, in order
    report::Sampling sampling;
    std::vector<report::Conditions> conditions;  // of all rounds
    // Whether all rounds were throttled: the frames are of those then.
    bool all_throttled = false;
    std::optional<double> clock_mhz;  // of the shaders, median over the rounds that count
};

inline constexpr double kThrottlePause = 0.05;  // s (nvbench's)

// Rounds that are tried at least before a case is given up as throttled.
inline constexpr std::uint32_t kThrottledTries = 10;

// Plays rounds until the median time is known to the precision and the last times were steady
// (steady_state.h), until there are most_rounds, or until max_time has passed. `held_mhz` is what
// the device's clock held before under as much load, and is raised to what it holds here; it may be
// null. Throttled rounds (isThrottled(); a round is judged again when a later one holds a higher
// clock) are left out, each followed by a pause; so are the first rounds while times settle. If all
// were throttled, kThrottledTries and until max_time, those are the result.
SampledRounds
sampleRounds(const SamplingRule& rule, const SamplingTools& tools, double* held_mhz = nullptr);

// A mode of a case, sampled.
struct SampledMode : SampledRounds {
    double first_frame = 0.0;  // ms, from recording to completion, of the mode's first
    RoundEnd end;  // of the last round; empty where frames follow on others
};

// The rule of a mode by a scene's settings: the overlapped mode is judged by its intervals, the
// others by their wall clock.
SamplingRule samplingRule(engine::Timing timing, const hair::RunSettings& run);

// Plays the mode's rounds: on a processor each is one play, on other devices as many as take
// /run/round_time, after the clock was driven up (warmUp()). Enters its sampling, and warns in
// `result` if its first and last plays made different pictures or states. Where there is no time,
// wall-clock frames are those that follow on what was played before.
SampledMode sampleMode(
    Stage& stage, engine::Timing timing, const SamplingRule& rule, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result);

// What a device's warm-up found.
struct WarmUp {
    double seconds = 0.0;
    double play = 0.0;  // s, of a play at its end
    double counted = 0.0;  // ms of the rule's time in the frames of a play that count
    bool steady = false;
};

// Plays for at least /run/warmup_time and until two windows of 50 ms differ by less than a
// hundredth in their median frame, by `time` and by the device's own, but no longer than `most`
// seconds: what a clock needs to rise.
WarmUp warmUp(
    RoundPlayer& player, Stage& stage, double engine::FrameRecord::* time, double least,
    double most);

}  // namespace benchmarks::measure
