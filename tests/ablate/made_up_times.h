#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "benchmarks/ablate/stops.h"

namespace benchmarks::ablate {

// Returns laps of one frame a visit. Each stop takes the same time in every lap.
inline std::vector<StopTimes> steadyTimes(const std::map<Stop, double>& times, std::size_t laps) {
    std::vector<StopTimes> stops;
    for (const auto& [stop, time] : times)
        stops.push_back({stop, std::vector<Lap>(laps, Lap{.up = {time}, .down = {time}})});
    return stops;
}

// Returns the times of a case with four samples. Marginal costs are 1, 2, 3, 4, 5, 20, 10 and 15,
// together 60 ms.
inline std::map<Stop, double> sampleTimes() {
    return {
        {Stop::empty, 1.0},
        {Stop::vertex, 3.0},
        {Stop::tessellation_1, 6.0},
        {Stop::tessellation, 10.0},
        {Stop::geometry, 15.0},
        {Stop::raster, 35.0},
        {Stop::fragment, 45.0},
        {Stop::msaa, 60.0},
        {Stop::pass, 60.5},
        {Stop::clipped, 14.0},
        {Stop::raster_msaa, 48.0},
        {Stop::watched_vertex, 45.0},
        {Stop::watched_evaluation, 45.25},
        {Stop::watched_geometry, 45.125}};
}

}  // namespace benchmarks::ablate
