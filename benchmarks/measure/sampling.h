#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/stage.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "engine/frame_loop.h"

// Rounds of one mode of a case, until its median frame time is known.
namespace benchmarks::measure {

// Plays a case in one mode repeatedly from its first frame: /run/warmup frames, then /run/frames
// frames that count. All plays of all modes show the same frames, and must end with the same
// picture and state.
class RoundPlayer {
public:
    // Whether the frame that ends the first round, which gives no sample, is used for counting
    // (Player::count()). It cannot be if frames overlap, because it ends the interval of the
    // previous frame.
    enum class Counts { nothing, last_frame };

    // `queue`: number of frames to start, without waiting for all of them, before the first that
    // counts. If the warm-up has fewer, extra frames are played first.
    RoundPlayer(
        std::unique_ptr<Player> player, const hair::RunSettings& run,
        Counts counts = Counts::nothing, std::uint32_t queue = 0);

    // Makes one play and waits for it. Returns the frames that count.
    std::vector<engine::FrameRecord> round();

    // Plays as many frames as count in a round, continuing from the current frame. This is not a
    // play, because it does not start at the first frame.
    std::vector<engine::FrameRecord> more();

    // Plays without pauses and without reading anything back between plays. Returns the counted
    // frames of the next `plays` plays. Frames in flight on return belong to a later play.
    std::vector<engine::FrameRecord> stream(std::uint32_t plays);
    // Ends a stream: waits for frames in flight and drops them.
    void drain();

    // CPU ms from the start of recording the very first frame until its completion.
    double firstFrame() const { return first_frame_; }

    // Picture and state of the first play, and of the last one so far. Reading them back takes
    // time, so it is done between plays and only for these two. Nothing may be in flight.
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
    std::vector<engine::FrameRecord> complete_;  // of a stream, from the first frame of a play
    std::optional<RoundEnd> first_end_;
};

struct SamplingRule {
    std::string mode;  // "overlapped", "isolated", "wall_clock"
    double engine::FrameRecord::* time = nullptr;  // the time of a frame, ms, that is to be
                                                   // determined
    // True if the device's times decide when there are any: those of the frame and of every pass
    // that all frames have.
    bool passes = false;
    double precision = 0.01;  // target for half of the median's interval, relative to the median;
                              // 0: until max_time
    double max_time = 10.0;  // s; no new round begins after it; 0: one round
    std::uint32_t most_rounds = std::numeric_limits<std::uint32_t>::max();
    // True if the first round's last frame is used for counting.
    bool counts = false;
    // True if samples are assessed while the next round is played, so that the device always has
    // work.
    bool overlaps_assessment = false;
};

// Functions for playing a series of rounds.
struct SamplingTools {
    std::function<std::vector<engine::FrameRecord>()> play;  // plays a round; the number of frames
                                                             // is the same each time
    std::function<void()> begin{};  // before the first round and after a pause; may be empty
    std::function<report::Conditions()> conditions;  // returns those of the round just played
    std::function<double()> seconds;  // reads a clock
    std::function<void(double)> pause;  // s
    std::function<void(const SamplingState&)> progress{};  // after each round; may be empty
};

struct SampledRounds {
    std::vector<engine::FrameRecord> frames;  // of the rounds that count, in order
    report::Sampling sampling;
    std::vector<report::Conditions> conditions;  // of all rounds
    // True if all rounds were throttled; `frames` is then from throttled rounds.
    bool all_throttled = false;
    std::optional<double> clock_mhz;  // of the shaders, median over the counted rounds
    std::optional<MeanPower> power;  // over the counted rounds
};

inline constexpr double kThrottlePause = 0.05;  // s (as in nvbench)

// Least number of rounds before a case is given up as throttled.
inline constexpr std::uint32_t kThrottledTries = 10;

// Plays rounds until the median time is known to the precision and the last times were steady
// (trust.h), until there are most_rounds, or until max_time has passed. `held` has the
// highest device clocks so far under such a load, and is raised to the highest here; it may be
// null. Throttled rounds (report::isThrottled()) are left out, and each is followed by a pause. A
// round is judged again when a later one has a higher clock. The first rounds are also left out
// while times settle. If all rounds were throttled, after at least kThrottledTries and max_time,
// they are the result.
SampledRounds sampleRounds(
    const SamplingRule& rule, const SamplingTools& tools, report::HighestClocks* held = nullptr);

// The samples of a mode of a case.
struct SampledMode : SampledRounds {
    double first_frame = 0.0;  // ms, from recording to completion of the mode's first frame
    RoundEnd end;  // of the last round; empty if the frames continue earlier ones
};

// The rule of a mode for a scene's settings. The overlapped mode is judged by its intervals, the
// others by their wall clock.
SamplingRule samplingRule(engine::Timing timing, const hair::RunSettings& run);

// Plays the mode's rounds. On a processor each round is one play. On other devices it is as many
// plays as take /run/round_time, after a warm-up that raises the clock (warmUp()). Adds the
// sampling to `result`, and warns there if the first and last plays made different pictures or
// states. If there is no time, wall-clock frames continue from the frames played before.
SampledMode sampleMode(
    Stage& stage, engine::Timing timing, const SamplingRule& rule, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result);

// Result of a device's warm-up.
struct WarmUp {
    double seconds = 0.0;
    double play = 0.0;  // s, of a play at the end of the warm-up
    double counted = 0.0;  // ms of the rule's time in the counted frames of a play
    bool steady = false;
};

// Plays for at least `least` seconds, and until the median frame of two windows of 50 ms differs by
// less than one percent, both by `time` and by the device's own time. Stops after `most` seconds.
// This gives the clock time to rise.
WarmUp warmUp(
    RoundPlayer& player, Stage& stage, double engine::FrameRecord::* time, double least,
    double most);

}  // namespace benchmarks::measure
