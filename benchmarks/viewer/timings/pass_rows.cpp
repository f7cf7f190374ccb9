#include "benchmarks/viewer/timings/pass_rows.h"

#include <algorithm>
#include <utility>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/trust.h"

namespace benchmarks {

namespace {

constexpr double kHigh = 0.01;  // share of the frames that take longer

// Of the frames that ran the pass: passTimes() has one time for each.
std::vector<std::uint32_t> numbersOf(const TimedFrames& frames, const std::string& pass) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto& passes = frames.records[i].passes;
        if (std::ranges::find(passes, pass, &engine::PassTime::name) != passes.end())
            numbers.push_back(frames.numbers[i]);
    }
    return numbers;
}

}  // namespace

TimeSeries
timeSeries(std::string name, std::vector<double> times, std::vector<std::uint32_t> numbers) {
    TimeSeries series{
        .name = std::move(name), .times = std::move(times), .numbers = std::move(numbers)};
    series.summary = summarize(series.times);
    if (series.times.size() >= fewestForLow(kHigh))
        series.high = quantile(series.times, 1.0 - kHigh);
    return series;
}

double PassRows::share(const TimeSeries& pass) const {
    return sum.summary.median > 0.0 ? pass.summary.median / sum.summary.median : 0.0;
}

const TimeSeries* PassRows::find(const std::string& name) const {
    const auto found = std::ranges::find(passes, name, &TimeSeries::name);
    return found == passes.end() ? nullptr : &*found;
}

std::optional<PassRows> passRows(const TimedFrames& isolated) {
    if (isolated.size() == 0) return std::nullopt;
    std::vector<double> sums;
    for (const engine::FrameRecord& frame : isolated.records) sums.push_back(passSum(frame));
    PassRows rows{.sum = timeSeries("all passes", std::move(sums), isolated.numbers), .passes = {}};
    for (const std::string& pass : passNames(isolated.records))
        rows.passes.push_back(
            timeSeries(pass, passTimes(isolated.records, pass), numbersOf(isolated, pass)));
    return rows;
}

}  // namespace benchmarks
