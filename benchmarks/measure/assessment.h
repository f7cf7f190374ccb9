#pragma once

#include <cstddef>
#include <optional>

#include "benchmarks/measure/frame_profile.h"

namespace benchmarks {

// What a mode's rounds say of the frame time so far.
struct Assessment {
    std::size_t settling = 0;  // rounds at the start to leave out: settlingRounds()
    std::optional<bool> steady;  // no drift in the last 32 frames; absent: too few to tell
    double median = 0.0;  // ms, of the rounds that are not left out, as what follows
    // Half the median's 95 % interval over it; absent: too few times for an interval. The interval
    // is that of independent times, as few as effectiveSamples() finds when what every round does
    // alike is taken out. As each round has every frame once, this is too wide rather than too
    // narrow where frames differ much.
    std::optional<double> relative_half_width;
};

// At least one round, and as many frames in each.
Assessment assess(const RoundTimes& rounds);

// Whether no more rounds are needed: the last frames were steady, and the interval is narrow.
bool isEnough(const Assessment& assessment, double precision);

}  // namespace benchmarks
