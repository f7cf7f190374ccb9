#include "benchmarks/viewer/timings.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/backends.h"
#include "benchmarks/run/run.h"
#include "benchmarks/scene/settings_json.h"
#include "engine/device.h"
#include "engine/frame_loop.h"
#include "engine/shaders.h"
#include "engine/transfer.h"

namespace benchmarks::viewer {
namespace {

// ---- Metrics of frames --------------------------------------------------------------------------

// Whether a metric of overlapped frames is valid when each frame has the device to itself.
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
    const TimedFrames& frames, engine::DeviceType device_type, report::CaseResult& result) {
    if (frames.size() == 0) return;
    measure::addIsolatedMetrics(frames.records, result);
    measure::addPassTimes(frames.records, report::Mode::isolated, result);
    // The cost on a software device is CPU time; for other devices it says little.
    if (device_type == engine::DeviceType::cpu) measure::addFrameUse(frames.records, result);
    measure::addPassSum(frames.records, {}, device_type == engine::DeviceType::cpu, result);
}

// Share of the slowest frames, for "1 % low" and "1 % high".
constexpr double kSlowest = 0.01;

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

// Returns the median device time of the frames that have one; nothing if none has.
std::optional<double> medianDevice(const TimedFrames& frames) {
    std::vector<double> times;
    for (const engine::FrameRecord& frame : frames.records)
        if (frame.device) times.push_back(*frame.device);
    if (times.empty()) return std::nullopt;
    return report::summarize(times).median;
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
        .device = medianDevice(frames),
        .pass_sum = medianOf(frames, measure::passSum),
        .device_overlapped = medianOf(metrics, report::ofFrame(report::Measured::device_time))};
}

// Returns the numbers of the frames that ran a pass; passTimes() has one time for each.
std::vector<std::uint32_t> numbersOf(const TimedFrames& frames, const std::string& pass) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const auto& passes = frames.records[i].passes;
        if (std::ranges::find(passes, pass, &engine::PassTime::name) != passes.end())
            numbers.push_back(frames.numbers[i]);
    }
    return numbers;
}

std::optional<std::pair<std::uint32_t, std::uint32_t>> rangeOf(const TimingHistory& history) {
    std::vector<std::uint32_t> numbers = history.isolated().numbers;
    numbers.insert(
        numbers.end(), history.overlapped().numbers.begin(), history.overlapped().numbers.end());
    if (numbers.empty()) return std::nullopt;
    const auto [first, last] = std::ranges::minmax(numbers);
    return std::pair(first, last);
}

// ---- Memory of one owner ------------------------------------------------------------------------

// Memory of one owner on a device that others also use: all growth since the start that others did
// not cause.
class OwnMemory {
public:
    explicit OwnMemory(const engine::Device& device) : device_(device), others_(device.memory()) {}

    // Runs an action whose allocations belong to others.
    void others(const std::function<void()>& action);

    // Returns memory.device and memoryMetrics() of the owner alone.
    std::vector<report::Metric> metrics() const;

private:
    const engine::Device& device_;
    engine::MemoryLedger others_;
};

void OwnMemory::others(const std::function<void()>& action) {
    const engine::MemoryLedger before = device_.memory();
    action();
    for (const auto& [entry, bytes] : device_.memory()) others_[entry] += bytes;
    // Subtracts the earlier memory, which is counted already. Unsigned sums wrap modulo 2^64, so
    // memory may also shrink.
    for (const auto& [entry, bytes] : before) others_[entry] -= bytes;
}

std::vector<report::Metric> OwnMemory::metrics() const {
    engine::MemoryLedger own;
    std::uint64_t sum = 0;
    for (const auto& [entry, bytes] : device_.memory()) {
        const auto found = others_.find(entry);
        const std::uint64_t rest = bytes - (found == others_.end() ? 0 : found->second);
        if (rest > 0) own.emplace(entry, rest);
        sum += rest;
    }
    std::vector<report::Metric> metrics{
        {report::ofMemory(report::Measured::allocated), {static_cast<double>(sum)}}};
    std::ranges::move(measure::memoryMetrics(own), std::back_inserter(metrics));
    return metrics;
}

}  // namespace

