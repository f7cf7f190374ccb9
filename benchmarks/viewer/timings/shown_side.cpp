#include "benchmarks/viewer/timings/shown_side.h"

#include <algorithm>

#include "benchmarks/viewer/timings/frame_metrics.h"

namespace benchmarks {

namespace {

std::optional<std::pair<std::uint32_t, std::uint32_t>> rangeOf(const TimingHistory& history) {
    std::vector<std::uint32_t> numbers = history.isolated().numbers;
    numbers.insert(
        numbers.end(), history.overlapped().numbers.begin(), history.overlapped().numbers.end());
    if (numbers.empty()) return std::nullopt;
    const auto [first, last] = std::ranges::minmax(numbers);
    return std::pair(first, last);
}

}  // namespace

ShownSide shownTimings(const TimingHistory& history, std::string_view device_type) {
    ShownSide shown;
    shown.metrics = frameMetrics(history, device_type);
    shown.rate = frameRate(shown.metrics);
    shown.passes = passRows(history.isolated());
    shown.split = frameSplit(history, shown.metrics);
    shown.isolated = history.isolated().size();
    shown.overlapped = history.overlapped().size();
    shown.range = rangeOf(history);
    return shown;
}

ShownSide shownSide(const Side& side, std::string_view device_type) {
    ShownSide shown = shownTimings(side.timings(), device_type);
    shown.metrics.counts = side.player().played().counts();
    return shown;
}

}  // namespace benchmarks
