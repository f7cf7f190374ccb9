#pragma once

#include <cstdint>
#include <optional>

namespace benchmarks {

// How many frames are to be played for a picture of the window.
class Pacer {
public:
    static constexpr std::uint32_t kMostFrames = 16;  // of a picture: a slow device falls behind

    // `seconds` since the last picture; `frame_time` simulated s that a frame advances; `speed` in
    // simulated seconds per second, absent: always one. A time or speed of 0 gives none.
    std::uint32_t framesFor(double seconds, double frame_time, std::optional<double> speed);

private:
    double due_ = 0.0;  // frames, below 1
};

}  // namespace benchmarks