// ---- Timings of drawn frames --------------------------------------------------------------------

void TimingHistory::add(
    const engine::FrameRecord& frame, engine::Timing timing, std::uint32_t number) {
    TimedFrames& frames = timing == engine::Timing::overlapped ? overlapped_ : isolated_;
    if (frames.size() == kFrames) {
        frames.records.erase(frames.records.begin());
        frames.numbers.erase(frames.numbers.begin());
    }
    frames.records.push_back(frame);
    frames.numbers.push_back(number);
}

void TimingHistory::clear() {
    isolated_ = {};
    overlapped_ = {};
    ++revision_;
}

// ---- Metrics of frames --------------------------------------------------------------------------

report::CaseResult frameMetrics(const TimingHistory& history, engine::DeviceType device_type) {
    report::CaseResult result;
    addOverlapped(history.overlapped(), result);
    addIsolated(history.isolated(), device_type, result);
    return result;
}

const report::Metric* metricOf(const report::CaseResult& result, const report::MetricId& id) {
    const report::Metric* const found = report::findMetric(result.metrics, id);
    return found && !found->samples.empty() ? found : nullptr;
}

// ---- Frame rate, and parts of a frame's time ----------------------------------------------------

std::optional<FrameRate> frameRate(const report::CaseResult& metrics) {
    const report::Metric* const walls =
        metricOf(metrics, report::ofFrame(report::Measured::isolated_time));
    if (!walls) return std::nullopt;
    FrameRate rate{
        .fps = report::framesPerSecond(walls->samples),
        .median = report::summarize(walls->samples).median};
    if (walls->samples.size() >= measure::fewestForLow(kSlowest))
        rate.low = report::lowRates(walls->samples, kSlowest);
    return rate;
}

std::optional<double> FrameSplit::saved() const {
    if (!device_overlapped) return std::nullopt;
    return pass_sum - *device_overlapped;
}

// ---- Passes -------------------------------------------------------------------------------------

TimeSeries
timeSeries(std::string name, std::vector<double> times, std::vector<std::uint32_t> numbers) {
    TimeSeries series{
        .name = std::move(name), .times = std::move(times), .numbers = std::move(numbers)};
    series.summary = report::summarize(series.times);
    if (series.times.size() >= measure::fewestForLow(kSlowest))
        series.high = report::quantile(series.times, 1.0 - kSlowest);
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
    PassRows rows{.sum = timeSeries("all passes", std::move(sums), isolated.numbers)};
    for (const std::string& pass : measure::passNames(isolated.records))
        rows.passes.push_back(timeSeries(
            pass, measure::passTimes(isolated.records, pass), numbersOf(isolated, pass)));
    return rows;
}

// ---- Shown values of a side ---------------------------------------------------------------------

