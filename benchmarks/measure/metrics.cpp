#include "benchmarks/measure/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/report/statistics.h"
#include "benchmarks/report/text.h"
#include "benchmarks/report/verdict.h"

namespace benchmarks::measure {

// ---- Passes of frames ---------------------------------------------------------------------------

std::vector<std::string> passNames(std::span<const engine::FrameRecord> frames) {
    std::vector<std::string> names;
    for (const engine::FrameRecord& frame : frames) {
        for (const engine::PassTime& pass : frame.passes) {
            if (std::ranges::find(names, pass.name) == names.end()) names.push_back(pass.name);
        }
    }
    return names;
}

std::vector<double>
passTimes(std::span<const engine::FrameRecord> frames, const std::string& pass) {
    std::vector<double> times;
    for (const engine::FrameRecord& frame : frames) {
        const auto found = std::ranges::find(frame.passes, pass, &engine::PassTime::name);
        if (found != frame.passes.end()) times.push_back(found->milliseconds);
    }
    return times;
}

double passSum(const engine::FrameRecord& frame) {
    double sum = 0.0;
    for (const engine::PassTime& pass : frame.passes) sum += pass.milliseconds;
    return sum;
}

double passSumOverWall(std::span<const engine::FrameRecord> isolated) {
    std::vector<double> ratios;
    for (const engine::FrameRecord& frame : isolated) ratios.push_back(passSum(frame) / frame.wall);
    return report::summarize(ratios).median;
}

EmptySubmission emptySubmission(std::span<const engine::FrameRecord> empty) {
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : empty)
        walls.push_back(frame.wall - frame.device.value_or(0.0));
    const double median = report::quantile(walls, 0.5);
    return {median, report::quantile(walls, 0.95) - median};
}

PassSum passSums(std::span<const engine::FrameRecord> isolated, const EmptySubmission& empty) {
    std::vector<double> device;
    std::vector<double> work;
    std::vector<double> missing;  // ms of the wall clock outside all passes
    for (const engine::FrameRecord& frame : isolated) {
        if (!frame.device || frame.passes.empty()) continue;
        const double sum = passSum(frame);
        const double at_work = frame.wall - empty.median;
        if (*frame.device > 0.0) device.push_back(sum / *frame.device);
        // If a frame consists only of its submission, no time is left to compare with.
        if (at_work > empty.spread) work.push_back(sum / at_work);
        missing.push_back(std::abs(at_work - sum) / frame.wall);
    }
    PassSum result;
    if (missing.empty()) return result;
    result.over_wall = passSumOverWall(isolated);
    if (!device.empty()) result.over_device = report::quantile(device, 0.5);
    if (!work.empty()) result.over_work = report::quantile(work, 0.5);
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : isolated) walls.push_back(frame.wall);
    const double slack = 2.0 * empty.spread / report::quantile(walls, 0.5);
    result.incomplete =
        (result.over_device && std::abs(*result.over_device - 1.0) > report::kTrustTolerance) ||
        report::quantile(missing, 0.5) > report::kTrustTolerance + slack;
    return result;
}

namespace {

using engine::FrameRecord;
using engine::PassTime;
using engine::ProcessUse;

// ---- Pipeline statistics and fragment lists -----------------------------------------------------

constexpr std::string_view kStrands = "strands";  // the pass with counts that follow from settings

std::optional<std::uint64_t>
expectedOf(const std::optional<hair::rendering::ExpectedCounts>& expected, std::string_view name) {
    if (!expected) return std::nullopt;
    if (name == "tessellation_control_patches") return expected->tessellation_control_patches;
    if (name == "tessellation_evaluation_invocations")
        return expected->tessellation_evaluation_invocations;
    if (name == "geometry_invocations") return expected->geometry_invocations;
    if (name == "geometry_primitives") return expected->geometry_primitives;
    return std::nullopt;
}

bool makesVertices(std::string_view statistic) {
    return statistic == "vertex_invocations" || statistic == "tessellation_control_patches" ||
           statistic == "tessellation_evaluation_invocations";
}

}  // namespace

std::optional<std::string> missedCount(
    std::string_view statistic, std::uint64_t measured, std::optional<std::uint64_t> expected,
    const engine::DeviceInfo& device) {
    if (!expected) return std::nullopt;
    const bool may_repeat =
        makesVertices(statistic) && device.type != engine::DeviceType::cpu && *expected > 0;
    if (may_repeat ? measured >= *expected : measured == *expected) return std::nullopt;
    return (may_repeat ? "expected at least " : "expected ") + std::to_string(*expected);
}

