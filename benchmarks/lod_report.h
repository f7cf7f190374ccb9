#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report.h"

// What level of detail costs and saves along a camera path, and its JSON: results/lod.schema.json
// describes it.
namespace benchmarks {

inline constexpr const char* kLodSchema = "hairbench-lod/1.0.0";

// Medians of isolated frames, ms.
struct LodTimes {
    double strands = 0.0;  // the pass
    double frame = 0.0;    // from submission to completion
};

// One place of the camera: level of detail by distance against level 0.
struct LodStep {
    double distance = 0.0;    // of the camera from what it looks at, m
    double mean_level = 0.0;  // over root triangles
    std::optional<std::uint64_t> strands;  // drawn with level of detail
    std::uint64_t full_strands = 0;
    double error = 0.0;             // rootMeanSquare of the two pictures
    std::optional<double> popping;  // since the step before
    double coverage = 0.0;  // what hair hides of a square round it
    double full_coverage = 0.0;
    LodTimes time;
    LodTimes full_time;
};

struct LodTotals {
    std::optional<double> worst_popping;
    double mean_coverage_change = 0.0;   // mean of coverage / full_coverage - 1
    double worst_coverage_change = 0.0;  // that of the greatest size
    double strands_speed_up = 0.0;       // of all steps' time
    double frame_speed_up = 0.0;
};

struct LodReport {
    Environment environment;
    SceneRecord scene;
    std::uint32_t frame = 0;
    std::vector<LodStep> steps;
    bool interrupted = false;  // stopped by the user: the steps are those that were done
};

// Wants at least one step.
LodTotals totalsOf(const std::vector<LodStep>& steps);

// Indented JSON. What is not known is absent.
std::string lodReportText(const LodReport& report);

// For a terminal: a row per step, then the totals.
std::string lodTable(const LodReport& report);

}  // namespace benchmarks
