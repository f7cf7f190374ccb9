#include "benchmarks/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/sampling.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/statistics.h"
#include "hair/simulation/hair_hair.h"
#include "hair/simulation/probes.h"
#include "hair/simulation/solvers.h"

namespace benchmarks::measure {

// ---- The start of the hair ----------------------------------------------------------------------

namespace {

using hair::simulation::ConditionLimits;

report::WorstGuide recordOf(const hair::simulation::Worst& worst) {
    return {.value = worst.value, .guide = worst.guide, .guides = worst.guides};
}

std::string guidesText(std::uint32_t count) {
    return std::to_string(count) + (count == 1 ? " guide" : " guides");
}

std::string number(double value) {
    std::ostringstream text;
    text.precision(3);
    text << value;
    return text.str();
}

std::string millimetres(double metres) { return number(1e3 * metres) + " mm"; }

// Limits above this share of what is set are not told: they change nothing that can be seen.
constexpr double kTold = 0.95;

// The step is rounded down to three digits, so that it lets the field act in full.
std::string limitText(const hair::simulation::StepLimit& limit) {
    const double digit = std::pow(10.0, std::floor(std::log10(limit.longest_step)) - 2.0);
    const double step = digit * std::floor(limit.longest_step / digit);
    return std::string(limit.field) + ": " + number(limit.set) + " acts as " + number(limit.used) +
           " m^2/s^2, as much as the time step bears; steps of " + number(step) +
           " s or less bear all of it";
}

const char* originOf(const hair::Settings& settings) {
    if (settings.simulation.settle_steps > 0 && settings.simulation.solver != hair::Solver::none)
        return "relaxed";
    return settings.groom.file.empty() ? "grown" : "file";
}

}  // namespace

StartInspection judgeStart(
    const hair::simulation::GuideCondition& condition, const hair::simulation::RestBalance* balance,
    const hair::Settings& settings) {
    const hair::SimulationSettings& simulation = settings.simulation;
    StartInspection start{
        .record = {
            .from = originOf(settings),
            .rest = simulation.rest == hair::RestShape::balanced ? "balanced" : "groom",
            .stretch = recordOf(condition.stretch),
            .depth = recordOf(condition.depth),
            .speed = recordOf(condition.speed)}};
    std::vector<std::string>& warnings = start.warnings;
    const ConditionLimits limits;
    // The thesis's iterations stretch hair. Scenes that select them get the value but no warning.
    const bool keeps_lengths = simulation.solver != hair::Solver::shape ||
                               (simulation.length.method == hair::LengthMethod::tridiagonal &&
                                simulation.length.iterations > 0);
    const auto& [stretch, depth, speed] = condition;
    if (stretch.guides > 0 && keeps_lengths)
        warnings.push_back(
            "hair starts torn: a segment of guide " + std::to_string(stretch.guide) + " is " +
            number(stretch.value) + " times its rest length; " + guidesText(stretch.guides) +
            " beyond " + number(limits.stretch) + " times");
    if (depth.guides > 0)
        warnings.push_back(
            "hair starts inside a body: guide " + std::to_string(depth.guide) + " is " +
            millimetres(depth.value) + " deep; " + guidesText(depth.guides) + " deeper than " +
            millimetres(limits.depth));
    if (speed.guides > 0)
        warnings.push_back(
            "hair has not settled: guide " + std::to_string(speed.guide) + " moves at " +
            millimetres(speed.value) + "/s; " + guidesText(speed.guides) + " faster than " +
            millimetres(limits.speed) + "/s; raise /simulation/settle_steps (" +
            std::to_string(simulation.settle_steps) + ")");
    if (!balance) return start;
    start.record.stiffened = balance->stiffened;
    start.record.stiffest = balance->stiffest;
    start.record.unbalanced = static_cast<std::uint32_t>(balance->unbalanced.size());
    if (!balance->unbalanced.empty())
        warnings.push_back(
            "hair sags: guide " + std::to_string(balance->unbalanced.front()) +
            (simulation.solver == hair::Solver::shape
                 ? " can't be balanced if nothing pulls it to its place "
                   "(/simulation/global/stiffness is 0)"
                 : " can't be balanced by a stiffening of " + number(simulation.most_stiffening) +
                       " (/simulation/most_stiffening)") +
            "; " + guidesText(*start.record.unbalanced) + " in all");
    return start;
}

std::vector<std::string> contactWarnings(const Case& test_case) {
    std::vector<std::string> warnings;
    for (const hair::simulation::StepLimit& limit :
         hair::simulation::limitedBySteps(test_case.groom(), test_case.settings().simulation))
        if (limit.used < kTold * limit.set) warnings.push_back(limitText(limit));
    return warnings;
}

StartInspection inspectStart(const Case& test_case) {
    StartInspection start =
        judgeStart(test_case.condition(), test_case.balance(), test_case.settings());
    std::ranges::move(contactWarnings(test_case), std::back_inserter(start.warnings));
    const std::vector<std::string>& of_file = test_case.groom().warnings;
    start.warnings.insert(start.warnings.end(), of_file.begin(), of_file.end());
    return start;
}

// ---- A case's measurement -----------------------------------------------------------------------

namespace {

using engine::FrameRecord;
using engine::Timing;

// Share of /run/max_time for wall-clock rounds that measure only the passes' CPU use.
constexpr double kUseShare = 1.0 / 3.0;

// Share of /run/max_time for the check of the timestamps.
constexpr double kCheckShare = 0.1;

template <class Get>
double medianOf(const std::vector<FrameRecord>& frames, Get get) {
    std::vector<double> values;
    for (const FrameRecord& frame : frames) values.push_back(get(frame));
    return report::summarize(values).median;
}

void checkEnds(const RoundEnd& overlapped, const RoundEnd& isolated, report::CaseResult& result) {
    if (isolated.picture_hash != overlapped.picture_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different pictures");
    if (isolated.state_hash != overlapped.state_hash)
        result.trust.warnings.push_back("overlapped and isolated frames made different states");
}

// Reports the verdict on the timestamps.
void tellJudgement(const TimestampJudgement& judgement, report::CaseResult& result) {
    using Verdict = TimestampJudgement::Verdict;
    report::Trust& trust = result.trust;
    trust.timestamps = judgement.verdict == Verdict::right   ? "right"
                       : judgement.verdict == Verdict::wrong ? "wrong"
                                                             : "unchecked";
    if (judgement.verdict == Verdict::wrong)
        trust.warnings.push_back(
            "timestamps are not trusted: the passes' times come from the CPU's clock");
    else if (!judgement.faults.empty())
        trust.warnings.push_back(
            "timestamps and the CPU's clock disagree, and a tenth of /run/max_time is too short to "
            "tell a disturbance from a fault");
    std::ranges::copy(judgement.faults, std::back_inserter(trust.warnings));
}

// Adds the passes' times: by timestamps if they can be trusted, otherwise by the CPU's clock. On a
// software device it also adds their CPU use, which only wall-clock rounds tell. Returns the
// conditions of the rounds that it played.
std::vector<report::Conditions> addPasses(
    Stage& stage, const SampledMode& isolated, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    const SamplingRule rule = samplingRule(Timing::wall_clock, run);
    std::optional<SampledMode> clocked;
    if (stage.isProcessor() && !passNames(isolated.frames).empty()) {
        SamplingRule for_use = rule;
        for_use.max_time *= kUseShare;
        for_use.most_rounds = isolated.sampling.rounds;
        clocked = sampleMode(stage, Timing::wall_clock, for_use, run, hooks, result);
    }
    const TimestampJudgement judgement = judgeTimestamps(
        stage, isolated.frames, clocked ? std::span(clocked->frames) : std::span<FrameRecord>(),
        kCheckShare * double{run.max_time}, hooks.known, result);
    tellJudgement(judgement, result);
    if (judgement.verdict != TimestampJudgement::Verdict::wrong) {
        addPassTimes(isolated.frames, report::Mode::isolated, result);
    } else {
        // The rounds for the passes' CPU use are too few for their times.
        if (clocked && rule.max_time > 0.0) {
            clocked.reset();
            result.sampling.pop_back();
        }
        if (!clocked) clocked = sampleMode(stage, Timing::wall_clock, rule, run, hooks, result);
        addPassTimes(clocked->frames, report::Mode::wall_clock, result);
    }
    if (!clocked) return {};
    if (stage.isProcessor()) addPassUse(clocked->frames, result);
    return std::move(clocked->conditions);
}

}  // namespace

std::vector<std::uint8_t> measureFrames(
    Stage& stage, const hair::RunSettings& run, const MeasureHooks& hooks,
    report::CaseResult& result) {
    const auto sample = [&](Timing timing) {
        SamplingRule rule = samplingRule(timing, run);
        rule.counts = timing == Timing::isolated;
        // The host's part of an isolated frame is long and irregular, and no metric of a GPU.
        rule.passes = rule.counts && !stage.isProcessor();
        return sampleMode(stage, timing, rule, run, hooks, result);
    };
    SampledMode overlapped = sample(Timing::overlapped);
    const SampledMode isolated = sample(Timing::isolated);
    result.image_hash = overlapped.end.picture_hash;
    result.state_hash = overlapped.end.state_hash;
    checkEnds(overlapped.end, isolated.end, result);
    for (const SampledMode* mode : {&std::as_const(overlapped), &isolated})
        if (mode->all_throttled && result.status == report::Status::ok) {
            result.status = report::Status::failed;
            result.reason = mode->sampling.mode + ": heat or power throttled the device in all " +
                            std::to_string(mode->sampling.throttled_rounds) + " rounds";
        }

    addOverlappedMetrics(overlapped.frames, result);
    result.metrics.push_back(
        {report::ofFrame(report::Measured::first_time),
         {overlapped.first_frame},
         report::Mode::overlapped});
    addPassSum(
        isolated.frames,
        measureEmptySubmission(
            stage, medianOf(isolated.frames, [](auto& f) { return f.device.value_or(f.wall); })),
        stage.isProcessor(), result);
    // Includes other work on the device; on an otherwise idle machine there is none.
    if (const auto power = overlapped.power)
        result.metrics.push_back(
            {report::ofFrame(report::Measured::energy),
             {power->watts * 1e-3 *
              medianOf(overlapped.frames, [](auto& f) { return f.interval; })},
             report::Mode::overlapped});
    // A processor's passes cost CPU time, and its clock is not reported by the device.
    if (!stage.isProcessor())
        addCycles(
            overlapped.frames, overlapped.clock_mhz, isolated.frames, isolated.clock_mhz, result);
    result.trust.empty_pass = stage.emptyPass();
    std::vector<report::Conditions> conditions = std::move(overlapped.conditions);
    std::ranges::copy(isolated.conditions, std::back_inserter(conditions));
    std::ranges::move(
        addPasses(stage, isolated, run, hooks, result), std::back_inserter(conditions));
    result.conditions = medianConditions(conditions);
    if (overlapped.power)
        result.conditions.energy_source = overlapped.power->counted ? "counter" : "power";
    addIsolatedMetrics(isolated.frames, result);
    if (stage.isProcessor()) addFrameUse(isolated.frames, result);
    addOverlap(isolated.frames, overlapped.frames, result.trust.empty_pass, result);
    return std::move(overlapped.end.picture);
}

std::vector<std::string> probeNames(const hair::Settings& settings) {
    std::vector<std::string> names =
        hair::simulation::Probes::names(settings.run.probes, settings.simulation.solver);
    for (std::string& name : names) name.insert(0, "probe.");
    return names;
}

namespace {

hair::simulation::Probes
probesOf(const engine::Device& device, const Case& test_case, std::uint32_t frames) {
    const std::optional<hair::groom::StrandSet> reference = test_case.probeReference();
    return {
        device,
        test_case.groom(),
        test_case.settings().simulation,
        test_case.settings().run.probes,
        frames,
        reference ? &*reference : nullptr};
}

}  // namespace

ProbeRecorder::ProbeRecorder(const engine::Device& device, Case& test_case, std::uint32_t frames)
    : case_(test_case), probes_(probesOf(device, test_case, frames + 1)) {
    played_.names = probeNames(test_case.settings());
}

void ProbeRecorder::record(engine::Passes& passes) { case_.probe(passes, probes_); }

void ProbeRecorder::frameDone() { played_.times.push_back(case_.time()); }

PlayedProbes ProbeRecorder::take() {
    played_.values = probes_.read();
    return std::move(played_);
}

PlayedProbes playProbes(
    const engine::Device& device, Case& test_case, std::uint32_t frames,
    const std::function<bool()>& stop) {
    ProbeRecorder recorder(device, test_case, frames);
    test_case.reset();
    engine::FrameLoop loop(device, Timing::isolated);
    for (std::uint32_t frame = 0; frame <= frames; ++frame) {
        if (stop()) throw engine::Interrupted();
        loop.frame([&](engine::Passes& passes) {
            if (frame > 0) test_case.simulate(passes);
            recorder.record(passes);
        });
        recorder.frameDone();
    }
    std::vector<double> pass_times = passTimes(loop.finish(), "probe");
    PlayedProbes played = recorder.take();
    played.pass_times = std::move(pass_times);
    return played;
}

void addProbes(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    if (!hair::simulation::hasProbes(run.probes)) return;
    PlayedProbes played =
        playProbes(device, test_case, run.warmup + run.frames + 1, hooks.stop);  // as RoundPlayer
    result.metrics.push_back(
        {{report::MetricOf::probe, report::Measured::simulated_time}, std::move(played.times)});
    for (std::size_t i = 0; i < played.names.size(); ++i)
        result.metrics.push_back(
            {report::metricNamed(played.names[i]), std::move(played.values[i])});
    result.metrics.push_back(
        {{report::MetricOf::probe, report::Measured::time},
         std::move(played.pass_times),
         report::Mode::isolated});
    if (!result.state_hash.empty() && test_case.stateHash() != result.state_hash)
        result.trust.warnings.push_back("frames with probes made other states");
}

std::vector<std::uint8_t> measure(
    const engine::Device& device, Case& test_case, const hair::RunSettings& run,
    const MeasureHooks& hooks, report::CaseResult& result) {
    result.counts = test_case.counts();
    if (const auto backend = test_case.backend())
        result.backend = {hair::backendName(backend->backend), backend->variant, backend->reason};
    StartInspection start = inspectStart(test_case);
    result.start = std::move(start.record);
    std::ranges::move(start.warnings, std::back_inserter(result.trust.warnings));
    DeviceStage stage(device, test_case, run, hooks);
    std::vector<std::uint8_t> picture = measureFrames(stage, run, hooks, result);
    report::CaseResult counted = stage.takeCounted();
    result.statistics = std::move(counted.statistics);
    std::ranges::move(counted.metrics, std::back_inserter(result.metrics));
    std::ranges::move(counted.counts, std::back_inserter(result.counts));
    std::ranges::move(counted.trust.warnings, std::back_inserter(result.trust.warnings));
    result.metrics.push_back(
        {report::ofMemory(report::Measured::allocated),
         {static_cast<double>(device.allocatedBytes())}});
    std::ranges::move(memoryMetrics(device.memory()), std::back_inserter(result.metrics));
    addProbes(device, test_case, run, hooks, result);
    return picture;
}

}  // namespace benchmarks::measure