namespace {

constexpr const char* kApproximate = "approximate: this driver counts too many";

bool isApproximate(std::string_view statistic, const engine::Device& device) {
    return statistic == "fragment_invocations" && device.fragmentCountsAreApproximate();
}

}  // namespace

void addPassStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, report::CaseResult& result) {
    const std::span<const std::string_view> names = engine::statisticNames(device);
    for (const engine::PassStatistics& pass : frame.statistics) {
        if (pass.name == kStrands) continue;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (pass.counts[i] == 0) continue;
            const std::string name = pass.name + '.' + std::string(names[i]);
            const auto found = std::ranges::find(result.statistics, name, &report::Statistic::name);
            if (found != result.statistics.end())
                found->measured += pass.counts[i];
            else
                result.statistics.push_back(
                    {.name = name,
                     .measured = pass.counts[i],
                     .expected = std::nullopt,
                     .note = isApproximate(names[i], device) ? kApproximate : ""});
        }
    }
}

void addStatistics(
    const engine::FrameRecord& frame, const engine::Device& device, const Case& test_case,
    report::CaseResult& result) {
    const auto strands =
        std::ranges::find(frame.statistics, kStrands, &engine::PassStatistics::name);
    if (strands == frame.statistics.end()) return;

    const std::optional<hair::rendering::ExpectedCounts> expected = test_case.expected();
    const std::span<const std::string_view> names = engine::statisticNames(device);
    for (std::size_t i = 0; i < names.size(); ++i) {
        report::Statistic statistic{
            .name = std::string(names[i]),
            .measured = strands->counts[i],
            .expected = expectedOf(expected, names[i])};
        if (isApproximate(names[i], device)) statistic.note = kApproximate;
        const std::optional<std::string> missed =
            missedCount(statistic.name, statistic.measured, statistic.expected, device.info());
        if (missed) {
            result.trust.warnings.push_back(
                statistic.name + ": measured " + std::to_string(statistic.measured) + ", " +
                *missed);
        }
        result.statistics.push_back(std::move(statistic));
    }
}

void addTransparency(const Case& test_case, report::CaseResult& result) {
    const hair::rendering::StrandBlend& blend = test_case.blend();
    if (blend.bytes() == 0) return;
    result.metrics.push_back(
        {report::ofMemory(report::Measured::transparency), {static_cast<double>(blend.bytes())}});
    const std::optional<hair::rendering::ListedFragments> listed = blend.listed();
    if (!listed) return;
    result.counts.emplace_back("fragment_list_capacity", listed->capacity);
    result.counts.emplace_back("fragments_wanted", listed->wanted);
    result.counts.emplace_back("fragments_dropped", listed->dropped());
    if (std::string text = droppedFragments(test_case); !text.empty())
        result.trust.warnings.push_back(std::move(text));
}

namespace {

// ---- Isolated and wall-clock frames -------------------------------------------------------------

// Adds CPU time and instructions as metrics from `metric_of`. If some frames have no instruction
// count, that count is omitted, because samples of different frames would not be comparable.
template <class MakeId>
void addUse(
    MakeId metric_of, const std::vector<engine::ProcessUse>& uses, report::Mode mode,
    report::CaseResult& result) {
    std::vector<double> times;
    std::vector<double> instructions;
    for (const engine::ProcessUse& use : uses) {
        times.push_back(use.cpu);
        if (use.instructions) instructions.push_back(*use.instructions);
    }
    const bool counted = instructions.size() == uses.size();
    result.metrics.push_back({metric_of(report::Measured::cpu_time), std::move(times), mode});
    if (counted)
        result.metrics.push_back(
            {metric_of(report::Measured::instructions), std::move(instructions), mode});
}

}  // namespace

void addIsolatedMetrics(std::span<const engine::FrameRecord> frames, report::CaseResult& result) {
    std::vector<double> walls;
    for (const engine::FrameRecord& frame : frames) walls.push_back(frame.wall);
    result.metrics.push_back(
        {report::ofFrame(report::Measured::isolated_time), std::move(walls),
         report::Mode::isolated});
}

void addPassTimes(
    std::span<const engine::FrameRecord> frames, report::Mode mode, report::CaseResult& result) {
    for (const std::string& pass : passNames(frames))
        result.metrics.push_back(
            {report::ofPass(pass, report::Measured::time), passTimes(frames, pass), mode});
}

