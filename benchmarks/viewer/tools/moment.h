#pragma once

#include <cstdint>

#include "benchmarks/viewer/play/player.h"

namespace benchmarks {

// The simulated times (s) that a drag writes keys at. It can change nothing that was played
// already: what is dragged is where the mouse has it from the next frame on. Strictly ascending.
struct Moment {
    float now = 0.0f;
    float next = 0.0f;   // end of the next frame
    float later = 0.0f;  // after all frames that may be played before the mouse is asked again
};

// `frame` was played last. Where frames advance by 0 s, the next one counts as a `time_step`.
Moment momentAfter(std::uint32_t frame, double frame_time, double time_step);

Moment momentOf(const Player& player);

}  // namespace benchmarks
