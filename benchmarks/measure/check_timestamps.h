#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/frame_loop.h"

namespace benchmarks {

// Plays isolated frames and frames whose passes are submitted and waited for one at a time, in
// turns, and returns what timestampFaults() (trust.h) finds. `play_frame` plays one frame. A fault
// of the device stays, a disturbance passes: while there are faults more pairs are played, up to
// 16.
std::vector<std::string> checkTimestamps(
    const engine::Device& device, const std::function<void(engine::FrameLoop&)>& play_frame);

}  // namespace benchmarks
