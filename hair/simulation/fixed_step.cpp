#include "hair/simulation/fixed_step.h"

#include <cassert>
#include <cmath>

namespace hair {

namespace {

constexpr std::int64_t kPartsPerStep = 720720;  // the least common multiple of 1 .. 16

}  // namespace

FixedStep::FixedStep(double step) : step_(step) { assert(step > 0.0); }

std::uint32_t FixedStep::stepsFor(double frame_time) {
    assert(frame_time >= 0.0);
    parts_ += std::llround(frame_time / step_ * double{kPartsPerStep});
    const std::int64_t steps = parts_ / kPartsPerStep;
    parts_ -= steps * kPartsPerStep;
    return static_cast<std::uint32_t>(steps);
}

}  // namespace hair
