#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/lod/frozen_view.h"
#include "benchmarks/lod/truth.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"

// Costs and savings of level of detail along a camera path, and their report, which
// results/lod.schema.json describes.
namespace benchmarks::lod {

inline constexpr const char* kLodSchema = "hairbench-lod/1.0.0";

// One camera position: level of detail by distance, compared with level 0.
struct LodStep {
    double distance = 0.0;  // of the camera from its target, m
    double mean_level = 0.0;  // over root triangles
    std::optional<std::uint64_t> strands;  // drawn with level of detail
    std::uint64_t full_strands = 0;
    double error = 0.0;  // rootMeanSquare of the two pictures
    std::optional<double> popping;  // since the previous step
    double coverage = 0.0;  // share of a square round the hair that the hair covers
    double full_coverage = 0.0;
    LodTimes time;
    LodTimes full_time;
};

struct LodTotals {
    std::optional<double> worst_popping;
    double mean_coverage_change = 0.0;  // mean of coverage / full_coverage - 1
    double worst_coverage_change = 0.0;  // the change of greatest magnitude
    double strands_speed_up = 0.0;  // from the total times of all steps
    double frame_speed_up = 0.0;
};

struct LodReport {
    report::Environment environment;
    report::SceneRecord scene;
    std::uint32_t frame = 0;
    std::vector<LodStep> steps;
    std::optional<LodTruth> truth;  // if requested
    bool interrupted = false;  // stopped by the user: `steps` has those that were complete
};

// Needs at least one step.
LodTotals totalsOf(const std::vector<LodStep>& steps);

// Indented JSON. Unknown values are absent.
std::string lodReportText(const LodReport& report);

// Text for a terminal: a row per step, the totals, then a row per level and light.
std::string lodTable(const LodReport& report);

// A path away from the camera's target, in the direction of the scene's camera.
struct LodPath {
    double from = 0.5;  // m, distance from /camera/target
    double to = 20.0;
    std::uint32_t steps = 40;
};

// Distances of the steps, m, in geometric progression.
std::vector<double> distancesOf(const LodPath& path);

// The scene's camera at this distance from its target.
hair::CameraSettings cameraAt(const hair::CameraSettings& camera, double distance);

// Draws the frozen hair of one frame of the case from every position of the path, once by /lod with
// the mode distance and once at level 0. `settings` are the case's. `begin` is called with each
// distance. Throws Interrupted between pictures; `steps` then has what was complete.
void walk(
    const engine::Device& device, measure::Case& hair, const hair::Settings& settings,
    const LodPath& path, const std::function<void(double)>& begin, std::vector<LodStep>& steps);

}  // namespace benchmarks::lod
