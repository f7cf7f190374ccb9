#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/statistics.h"
#include "benchmarks/viewer/timings/timing_history.h"

namespace benchmarks {

// Times of one thing, frame by frame.
struct TimeSeries {
    std::string name;
    std::vector<double> times;           // ms, oldest first
    std::vector<std::uint32_t> numbers;  // of the frames; empty: they have none
    Summary summary{};                   // of the times, which are at least one
    // Their quantile 0.99; absent where there are so few that it is the longest of them.
    std::optional<double> high;
};

TimeSeries
timeSeries(std::string name, std::vector<double> times, std::vector<std::uint32_t> numbers);

struct PassRows {
    TimeSeries sum;  // of all passes of a frame
    std::vector<TimeSeries> passes;

    // Of the passes' sum, by medians.
    double share(const TimeSeries& pass) const;
    // Null where there is no pass of that name.
    const TimeSeries* find(const std::string& name) const;
};

// By isolated frames; none where there are none.
std::optional<PassRows> passRows(const TimedFrames& isolated);

}  // namespace benchmarks