void addCycles(
    std::span<const engine::FrameRecord> overlapped, std::optional<double> overlapped_mhz,
    std::span<const engine::FrameRecord> isolated, std::optional<double> isolated_mhz,
    report::CaseResult& result) {
    const auto cycles = [](std::vector<double> times, double megahertz) {
        for (double& time : times) time *= megahertz * 1e3;  // ms, MHz
        return times;
    };
    if (overlapped_mhz) {
        std::vector<double> times;
        for (const engine::FrameRecord& frame : overlapped)
            if (frame.device) times.push_back(*frame.device);
        if (!times.empty())
            result.metrics.push_back(
                {report::ofFrame(report::Measured::cycles),
                 cycles(std::move(times), *overlapped_mhz), report::Mode::overlapped});
    }
    if (!isolated_mhz) return;
    for (const std::string& pass : passNames(isolated))
        result.metrics.push_back(
            {report::ofPass(pass, report::Measured::cycles),
             cycles(passTimes(isolated, pass), *isolated_mhz), report::Mode::isolated});
}

void addPassSum(
    std::span<const engine::FrameRecord> isolated, const EmptySubmission& empty, bool processor,
    report::CaseResult& result) {
    const PassSum sum = passSums(isolated, empty);
    result.trust.pass_sum_over_wall = sum.over_wall;
    result.trust.pass_sum_over_device = sum.over_device;
    result.trust.pass_sum_over_work = sum.over_work;
    result.trust.empty_submission = empty.median;
    if (!sum.over_wall) return;
    if (processor && std::abs(*sum.over_wall - 1.0) > report::kTrustTolerance) {
        result.trust.warnings.push_back(
            "the passes add up to " + report::shortNumber(*sum.over_wall) +
            " of the frame's wall clock");
    } else if (!processor && sum.incomplete) {
        std::string text = "the passes add up to ";
        if (sum.over_device)
            text += report::shortNumber(*sum.over_device) + " of the device's time for the frame";
        if (sum.over_device && sum.over_work) text += " and to ";
        if (sum.over_work)
            text += report::shortNumber(*sum.over_work) +
                    " of its wall clock minus the time of a submission";
        result.trust.warnings.push_back(std::move(text));
    }
}

void addOverlap(
    std::span<const engine::FrameRecord> isolated, std::span<const engine::FrameRecord> overlapped,
    std::optional<double> empty_pass, report::CaseResult& result) {
    if (!empty_pass || passNames(isolated).empty()) return;
    std::vector<double> saved;
    for (std::size_t i = 0; i < std::min(isolated.size(), overlapped.size()); ++i) {
        double sum = 0.0;
        for (const engine::PassTime& pass : isolated[i].passes)
            sum += pass.milliseconds - pass.parts * *empty_pass;
        saved.push_back(sum - overlapped[i].interval);
    }
    result.metrics.push_back({report::ofFrame(report::Measured::overlap), std::move(saved)});
}

void addFrameUse(std::span<const engine::FrameRecord> isolated, report::CaseResult& result) {
    std::vector<engine::ProcessUse> uses;
    for (const engine::FrameRecord& frame : isolated) uses.push_back(frame.use);
    addUse(report::ofFrame, uses, report::Mode::isolated, result);
}

void addPassUse(std::span<const engine::FrameRecord> wall_clock, report::CaseResult& result) {
    for (const std::string& name : passNames(wall_clock)) {
        std::vector<engine::ProcessUse> uses;
        for (const engine::FrameRecord& frame : wall_clock) {
            const auto found = std::ranges::find(frame.passes, name, &engine::PassTime::name);
            if (found != frame.passes.end()) uses.push_back(found->use);
        }
        addUse(
            [&](report::Measured what) { return report::ofPass(name, what); }, uses,
            report::Mode::wall_clock, result);
    }
}

