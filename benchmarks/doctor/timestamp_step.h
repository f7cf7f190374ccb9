#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/device.h"

namespace benchmarks {

// How finely stamps divide time, in ticks.
struct TimestampSteps {
    std::uint64_t step = 0;  // that all differences are multiples of: the counter may advance by
                             // more than a tick
    std::uint64_t gap = 0;  // smallest difference between successive stamps that differ: what an
                            // empty pass would seem to take
};

// Of stamps in the order in which they were taken; absent where none differ.
std::optional<TimestampSteps> timestampSteps(std::span<const std::uint64_t> ticks);

// Of the device's, taken one after another with nothing between them.
std::optional<TimestampSteps> timestampSteps(const engine::Device& device);

}  // namespace benchmarks
