#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "benchmarks/report.h"
#include "benchmarks/viewer/play/side.h"
#include "benchmarks/viewer/timings/frame_split.h"
#include "benchmarks/viewer/timings/pass_rows.h"

namespace benchmarks {

// What the panel shows of a side: a value, so that it can be frozen.
struct ShownSide {
    CaseResult metrics;  // frameMetrics(), and the case's counts where they are known
    std::optional<FrameRate> rate;
    std::optional<PassRows> passes;
    std::optional<FrameSplit> split;
    std::size_t isolated = 0;  // frames
    std::size_t overlapped = 0;
    // Numbers of the first and last of them all; absent where there are none.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> range;
};

ShownSide shownTimings(const TimingHistory& history, std::string_view device_type);
// With the counts of what the side plays.
ShownSide shownSide(const Side& side, std::string_view device_type);

}  // namespace benchmarks