ShownSide shownTimings(const TimingHistory& history, engine::DeviceType device_type) {
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

std::string frameTimeCaption(const TimingHistory& history) {
    std::vector<double> times;
    for (const engine::FrameRecord& frame : history.isolated().records) times.push_back(frame.wall);
    return times.empty() ? "" : report::shortNumber(report::summarize(times).median) + " ms";
}

// ---- Reports of shown or measured values --------------------------------------------------------

void warnOfChangedShaders(std::span<const std::string> replaced, report::Trust& trust) {
    std::string names;
    for (const std::string& path : replaced) names += (names.empty() ? "" : ", ") + path;
    if (names.empty()) return;
    trust.warnings.push_back("shaders that are not those of the build: " + names);
}

report::CaseResult countStatistics(const engine::Device& device, measure::Case& shown) {
    report::CaseResult result;
    if (!device.hasPipelineStatistics()) return result;
    engine::FrameLoop loop(device, engine::Timing::statistics);
    loop.frame([&](engine::Passes& passes) { shown.draw(passes); });
    measure::addStatistics(loop.finish().front(), device, shown, result);
    return result;
}

FrozenSide frozenSide(const Shown& seen, ShownSide shown) {
    const report::CaseResult& transparency = seen.transparency;
    std::ranges::copy(transparency.metrics, std::back_inserter(shown.metrics.metrics));
    std::ranges::copy(transparency.counts, std::back_inserter(shown.metrics.counts));
    std::ranges::copy(
        transparency.trust.warnings, std::back_inserter(shown.metrics.trust.warnings));
    if (seen.isExact()) {
        shown.metrics.image_hash = seen.pictureHash();
        // With very many guides, their positions may be unknown while frames are played.
        if (seen.has_guides) shown.metrics.state_hash = seen.stateHash();
    }
    return {.shown = std::move(shown), .settings = seen.settings, .frame = seen.frame};
}

report::CaseResult frozenResult(const FrozenSide& frozen, const report::CaseResult& statistics) {
    report::CaseResult result = frozen.shown.metrics;
    result.statistics = statistics.statistics;
    std::vector<std::string>& warnings = result.trust.warnings;
    std::ranges::copy(statistics.trust.warnings, std::back_inserter(warnings));
    std::string frames = report::countText(frozen.shown.isolated, "isolated frame") + " and " +
                         report::countText(frozen.shown.overlapped, "overlapped frame");
    if (const auto& range = frozen.shown.range)
        frames +=
            " between " + std::to_string(range->first) + " and " + std::to_string(range->second);
    warnings.push_back(
        "taken in the viewer: " + frames +
        ", one at a time, without rounds and with the window's pictures between them; their "
        "timestamps were not checked against the CPU's clock");
    if (!result.image_hash.empty())
        warnings.push_back("the hashes are of frame " + std::to_string(frozen.frame));
    return result;
}

SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name,
    const measure::MeasureHooks& hooks) {
    SideMeasurement measured{.settings = settings, .result = {.name = name}};
    report::CaseResult& result = measured.result;
    result.index = result.order = 0;
    OwnMemory memory(device);
    const measure::MeasureHooks own_hooks{
        .stop = hooks.stop, .progress = [&](const measure::SamplingState& state) {
            if (hooks.progress) memory.others([&] { hooks.progress(state); });
            runOnce(device, [](engine::Commands&) {});  // waits for all submitted work
        }};
    measure::Case test_case(device, settings, directory);
    measured.picture = measure::measure(device, test_case, settings.run, own_hooks, result);
    std::erase_if(result.metrics, [](const report::Metric& metric) {
        const report::Measured what = metric.id.what;
        return what == report::Measured::allocated || what == report::Measured::heap ||
               what == report::Measured::purpose;
    });
    std::ranges::move(memory.metrics(), std::back_inserter(result.metrics));
    if (!settings.run.reference.empty()) {
        reference::ReferenceComparison references;
        references.add(
            directory / settings.run.reference, settings.render.width, settings.render.height,
            measured.picture, result);
    }
    if (settings.run.compare_backends)
        run::BackendComparison().add(device, test_case, settings, measured.picture, result);
    std::vector<std::string> replaced;
    for (const auto& [path, code] : device.shaders().replacements()) replaced.push_back(path);
    warnOfChangedShaders(replaced, result.trust);
    result.trust.warnings.push_back(
        "measured in the viewer: pipelines and files were warm, and the window's pictures were "
        "drawn between rounds");
    return measured;
}

report::Report viewerReport(
    const engine::Device& device, const ReportOrigin& origin, const hair::Settings& settings,
    report::CaseResult result) {
    scene::Document document(scene::writeSettings(settings));
    report::Report report;
    report.environment =
        report::describeEnvironment(device, origin.command, settings.seed, origin.validation);
    report.scene.path = origin.scene.generic_string();
    report.scene.hash = report::hashText(document.text());
    report.scene.document = std::move(document);
    report.case_count = 1;
    result.name = origin.name;
    result.index = result.order = 0;
    report.cases.push_back(std::move(result));
    return report;
}

std::filesystem::path reportPath(const ReportOrigin& origin, const std::string& kind) {
    return std::filesystem::path("results/local") / (origin.name + '-' + kind + ".json");
}

void saveReport(
    report::Report report, const hair::RenderSettings& render,
    std::span<const std::uint8_t> picture, const std::filesystem::path& file) {
    if (!picture.empty())
        report.cases.front().picture =
            run::writeCasePicture(picture, render.width, render.height, file, 0);
    report::writeReport(report::reportJson(report), file);
}

}  // namespace benchmarks::viewer
