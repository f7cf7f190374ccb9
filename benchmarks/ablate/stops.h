#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "engine/frame_loop.h"
#include "engine/queries.h"
#include "hair/rendering/backends.h"
#include "hair/rendering/strand_plan.h"
#include "hair/settings.h"

// The pictures of one case for the costs of the strands' stages.
namespace benchmarks::ablate {

enum class Stop {
    // The ladder: each rung adds the work of one stage to the rung below.
    empty,  // the pass without a draw
    vertex,
    tessellation_1,  // one drawn segment per guide segment
    tessellation,  // the case's number of segments
    geometry,
    raster,  // without a fragment shader; the rungs below this one discard primitives
    fragment,
    msaa,  // the rungs below have one sample per pixel
    // Other stops, which check the ladder.
    pass,  // the case's own, unmodified
    clipped,  // like fragment, but every primitive is in front of the near plane
    raster_msaa,  // like raster, with the case's sample count
    watched_vertex,  // like fragment, with the stage watched
    watched_evaluation,
    watched_geometry,
};

const char* stopName(Stop stop);
bool isRung(Stop stop);

// How a stop draws the case's strands.
struct StopPlan {
    Stop stop = Stop::empty;
    hair::Settings settings;
    hair::rendering::StrandStages stages;
};

// Rungs from the bottom up, then the others. Stops that are the same in a case are omitted:
// tessellation_1 if it draws one segment per guide segment, msaa and raster_msaa if it has one
// sample. `watch` is a StageWatch's address.
std::vector<StopPlan> planStops(const hair::Settings& settings, std::uint64_t watch);

// Returns why the stages of a case can't be separated, "<JSON pointer>: <reason>"; empty if they
// can.
std::string ablationObstacle(const hair::Settings& settings);

// Times of the strands pass at one stop in one walk up and down the ladder; ms per frame.
struct Lap {
    std::vector<double> up;
    std::vector<double> down;
};

// The mean of both visits' medians, ms. A linear drift adds the same to every stop, because the two
// visits of each stop are symmetric about the same moment, the top of the ladder.
double lapTime(const Lap& lap);

struct StopTimes {
    Stop stop = Stop::empty;
    std::vector<Lap> laps;
};

// Times of a stop, one per lap. The stop must be among `stops`.
std::vector<double> lapTimes(std::span<const StopTimes> stops, Stop stop);
bool hasStop(std::span<const StopTimes> stops, Stop stop);

// Forwards passes and counts the samples of one of them. Borrows all its arguments.
class SampledPasses : public engine::Passes {
public:
    SampledPasses(engine::Passes& passes, std::string counted, engine::SamplesQuery& query)
        : passes_(passes), counted_(std::move(counted)), query_(query) {
        slot_ = passes.slot();
    }

    void pass(
        const char* name, engine::PassKind kind,
        engine::FunctionRef<void(engine::Commands&)> record) override {
        passes_.pass(name, kind, [&](engine::Commands& commands) {
            if (name == counted_) query_.begin(commands);
            record(commands);
            if (name == counted_) query_.end(commands);
        });
    }

private:
    engine::Passes& passes_;
    std::string counted_;
    engine::SamplesQuery& query_;
};

// Counts of a stop's strands pass in untimed frames. Absent if the device does not count.
struct StopCounts {
    std::optional<engine::StatisticCounts> statistics;
    std::optional<std::uint64_t> samples_passed;  // samples that passed the depth test
    std::optional<std::uint64_t>
        watched_invocations;  // invocations of the watched stage, by its own count
};

// The counts, with the expected values where the plan implies them. Only stages of the stop are
// listed, because counters of absent stages are undefined.
std::vector<report::Statistic> stopStatistics(
    const StopPlan& stop, const hair::rendering::StrandPlan& plan, const StopCounts& counts,
    bool approximate_fragments);

// Counts that differ from the expected ones (measure::missedCount()): a driver skipped a stage that
// it should have run, or ran one that it should not. "geometry: geometry_invocations: 0, expected
// 243712".
std::vector<std::string> countWarnings(
    const StopPlan& stop, std::span<const report::Statistic> statistics,
    const engine::DeviceInfo& device);

}  // namespace benchmarks::ablate
