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

// The pictures of one case from whose times the cost of the strands' stages comes.
namespace benchmarks::ablate {

enum class Stop {
    // The ladder: each with one stage's work more than the one before.
    empty,  // the pass without a draw
    vertex,
    tessellation_1,  // one drawn segment a guide segment
    tessellation,  // as many as the case has
    geometry,
    raster,  // without a fragment shader; up to here primitives are discarded
    fragment,
    msaa,  // up to here with one sample a pixel
    // Others, that the ladder is checked with.
    pass,  // the case's own, as it always is
    clipped,  // fragment, but every primitive is nearer than the near plane
    raster_msaa,  // raster, with the case's samples
    watched_vertex,  // fragment, with the stage watched
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

// Rungs from the bottom up, then the others. Those that a case doesn't tell apart are left out:
// tessellation_1 where it draws one segment a guide segment, msaa and raster_msaa where it has one
// sample. `watch` is a StageWatch's address.
std::vector<StopPlan> planStops(const hair::Settings& settings, std::uint64_t watch);

// Why the stages of such a case can't be taken apart: "<JSON pointer>: <reason>"; empty if they
// can.
std::string ablationObstacle(const hair::Settings& settings);

// The strands pass at one stop in one walk up the ladder and down again; ms of each frame.
struct Lap {
    std::vector<double> up;
    std::vector<double> down;
};

// The mean of both visits' medians, ms. What drifts evenly adds as much to every stop: they are
// visited evenly round the same moment, the top of the ladder.
double lapTime(const Lap& lap);

struct StopTimes {
    Stop stop = Stop::empty;
    std::vector<Lap> laps;
};

// Times of a stop, which must be among `stops`, one for each lap.
std::vector<double> lapTimes(std::span<const StopTimes> stops, Stop stop);
bool hasStop(std::span<const StopTimes> stops, Stop stop);

// Passes of which one's samples are counted. Borrows all.
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

// What the strands pass of a stop did in untimed frames. Absent where the device doesn't count.
struct StopCounts {
    std::optional<engine::StatisticCounts> statistics;
    std::optional<std::uint64_t> samples_passed;  // the depth test
    std::optional<std::uint64_t> seen;  // invocations of the watched stage, by its own count
};

// What was counted, with what the plan implies where it implies something: of stages that the stop
// has; counters of absent stages are undefined, so that only what is expected is listed.
std::vector<report::Statistic> stopStatistics(
    const StopPlan& stop, const hair::rendering::StrandPlan& plan, const StopCounts& counts,
    bool approximate_fragments);

// Counts that are not what is expected (measure::missedCount()): a driver that left out a stage
// that it should have run, or ran one that it shouldn't. "geometry: geometry_invocations: 0,
// expected 243712".
std::vector<std::string> countWarnings(
    const StopPlan& stop, std::span<const report::Statistic> statistics,
    const engine::DeviceInfo& device);

}  // namespace benchmarks::ablate
