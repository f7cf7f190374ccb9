#pragma once

#include <cstdint>
#include <optional>

namespace benchmarks {

// What the user wants of time. Simulated time always advances in the scene's fixed steps; the speed
// decides only when a frame is played.
struct PlayState {
    bool playing = true;
    bool step = false;  // one frame, while it is paused
    std::optional<std::uint32_t> seek;
    // Simulated seconds per second; absent: one frame for every picture of the window.
    std::optional<double> speed;
};

}  // namespace benchmarks
