#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/busy_work.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/report/report.h"
#include "engine/frame_loop.h"

// Rounds of one mode of a case, until its median frame time is known.
namespace benchmarks::measure {

// What a case's frames are played with.
struct Play {
    const engine::Device& device;
    Case& test_case;
    const hair::RunSettings& run;
    const MeasureHooks& hooks;
    BusyPass* busy = nullptr;  // null: no pass is slowed down
};

// Plays the next frame. Throws Interrupted where the user asks to stop.
void playFrame(engine::FrameLoop& loop, const Play& play);

// What a round ends with.
struct RoundEnd {
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first
    std::string picture_hash;
    std::string state_hash;
};

// Plays rounds of a case in one mode: each begins with the first frame, warms up for /run/warmup
// frames and plays /run/frames that count. So all rounds of all modes play the same frames, and
// must end with the same picture and state.
class RoundPlayer {
public:
    RoundPlayer(const Play& play, engine::Timing timing);

    // The frames that count.
    std::vector<engine::FrameRecord> round();

    // CPU ms from the start of recording the very first frame until it was complete.
    double firstFrame() const { return first_frame_; }

    // Picture and state of the first round, and of the last one so far. Reading them back takes
    // time, so it is done between rounds and for these two only.
    const RoundEnd& firstEnd();
    RoundEnd lastEnd();

private:
    RoundEnd readEnd() const;

    Play play_;
    engine::FrameLoop loop_;
    std::size_t rounds_ = 0;
    double first_frame_ = 0.0;
    std::optional<RoundEnd> first_end_;
};

struct SamplingRule {
    std::string mode;  // "overlapped", "isolated", "wall_clock"
    double engine::FrameRecord::* time = nullptr;  // of a frame, ms: what has to be known
    double precision = 0.01;  // half the median's interval over it; 0: until max_time
    double max_time = 10.0;  // s, after which no round is begun; 0: one round
    std::uint32_t most_rounds = std::numeric_limits<std::uint32_t>::max();
};

// What a series of rounds is played with; tests have clocks of their own.
struct SamplingTools {
    std::function<std::vector<engine::FrameRecord>()> play;  // a round; as many frames each time
    std::function<void()> begin_watch;  // round each round: MachineWatch
    std::function<report::Conditions()> end_watch;
    std::function<double()> seconds;  // of a clock
    std::function<void(double)> pause;  // s
    std::function<void(const SamplingState&)> progress{};  // after each round; may be empty
};

struct SampledRounds {
    std::vector<engine::FrameRecord> frames;  // of the rounds that count, in order
    report::Sampling sampling;
    std::vector<report::Conditions> conditions;  // of all rounds
};

inline constexpr double kThrottlePause = 0.05;  // s (nvbench's)

// Rounds that a device may take to reach its clock before a case is given up.
inline constexpr std::uint32_t kThrottledTries = 10;

// Plays rounds until the median time is known to the precision and the last times were steady
// (steady_state.h), until there are most_rounds, or until max_time has passed. Throttled rounds are
// left out, each followed by a pause; so are the first rounds while times settle. If all were
// throttled, kThrottledTries and until max_time, that is an engine::Error.
SampledRounds sampleRounds(const SamplingRule& rule, const SamplingTools& tools);

// A mode of a case, sampled.
struct SampledMode : SampledRounds {
    double first_frame = 0.0;  // ms, from recording to completion, of the mode's first
    RoundEnd end;  // of the last round
};

// The rule of a mode by a scene's settings: the overlapped mode is judged by its intervals, the
// others by their wall clock.
SamplingRule samplingRule(engine::Timing timing, const hair::RunSettings& run);

// Plays the mode's rounds; enters its sampling, and warns in `result` if its first and last rounds
// made different pictures or states. An unknown /run/busy_pass is an engine::Error.
SampledMode sampleMode(
    const Play& play, engine::Timing timing, const SamplingRule& rule, MachineWatch& watch,
    report::CaseResult& result);

}  // namespace benchmarks::measure
