#include "benchmarks/measure/quiet_wait.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/report/verdict.h"
#include "engine/process.h"

namespace benchmarks::measure {

QuietWait::QuietWait(Look look, std::function<void(double share)> tell)
    : look_(std::move(look)), tell_(std::move(tell)) {}

void QuietWait::wait(double max_time) {
    const double most = std::min({left_, kMostQuietWait, max_time});
    double waited = 0.0;
    // The first look is no wait.
    while (waited + kQuietLook <= most) {
        const std::optional<double> share = look_(kQuietLook);
        if (!share || *share <= report::kLittleLoad) return;
        if (!std::exchange(told_, true)) tell_(*share);
        waited += kQuietLook;
        left_ -= kQuietLook;
    }
}

std::optional<double> otherLoad(double seconds) {
    const auto before = readProcessorTicks();
    if (!before) return std::nullopt;
    const double used = engine::processUse().cpu;
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    engine::checkInterrupted();
    const auto after = readProcessorTicks();
    if (!after) return std::nullopt;
    const auto load = loadBetween(*before, *after, engine::processUse().cpu - used);
    if (!load) return std::nullopt;
    return load->others;
}

}  // namespace benchmarks::measure
