#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/ablate/still_hair.h"
#include "benchmarks/ablate/stop_view.h"
#include "hair/rendering/stage_watch.h"

namespace benchmarks {

// All stops of a case, counted when they are made, then timed.
class LadderWalk {
public:
    // Fills in result.stops but for times, result.image_hash, and what is odd about the counts.
    // Throws engine::Unsupported for what the device can't do, and Interrupted.
    LadderWalk(
        const engine::Device& device, const StillHair& hair, const hair::Settings& settings,
        CaseAblation& result);

    // The plan of the case itself.
    const hair::StrandPlan& plan() const { return pass().plan(); }

    // Up and down so many times. Throws Interrupted; a lap that isn't done is left out.
    void walk(std::uint32_t laps, const std::function<void(const std::string&)>& progress);

private:
    void addStop(StopPlan plan, const StillHair& hair);
    StopView& pass() const;

    const engine::Device& device_;
    hair::StageWatch watch_;
    CaseAblation& result_;
    std::vector<std::unique_ptr<StopView>> views_;
};

}  // namespace benchmarks
