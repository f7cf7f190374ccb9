#include "benchmarks/ablate/ablate_case.h"

#include <algorithm>
#include <iterator>

#include "benchmarks/ablate/ladder_walk.h"
#include "benchmarks/ablate/still_hair.h"
#include "benchmarks/interrupt.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

WorkCounts workOf(const std::vector<StopRecord>& stops, const hair::StrandPlan& plan) {
    constexpr const char* kEvaluations = "tessellation_evaluation_invocations";
    WorkCounts work{
        .patches = plan.patches(),
        .strands = {},
        .segments = measuredCount(stops, Stop::geometry, "geometry_invocations"),
        .evaluations_1 = measuredCount(stops, Stop::tessellation_1, kEvaluations),
        .evaluations = measuredCount(stops, Stop::tessellation, kEvaluations),
        .fragments = measuredCount(stops, Stop::fragment, "samples_passed"),
        .samples = measuredCount(stops, Stop::msaa, "samples_passed"),
        .fragments_note = {}};
    if (plan.lod_mode == hair::LodMode::forced) work.strands = plan.strands();
    if (!work.fragments) {
        work.fragments = measuredCount(stops, Stop::fragment, "fragment_invocations");
        work.fragments_note = "approximate";
    }
    return work;
}

void attributeCase(const hair::StrandPlan& plan, CaseAblation& result) {
    if (result.stops.front().times.laps.empty()) return;
    std::vector<StopTimes> times;
    for (const StopRecord& stop : result.stops) times.push_back(stop.times);
    result.attribution = attribute(times);
    result.unit_costs = unitCosts(result.attribution->rungs, workOf(result.stops, plan));
    std::ranges::move(
        attributionWarnings(*result.attribution), std::back_inserter(result.warnings));
}

void measureCase(
    const engine::Device& device, const CaseSpec& spec, const std::filesystem::path& directory,
    std::uint32_t laps, const std::function<void(const std::string&)>& progress,
    CaseAblation& result) {
    progress("simulation");
    const StillHair hair(device, spec.settings, directory, result.frame);
    result.counts = hair.counts();
    progress("pipelines");
    LadderWalk ladder(device, hair, spec.settings, result);
    try {
        ladder.walk(laps, progress);
    } catch (const Interrupted&) {
        attributeCase(ladder.plan(), result);
        throw;
    }
    attributeCase(ladder.plan(), result);
}

}  // namespace

void ablateCase(
    const engine::Device& device, const CaseSpec& spec, const std::filesystem::path& directory,
    std::uint32_t laps, const std::function<void(const std::string&)>& progress,
    CaseAblation& result) {
    const hair::RunSettings& run = spec.settings.run;
    result = {.name = spec.name, .axes = spec.axes, .frame = run.warmup + run.frames};
    const auto without = [&](Status status, const std::string& reason) {
        result = {.name = spec.name, .axes = spec.axes, .status = status, .reason = reason};
    };
    if (const std::string obstacle = ablationObstacle(spec.settings); !obstacle.empty())
        return without(Status::skipped, obstacle);
    try {
        measureCase(device, spec, directory, laps, progress, result);
    } catch (const engine::Unsupported& error) {
        without(Status::skipped, error.what());
    } catch (const engine::Error& error) {
        without(Status::failed, error.what());
    }
}

}  // namespace benchmarks
