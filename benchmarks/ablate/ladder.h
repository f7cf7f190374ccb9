#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hair/rendering/strand_stages.h"
#include "hair/settings.h"

// The pictures of one case from whose times the cost of the strands' stages comes.
namespace benchmarks {

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
    hair::StrandStages stages;
};

// Rungs from the bottom up, then the others. Those that a case doesn't tell apart are left out:
// tessellation_1 where it draws one segment a guide segment, msaa and raster_msaa where it has one
// sample. `watch` is a StageWatch's address.
std::vector<StopPlan> planStops(const hair::Settings& settings, std::uint64_t watch);

// Why the stages of such a case can't be taken apart: "<JSON pointer>: <reason>"; empty if they
// can.
std::string ablationObstacle(const hair::Settings& settings);

}  // namespace benchmarks
