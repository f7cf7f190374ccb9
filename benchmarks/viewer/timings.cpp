#include "benchmarks/viewer/timings.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/trust.h"

namespace benchmarks::viewer {
namespace {

// ---- Frame metrics ------------------------------------------------------------------------------

// Of an overlapped frame that has the device to itself.
bool holdsForOneFrame(const report::MetricId& id) {
    return id == report::ofFrame(report::Measured::device_time) ||
           id == report::ofCpu(report::Measured::record_time) ||
           id == report::ofCpu(report::Measured::submit_time);
}

void addOverlapped(const TimedFrames& frames, report::CaseResult& result) {
    if (frames.size() == 0) return;
    report::CaseResult all;
    measure::addOverlappedMetrics(frames.records, all);
    std::ranges::copy_if(
        all.metrics, std::back_inserter(result.metrics),
        [](const report::Metric& metric) { return holdsForOneFrame(metric.id); });
}

void addIsolated(
    const TimedFrames& frames, std::string_view device_type, report::CaseResult& result) {
    if (frames.size() == 0) return;
    measure::addIsolatedMetrics(frames.records, result);
    measure::addPassTimes(frames.records, report::Mode::isolated, result);
    // What a software device costs is CPU time; of others it says little.
    if (device_type == "cpu") measure::addFrameUse(frames.records, result);
    measure::addPassSum(frames.records, result);
}

}  // namespace

report::CaseResult frameMetrics(const TimingHistory& history, std::string_view device_type) {
    report::CaseResult result;
    addOverlapped(history.overlapped(), result);
    addIsolated(history.isolated(), device_type, result);
    return result;
}

const report::Metric* metricOf(const report::CaseResult& result, const report::MetricId& id) {
    const report::Metric* const found = report::findMetric(result.metrics, id);
    return found && !found->samples.empty() ? found : nullptr;
}

namespace {

// ---- Frame split --------------------------------------------------------------------------------

constexpr double kLow = 0.01;

template <class Get>
double medianOf(const TimedFrames& frames, Get get) {
    std::vector<double> values;
    for (const engine::FrameRecord& frame : frames.records) values.push_back(get(frame));
    return report::summarize(values).median;
}

std::optional<double> medianOf(const report::CaseResult& metrics, const report::MetricId& id) {
    const report::Metric* const metric = metricOf(metrics, id);
    if (!metric) return std::nullopt;
    return report::summarize(metric->samples).median;
}

}  // namespace

std::optional<FrameRate> frameRate(const report::CaseResult& metrics) {
    const report::Metric* const walls =
        metricOf(metrics, report::ofFrame(report::Measured::isolated_time));
    if (!walls) return std::nullopt;
    FrameRate rate{
        .fps = report::framesPerSecond(walls->samples),
        .median = report::summarize(walls->samples).median,
        .low = std::nullopt};
    if (walls->samples.size() >= measure::fewestForLow(kLow))
        rate.low = report::lowRates(walls->samples, kLow);
    return rate;
}

std::optional<double> FrameSplit::saved() const {
    if (!device_overlapped) return std::nullopt;
    return pass_sum - *device_overlapped;
}

std::optional<FrameSplit>
frameSplit(const TimingHistory& history, const report::CaseResult& metrics) {
    const TimedFrames& frames = history.isolated();
    if (frames.size() == 0) return std::nullopt;
    return FrameSplit{
        .record = medianOf(frames, [](auto& frame) { return frame.record; }),
        .submit = medianOf(frames, [](auto& frame) { return frame.submit; }),
        .wait = medianOf(frames, [](auto& frame) { return frame.wait; }),
        .cpu = medianOf(metrics, report::ofFrame(report::Measured::cpu_time)),
        .device = medianOf(frames, [](auto& frame) { return frame.device; }),
        .pass_sum = medianOf(frames, measure::passSum),
        .device_overlapped = medianOf(metrics, report::ofFrame(report::Measured::device_time))};
}

namespace {

// ---- Pass rows ----------------------------------------------------------------------------------

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
    series.summary = report::summarize(series.times);
    if (series.times.size() >= measure::fewestForLow(kHigh))
        series.high = report::quantile(series.times, 1.0 - kHigh);
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
    for (const engine::FrameRecord& frame : isolated.records)
        sums.push_back(measure::passSum(frame));
    PassRows rows{.sum = timeSeries("all passes", std::move(sums), isolated.numbers), .passes = {}};
    for (const std::string& pass : measure::passNames(isolated.records))
        rows.passes.push_back(timeSeries(
            pass, measure::passTimes(isolated.records, pass), numbersOf(isolated, pass)));
    return rows;
}

namespace {

// ---- Shown side ---------------------------------------------------------------------------------

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

}  // namespace benchmarks::viewer
