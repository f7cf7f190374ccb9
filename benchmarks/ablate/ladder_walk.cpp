#include "benchmarks/ablate/ladder_walk.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/ablate/stops.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/measure/trust.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/assets.h"
#include "engine/error.h"
#include "engine/process.h"
#include "hair/rendering/backends.h"

namespace benchmarks::ablate {
namespace {

// ---- Samples covered with and without a fragment shader -----------------------------------------

constexpr std::array kAlike{
    std::pair{Stop::raster, Stop::fragment},
    std::pair{Stop::raster_msaa, Stop::msaa},
};

}  // namespace

std::vector<std::string> coverageWarnings(std::span<const StopRecord> stops) {
    std::vector<std::string> warnings;
    for (const auto& [without, with] : kAlike) {
        const std::optional<std::uint64_t> null_count =
            measuredCount(stops, without, "samples_passed");
        const std::optional<std::uint64_t> count = measuredCount(stops, with, "samples_passed");
        if (null_count && count && *null_count != *count)
            warnings.push_back(
                std::string(stopName(without)) + ": covers " + std::to_string(*null_count) +
                " samples, " + stopName(with) + " " + std::to_string(*count));
    }
    return warnings;
}

// ---- Hair that stands still ---------------------------------------------------------------------

StillHair::StillHair(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, std::uint32_t frame, measure::HairCache& cache)
    : case_(device, settings, directory, &cache), mesh_(cache.assets().mesh(settings, directory)),
      assets_(scene::loadRenderAssets(settings, mesh_ ? &*mesh_ : nullptr, directory)) {
    engine::FrameLoop loop(device, engine::Timing::statistics);
    engine::Step step("plays frames", frame + std::uint64_t{1});
    for (std::uint32_t i = 0; i <= frame; ++i) {
        step.advance();
        loop.frame([&](engine::Passes& passes) { case_.simulate(passes); });
    }
}

namespace {

// ---- One stop of the ladder ---------------------------------------------------------------------

constexpr const char* kPass = "strands";

std::optional<engine::SamplesQuery> samplesQuery(const engine::Device& device) {
    try {
        return engine::SamplesQuery(device);
    } catch (const engine::Unsupported&) {
        return std::nullopt;
    }
}

}  // namespace

StopView::StopView(
    const engine::Device& device, StopPlan stop, const hair::rendering::StrandView& hair,
    const hair::rendering::RenderAssets& assets)
    : device_(device), stop_(std::move(stop)), hair_(hair),
      renderer_(device, stop_.settings, hair, assets, stop_.stages) {}

void StopView::draw(engine::FrameLoop& loop) {
    engine::checkInterrupted();
    loop.frame([&](engine::Passes& passes) { renderer_.record(passes, hair_); });
}

std::vector<double> StopView::visit(engine::FrameLoop& loop, std::uint32_t frames) {
    draw(loop);
    loop.finish();
    for (std::uint32_t i = 0; i < frames; ++i) draw(loop);
    return measure::passTimes(loop.finish(), kPass);
}

// Each count uses its own frame, so that no query disturbs another.
StopCounts StopView::count(hair::rendering::StageWatch& watch) {
    StopCounts counts;
    counts.statistics = countStatistics();
    counts.samples_passed = countSamples();
    if (stop_.stages.watched) {
        watch.countAll();
        engine::FrameLoop loop(device_, engine::Timing::wall_clock);
        draw(loop);
        loop.finish();
        counts.watched_invocations = watch.counts().invocations;
        watch.countNone();
    }
    return counts;
}

std::optional<engine::StatisticCounts> StopView::countStatistics() {
    engine::FrameLoop loop(device_, engine::Timing::statistics);
    draw(loop);
    const std::vector<engine::FrameRecord> frames = loop.finish();
    for (const engine::PassStatistics& pass : frames.front().statistics)
        if (pass.name == kPass) return pass.counts;
    return std::nullopt;
}

std::optional<std::uint64_t> StopView::countSamples() {
    std::optional<engine::SamplesQuery> query = samplesQuery(device_);
    if (!query) return std::nullopt;
    engine::FrameLoop loop(device_, engine::Timing::wall_clock);
    loop.frame([&](engine::Passes& passes) {
        SampledPasses sampled(passes, kPass, *query);
        renderer_.record(sampled, hair_);
    });
    loop.finish();
    return query->read();
}

std::vector<std::uint8_t> StopView::picture() const {
    return engine::readOutput(device_, renderer_.target());
}

namespace {

// ---- All stops of a case, up and down -----------------------------------------------------------

// All stops of a case. They are counted when they are created, then timed.
class LadderWalk {
public:
    // Fills in result.stops except for their times, result.image_hash, and warnings about the
    // counts. Throws engine::Unsupported if the device lacks a feature, and Interrupted.
    LadderWalk(
        const engine::Device& device, const StillHair& hair, const hair::Settings& settings,
        CaseAblation& result);

