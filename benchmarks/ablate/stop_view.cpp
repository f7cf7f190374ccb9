#include "benchmarks/ablate/stop_view.h"

#include <optional>
#include <utility>

#include "benchmarks/ablate/sampled_passes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/trust.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

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
    const engine::Device& device, StopPlan stop, const hair::StrandView& hair,
    const hair::RenderAssets& assets)
    : device_(device), stop_(std::move(stop)), hair_(hair),
      renderer_(device, stop_.settings, hair, assets, stop_.stages) {}

void StopView::draw(engine::FrameLoop& loop) {
    checkInterrupted();
    loop.frame([&](engine::Passes& passes) { renderer_.record(passes, hair_); });
}

std::vector<double> StopView::visit(engine::FrameLoop& loop, std::uint32_t frames) {
    draw(loop);
    loop.finish();
    for (std::uint32_t i = 0; i < frames; ++i) draw(loop);
    return passTimes(loop.finish(), kPass);
}

// In frames of their own each: no count is spoilt by another query.
StopCounts StopView::count(hair::StageWatch& watch) {
    StopCounts counts;
    counts.statistics = countStatistics();
    counts.samples_passed = countSamples();
    if (stop_.stages.watched) {
        watch.seeAll();
        engine::FrameLoop loop(device_, engine::Timing::wall_clock);
        draw(loop);
        loop.finish();
        counts.seen = watch.seen().invocations;
        watch.seeNone();
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

}  // namespace benchmarks
