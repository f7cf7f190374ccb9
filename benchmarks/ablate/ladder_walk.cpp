#include "benchmarks/ablate/ladder_walk.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "benchmarks/ablate/coverage_check.h"
#include "benchmarks/hash.h"
#include "benchmarks/measure/check_timestamps.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kVisitFrames = 3;  // their median is the visit's time
constexpr std::uint32_t kWarmUps = 2;  // frames of a pipeline before it is timed

// Isolated, or by the CPU's clock where timestamps are wrong.
engine::Timing
trustedTiming(const engine::Device& device, StopView& pass, std::vector<std::string>& warnings) {
    const std::vector<std::string> faults =
        checkTimestamps(device, [&](engine::FrameLoop& loop) { pass.draw(loop); });
    if (faults.empty()) return engine::Timing::isolated;
    warnings.push_back("timestamps are not trusted: times are by the CPU's clock");
    warnings.insert(warnings.end(), faults.begin(), faults.end());
    return engine::Timing::wall_clock;
}

}  // namespace

LadderWalk::LadderWalk(
    const engine::Device& device, const StillHair& hair, const hair::Settings& settings,
    CaseAblation& result)
    : device_(device), watch_(device), result_(result) {
    for (StopPlan& plan : planStops(settings, watch_.address())) addStop(std::move(plan), hair);
    if (settings.strands.texture.empty())
        std::ranges::move(coverageWarnings(result_.stops), std::back_inserter(result_.warnings));
    const std::vector<std::uint8_t> picture = pass().picture();
    result_.image_hash = hashBytes(std::as_bytes(std::span(picture)));
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
        countWarnings(view.stop(), record.statistics), std::back_inserter(result_.warnings));
}

StopView& LadderWalk::pass() const {
    const auto found = std::ranges::find_if(
        views_, [](const auto& view) { return view->stop().stop == Stop::pass; });
    return **found;
}

void LadderWalk::walk(std::uint32_t laps, const std::function<void(const std::string&)>& progress) {
    const engine::Timing timing = trustedTiming(device_, pass(), result_.warnings);
    result_.timing = timing == engine::Timing::isolated ? "isolated" : "wall_clock";
    engine::FrameLoop loop(device_, timing);
    for (const auto& view : views_) view->visit(loop, kWarmUps);
    for (std::uint32_t lap = 0; lap < laps; ++lap) {
        progress("lap " + std::to_string(lap + 1) + '/' + std::to_string(laps));
        std::vector<Lap> visits(views_.size());
        for (std::size_t i = 0; i < views_.size(); ++i)
            visits[i].up = views_[i]->visit(loop, kVisitFrames);
        for (std::size_t i = views_.size(); i-- > 0;)
            visits[i].down = views_[i]->visit(loop, kVisitFrames);
        for (std::size_t i = 0; i < views_.size(); ++i)
            result_.stops[i].times.laps.push_back(std::move(visits[i]));
    }
}

}  // namespace benchmarks
