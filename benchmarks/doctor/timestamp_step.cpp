#include "benchmarks/doctor/timestamp_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/commands.h"
#include "engine/timestamps.h"

namespace benchmarks {

std::optional<TimestampSteps> timestampSteps(std::span<const std::uint64_t> ticks) {
    TimestampSteps steps;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        if (ticks[i] <= ticks[i - 1]) continue;
        const std::uint64_t difference = ticks[i] - ticks[i - 1];
        steps.step = std::gcd(steps.step, difference);
        steps.gap = steps.gap == 0 ? difference : std::min(steps.gap, difference);
    }
    if (steps.gap == 0) return std::nullopt;
    return steps;
}

std::optional<TimestampSteps> timestampSteps(const engine::Device& device) {
    if (device.info().timestamp_valid_bits == 0) return std::nullopt;
    constexpr std::uint32_t kStamps = 1000;
    engine::Timestamps stamps(device, kStamps);
    device.runOnce([&](engine::Commands& commands) {
        for (std::uint32_t i = 0; i < kStamps; ++i) stamps.write(commands);
    });
    // Whole ticks again: so few that a double holds them.
    const double tick = double{device.info().limits.timestampPeriod} * 1e-6;  // ms
    std::vector<std::uint64_t> ticks;
    for (const double milliseconds : stamps.read())
        ticks.push_back(static_cast<std::uint64_t>(std::llround(milliseconds / tick)));
    return timestampSteps(ticks);
}

}  // namespace benchmarks