namespace {

// ---- Overlapped frames --------------------------------------------------------------------------

template <class Get>
std::vector<double> collect(std::span<const engine::FrameRecord> frames, Get get) {
    std::vector<double> values;
    for (const engine::FrameRecord& frame : frames) values.push_back(get(frame));
    return values;
}

// Metrics of the three definitions of low rates.
struct LowMetrics {
    report::Measured percentile;
    report::Measured mean;
    report::Measured integral;
};
constexpr LowMetrics kDeviceLow1{
    report::Measured::device_low_1_percentile, report::Measured::device_low_1_mean,
    report::Measured::device_low_1_integral};
constexpr LowMetrics kDeviceLow01{
    report::Measured::device_low_0_1_percentile, report::Measured::device_low_0_1_mean,
    report::Measured::device_low_0_1_integral};
constexpr LowMetrics kLow1{
    report::Measured::low_1_percentile, report::Measured::low_1_mean,
    report::Measured::low_1_integral};
constexpr LowMetrics kLow01{
    report::Measured::low_0_1_percentile, report::Measured::low_0_1_mean,
    report::Measured::low_0_1_integral};

void addLows(
    const std::vector<double>& intervals, double fraction, const LowMetrics& lows,
    report::CaseResult& result) {
    if (intervals.size() < fewestForLow(fraction)) return;
    const report::LowRates low = report::lowRates(intervals, fraction);
    const auto add = [&](report::Measured what, double rate) {
        result.metrics.push_back({report::ofFrame(what), {rate}, report::Mode::overlapped});
    };
    add(lows.percentile, low.percentile);
    add(lows.mean, low.mean);
    add(lows.integral, low.integral);
}

}  // namespace

std::size_t fewestForLow(double fraction) {
    return static_cast<std::size_t>(std::lround(1.0 / fraction));
}

void addOverlappedMetrics(std::span<const engine::FrameRecord> frames, report::CaseResult& result) {
    const std::vector<double> intervals = collect(frames, [](auto& f) { return f.interval; });
    result.metrics.push_back(
        {report::ofFrame(report::Measured::rate),
         {report::framesPerSecond(intervals)},
         report::Mode::overlapped});
    addLows(intervals, 0.01, kLow1, result);
    addLows(intervals, 0.001, kLow01, result);
    const auto addTimes = [&](report::MetricId id, auto get) {
        result.metrics.push_back({std::move(id), collect(frames, get), report::Mode::overlapped});
    };
    addTimes(report::ofFrame(report::Measured::time), [](auto& f) { return f.interval; });
    const bool timestamped =
        std::ranges::all_of(frames, [](auto& f) { return f.device.has_value(); });
    if (timestamped) {
        // A host that wakes up late makes an interval long, but not the device's own time.
        const std::vector<double> times = collect(frames, [](auto& f) { return *f.device; });
        addLows(times, 0.01, kDeviceLow1, result);
        addLows(times, 0.001, kDeviceLow01, result);
        addTimes(report::ofFrame(report::Measured::device_time), [](auto& f) { return *f.device; });
    }
    addTimes(report::ofCpu(report::Measured::record_time), [](auto& f) { return f.record; });
    addTimes(report::ofCpu(report::Measured::submit_time), [](auto& f) { return f.submit; });
    addTimes(report::ofCpu(report::Measured::wait_time), [](auto& f) { return f.wait; });
    if (std::ranges::all_of(frames, [](auto& f) { return f.host.has_value(); }))
        addTimes(report::ofCpu(report::Measured::host_time), [](auto& f) { return *f.host; });
    if (std::ranges::all_of(frames, [](auto& f) { return f.gap.has_value(); }))
        addTimes(report::ofGpu(report::Measured::wait_time), [](auto& f) {
            return std::max(*f.gap, 0.0);
        });
}

namespace {

// ---- Device memory ------------------------------------------------------------------------------

report::Metric bytes(report::Measured what, std::string part, std::uint64_t count) {
    return {report::ofMemory(what, std::move(part)), {static_cast<double>(count)}};
}

}  // namespace

std::vector<report::Metric> memoryMetrics(const engine::MemoryLedger& ledger) {
    std::map<std::uint32_t, std::uint64_t> heaps;
    std::map<std::string_view, std::uint64_t> purposes;
    for (const auto& [entry, size] : ledger) {
        heaps[entry.heap] += size;
        purposes[entry.purpose.name()] += size;
    }
    std::vector<report::Metric> metrics;
    for (const auto& [heap, size] : heaps)
        metrics.push_back(bytes(report::Measured::heap, std::to_string(heap), size));
    for (const auto& [purpose, size] : purposes)
        metrics.push_back(bytes(report::Measured::purpose, std::string(purpose), size));
    return metrics;
}

// ---- Shaders ------------------------------------------------------------------------------------