    // The plan of the case itself.
    const hair::rendering::StrandPlan& plan() const { return pass().plan(); }

    // Walks up and down `laps` times. Throws Interrupted; an incomplete lap is dropped.
    void walk(std::uint32_t laps, const std::function<void(const std::string&)>& progress);

private:
    void addStop(StopPlan plan, const StillHair& hair);
    StopView& pass() const;

    const engine::Device& device_;
    hair::rendering::StageWatch watch_;
    CaseAblation& result_;
    std::vector<std::unique_ptr<StopView>> views_;
};

constexpr std::uint32_t kVisitFrames = 3;  // the visit's time is their median
constexpr std::uint32_t kWarmUps = 2;  // frames per pipeline before timing

// Isolated timing, or the CPU's clock if timestamps are wrong.
engine::Timing
trustedTiming(const engine::Device& device, StopView& pass, std::vector<std::string>& warnings) {
    engine::FrameLoop timestamped(device, engine::Timing::isolated);
    engine::FrameLoop clocked(device, engine::Timing::wall_clock);
    const auto played = [&](engine::FrameLoop& loop) {
        return measure::PlayedFrames{[&] { pass.draw(loop); }, [&] { return loop.finish(); }};
    };
    const std::vector<std::string> faults =
        measure::checkTimestamps(played(timestamped), played(clocked));
    if (faults.empty()) return engine::Timing::isolated;
    warnings.push_back("timestamps are not trusted: times come from the CPU's clock");
    warnings.insert(warnings.end(), faults.begin(), faults.end());
    return engine::Timing::wall_clock;
}

LadderWalk::LadderWalk(
    const engine::Device& device, const StillHair& hair, const hair::Settings& settings,
    CaseAblation& result)
    : device_(device), watch_(device), result_(result) {
    if (settings.copies.count > 1)
        throw engine::Error("/copies/count", "costs of stages are measured on one head");
    for (StopPlan& plan : planStops(settings, watch_.address())) addStop(std::move(plan), hair);
    if (settings.strands.texture.empty())
        std::ranges::move(coverageWarnings(result_.stops), std::back_inserter(result_.warnings));
    const std::vector<std::uint8_t> picture = pass().picture();
    result_.image_hash = report::hashBytes(std::as_bytes(std::span(picture)));
}

void LadderWalk::addStop(StopPlan plan, const StillHair& hair) {
    views_.push_back(
        std::make_unique<StopView>(device_, std::move(plan), hair.view(), hair.assets()));
    StopView& view = *views_.back();
    StopRecord& record = result_.stops.emplace_back();
    record.times.stop = view.stop().stop;
    record.tessellation = view.plan().forced_tessellation;
    record.samples = view.stop().settings.render.msaa;
    record.statistics = stopStatistics(
        view.stop(), view.plan(), view.count(watch_), device_.fragmentCountsAreApproximate());
    std::ranges::move(
        countWarnings(view.stop(), record.statistics, device_.info()),
        std::back_inserter(result_.warnings));
}

StopView& LadderWalk::pass() const {
    const auto found = std::ranges::find_if(
        views_, [](const auto& view) { return view->stop().stop == Stop::pass; });
    return **found;
}

void LadderWalk::walk(std::uint32_t laps, const std::function<void(const std::string&)>& progress) {
    std::vector<std::string> warnings;
    const engine::Timing timing = trustedTiming(device_, pass(), warnings);
    {
        const engine::HeldMessages held;
        std::ranges::move(warnings, std::back_inserter(result_.warnings));
        result_.timing = timing == engine::Timing::isolated ? "isolated" : "wall_clock";
    }
    engine::FrameLoop loop(device_, timing);
    for (const auto& view : views_) view->visit(loop, kWarmUps);
    for (std::uint32_t lap = 0; lap < laps; ++lap) {
        progress("lap " + std::to_string(lap + 1) + '/' + std::to_string(laps));
        std::vector<Lap> visits(views_.size());
        for (std::size_t i = 0; i < views_.size(); ++i)
            visits[i].up = views_[i]->visit(loop, kVisitFrames);
        for (std::size_t i = views_.size(); i-- > 0;)
            visits[i].down = views_[i]->visit(loop, kVisitFrames);
        const engine::HeldMessages held;  // they write the laps
        for (std::size_t i = 0; i < views_.size(); ++i)
            result_.stops[i].times.laps.push_back(std::move(visits[i]));
    }
}

// ---- A case -------------------------------------------------------------------------------------

WorkCounts workOf(const std::vector<StopRecord>& stops, const hair::rendering::StrandPlan& plan) {
    constexpr const char* kEvaluations = "tessellation_evaluation_invocations";
    WorkCounts work{
        .patches = plan.patches(),
        .segments = measuredCount(stops, Stop::geometry, "geometry_invocations"),
        .evaluations_1 = measuredCount(stops, Stop::tessellation_1, kEvaluations),
        .evaluations = measuredCount(stops, Stop::tessellation, kEvaluations),
        .fragments = measuredCount(stops, Stop::fragment, "samples_passed"),
        .samples = measuredCount(stops, Stop::msaa, "samples_passed")};
    if (plan.lod_mode == hair::LodMode::forced) work.strands = plan.strands();
    if (!work.fragments) {
        work.fragments = measuredCount(stops, Stop::fragment, "fragment_invocations");
        work.fragments_note = "approximate";
    }
    return work;
}

void attributeCase(const hair::rendering::StrandPlan& plan, CaseAblation& result) {
    if (result.attribution || result.stops.front().times.laps.empty()) return;
    std::vector<StopTimes> times;
    for (const StopRecord& stop : result.stops) times.push_back(stop.times);
    result.attribution = attribute(times);
    result.unit_costs = unitCosts(result.attribution->rungs, workOf(result.stops, plan));
    std::ranges::move(
        attributionWarnings(*result.attribution), std::back_inserter(result.warnings));
}

void measureCase(
    const engine::Device& device, const scene::CaseSpec& spec,
    const std::filesystem::path& directory, std::uint32_t laps,
    const std::function<void(const std::string&)>& progress, measure::HairCache& cache,
    CaseAblation& result) {
    hair::Settings settings = spec.settings;
    settings.strands.backend = hair::Backend::tessellation;
    progress("simulation");
    const StillHair hair(device, settings, directory, result.frame, cache);
    result.counts = hair.counts();
    progress("pipelines");
    LadderWalk ladder(device, hair, settings, result);
    const auto attribute_done = [&] { attributeCase(ladder.plan(), result); };
    const engine::InterruptMessage last_words(attribute_done);
    try {
        ladder.walk(laps, progress);
    } catch (const engine::Interrupted&) {
        attribute_done();
        throw;
    }
    const engine::HeldMessages held;
    attribute_done();
}

}  // namespace

void ablateCase(
    const engine::Device& device, const scene::CaseSpec& spec,
    const std::filesystem::path& directory, std::uint32_t laps,
    const std::function<void(const std::string&)>& progress, measure::HairCache& cache,
    CaseAblation& result) {
    const hair::RunSettings& run = spec.settings.run;
    {
        const engine::HeldMessages held;
        result = {.name = spec.name, .axes = spec.axes, .frame = run.warmup + run.frames};
    }
    const auto without = [&](report::Status status, const std::string& reason) {
        const engine::HeldMessages held;
        result = {.name = spec.name, .axes = spec.axes, .status = status, .reason = reason};
    };
    if (const std::string obstacle = ablationObstacle(spec.settings); !obstacle.empty())
        return without(report::Status::skipped, obstacle);
    try {
        measureCase(device, spec, directory, laps, progress, cache, result);
    } catch (const engine::Unsupported& error) {
        without(report::Status::skipped, error.what());
    } catch (const engine::Error& error) {
        without(report::Status::failed, error.what());
    }
}

}  // namespace benchmarks::ablate
