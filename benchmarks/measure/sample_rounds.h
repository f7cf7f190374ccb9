#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "benchmarks/measure.h"
#include "benchmarks/report.h"
#include "engine/frame_loop.h"

namespace benchmarks {

struct SamplingRule {
    std::string mode;  // "overlapped", "isolated", "wall_clock"
    double engine::FrameRecord::* time = nullptr;  // of a frame, ms: what has to be known
    double precision = 0.01;  // half the median's interval over it; 0: until max_time
    double max_time = 10.0;   // s, after which no round is begun; 0: one round
    std::uint32_t most_rounds = std::numeric_limits<std::uint32_t>::max();
};

// What a series of rounds is played with; tests have clocks of their own.
struct SamplingTools {
    std::function<std::vector<engine::FrameRecord>()> play;  // a round; as many frames each time
    std::function<void()> begin_watch;  // round each round: MachineWatch
    std::function<Conditions()> end_watch;
    std::function<double()> seconds;      // of a clock
    std::function<void(double)> pause;    // s
    std::function<void(const SamplingState&)> progress{};  // after each round; may be empty
};

struct SampledRounds {
    std::vector<engine::FrameRecord> frames;  // of the rounds that count, in order
    Sampling sampling;
    std::vector<Conditions> conditions;  // of all rounds
};

inline constexpr double kThrottlePause = 0.05;  // s (nvbench's)

// Rounds that a device may take to reach its clock before a case is given up.
inline constexpr std::uint32_t kThrottledTries = 10;

// Plays rounds until the median time is known to the precision and the last times were steady
// (assessment.h), until there are most_rounds, or until max_time has passed. Throttled rounds are
// left out, each followed by a pause; so are the first rounds while times settle. If all were
// throttled, kThrottledTries and until max_time, that is an engine::Error.
SampledRounds sampleRounds(const SamplingRule& rule, const SamplingTools& tools);

}  // namespace benchmarks