namespace {

using report::Measured;

// Figures that drivers share, under the names of RADV, NVK and ANV of Mesa 25. Those of ANV were
// not seen in a run.
struct KnownFigure {
    std::string_view name;
    Measured what;
};
constexpr KnownFigure kKnown[] = {
    {"VGPRs", Measured::registers},
    {"SGPRs", Measured::scalar_registers},
    {"Spilled VGPRs", Measured::spills},
    {"Spilled SGPRs", Measured::scalar_spills},
    {"Scratch size", Measured::scratch},
    {"Subgroups per SIMD", Measured::waves},
    {"Instructions", Measured::instructions},
    {"Code size", Measured::code_size},
    {"LDS size", Measured::shared_memory},
    {"Latency", Measured::latency},
    {"Inverse Throughput", Measured::inverse_throughput},
    {"Number of GPRs", Measured::registers},
    {"SLM Size", Measured::scratch},
    {"Instruction count", Measured::instructions},
    {"Code Size", Measured::code_size},
    {"Instruction Count", Measured::instructions},
    {"Spill Count", Measured::spills},
    {"Scratch Memory Size", Measured::scratch},
    {"Workgroup Memory Size", Measured::shared_memory},
    {"Cycle Count", Measured::latency},
    {"Max live registers", Measured::registers},
};

// A metric's part may have no dots.
std::string stagesOf(const engine::ShaderProgram& program) {
    std::string text;
    for (const std::string& path : program.shaders) text += (text.empty() ? "" : "&") + path;
    if (text.empty()) text = program.name;
    std::ranges::replace(text, '.', ':');
    return text;
}

bool isWorse(report::Better better, double value, double than) {
    return better == report::Better::higher ? value < than : value > than;
}

// Keeps the worst value of a metric.
void addWorst(std::vector<report::Metric>& metrics, report::Metric metric) {
    const auto found = std::ranges::find(metrics, metric.id, &report::Metric::id);
    if (found == metrics.end())
        metrics.push_back(std::move(metric));
    else if (isWorse(metric.better, metric.samples.front(), found->samples.front()))
        found->samples = metric.samples;
}

struct Shown {
    Measured what;
    const char* title;
};
constexpr std::array kShown{
    Shown{Measured::registers, "registers"}, Shown{Measured::spills, "spills"},
    Shown{Measured::scratch, "scratch B"},   Shown{Measured::shared_memory, "shared B"},
    Shown{Measured::waves, "waves"},         Shown{Measured::instructions, "instructions"},
    Shown{Measured::code_size, "code B"},    Shown{Measured::latency, "latency"},
};

}  // namespace

void addShaderCosts(std::span<const engine::ShaderProgram> programs, report::CaseResult& result) {
    for (const engine::ShaderProgram& program : programs) {
        report::ShaderRecord record{
            .name = program.name,
            .shaders = program.shaders,
            .subgroup_size = program.subgroup_size,
            .figures = {}};
        for (const engine::ShaderProgram::Figure& figure : program.figures) {
            record.figures.emplace_back(figure.name, figure.value);
            const auto known = std::ranges::find(kKnown, figure.name, &KnownFigure::name);
            if (known == std::end(kKnown)) continue;
            addWorst(
                result.metrics, {report::ofShader(stagesOf(program), known->what), {figure.value}});
        }
        result.shaders.push_back(std::move(record));
    }
}

std::string shaderTable(std::span<const report::CaseResult> cases) {
    std::vector<report::Metric> worst;
    for (const report::CaseResult& each : cases)
        for (const report::Metric& metric : each.metrics)
            if (metric.id.of == report::MetricOf::shader) addWorst(worst, metric);
    std::map<std::string, std::array<std::optional<double>, kShown.size()>> rows;
    for (const report::Metric& metric : worst)
        for (std::size_t i = 0; i < kShown.size(); ++i)
            if (metric.id.what == kShown[i].what) rows[metric.id.part][i] = metric.samples.front();
    std::vector<report::Column> columns{{"shader", false}};
    for (const Shown& shown : kShown) columns.push_back({shown.title});
    for (const auto& [stages, figures] : rows) {
        columns.front().cells.push_back(stages);
        for (std::size_t i = 0; i < kShown.size(); ++i)
            columns[i + 1].cells.push_back(
                figures[i] ? std::to_string(std::llround(*figures[i])) : "-");
    }
    // No driver tells all of these.
    std::erase_if(columns, [](const report::Column& column) {
        return std::ranges::all_of(
            column.cells, [](const std::string& cell) { return cell == "-"; });
    });
    return rows.empty() ? std::string() : report::columnsText(columns);
}

}  // namespace benchmarks::measure
