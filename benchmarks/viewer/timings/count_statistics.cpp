#include "benchmarks/viewer/timings/count_statistics.h"

#include "benchmarks/measure/drawn_counts.h"
#include "engine/frame_loop.h"

namespace benchmarks {

CaseResult countStatistics(const engine::Device& device, Case& shown) {
    CaseResult result;
    if (!device.hasPipelineStatistics()) return result;
    device.runOnce([](engine::Commands&) {});  // the window may still be copying the picture
    engine::FrameLoop loop(device, engine::Timing::statistics);
    loop.frame([&](engine::Passes& passes) { shown.draw(passes); });
    addStatistics(loop.finish().front(), device, shown, result);
    return result;
}

}  // namespace benchmarks
