#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "benchmarks/ablate/ladder.h"
#include "benchmarks/ablate/stop_counts.h"
#include "engine/frame_loop.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/stage_watch.h"
#include "hair/rendering/strand_view.h"

namespace benchmarks {

// Hair that stands still, drawn as one stop has it.
class StopView {
public:
    // Throws engine::Unsupported for what the device can't do.
    StopView(
        const engine::Device& device, StopPlan stop, const hair::StrandView& hair,
        const hair::RenderAssets& assets);

    const StopPlan& stop() const { return stop_; }
    const hair::StrandPlan& plan() const { return renderer_.plan(); }

    // Throws Interrupted where the user stopped the program.
    void draw(engine::FrameLoop& loop);

    // The strands pass of so many frames, after one that isn't timed, ms.
    std::vector<double> visit(engine::FrameLoop& loop, std::uint32_t frames);

    // By frames of their own. Leaves `watch` seeing next to none.
    StopCounts count(hair::StageWatch& watch);

    // Of the last frame, [row][column] RGBA, top row first. Waits for the device.
    std::vector<std::uint8_t> picture() const;

private:
    std::optional<engine::StatisticCounts> countStatistics();
    std::optional<std::uint64_t> countSamples();

    const engine::Device& device_;
    StopPlan stop_;
    hair::StrandView hair_;
    hair::Renderer renderer_;
};

}  // namespace benchmarks
