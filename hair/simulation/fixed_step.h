#pragma once

#include <cstdint>

namespace hair {

// Turns the simulated time that frames advance into whole steps and carries the rest over. Time is
// counted in whole parts of a step, 720,720 of them, so that every ratio p / q of frame to step
// with q <= 16 is exact and no error builds up; any other is off by less than 1e-6 steps a frame.
class FixedStep {
public:
    // step > 0, s.
    explicit FixedStep(double step);

    // Steps to simulate for a frame that advances `frame_time` >= 0, s.
    std::uint32_t stepsFor(double frame_time);

    void reset() { parts_ = 0; }

private:
    double step_;
    std::int64_t parts_ = 0;  // time that waits for the next step
};

}  // namespace hair
