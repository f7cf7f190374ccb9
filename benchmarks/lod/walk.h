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

// What level of detail costs and saves along a camera path, and its report, which
// results/lod.schema.json describes.
namespace benchmarks::lod {

inline constexpr const char* kLodSchema = "hairbench-lod/1.0.0";

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
    double worst_coverage_change = 0.0;  // the change of the greatest size
    double strands_speed_up = 0.0;       // of all steps' time
    double frame_speed_up = 0.0;
};

struct LodReport {
    report::Environment environment;
    report::SceneRecord scene;
    std::uint32_t frame = 0;
    std::vector<LodStep> steps;
    std::optional<LodTruth> truth;  // where it was asked for
    bool interrupted = false;  // stopped by the user: the steps are those that were done
};

// Wants at least one step.
LodTotals totalsOf(const std::vector<LodStep>& steps);

// Indented JSON. What is not known is absent.
std::string lodReportText(const LodReport& report);

// For a terminal: a row per step, the totals, then a row per level and light.
std::string lodTable(const LodReport& report);

// Away from what the camera looks at, in the direction that it is seen from.
struct LodPath {
    double from = 0.5;  // m, distance from /camera/target
    double to = 20.0;
    std::uint32_t steps = 40;
};

// Distances of the steps, m: each as many times farther as the one before.
std::vector<double> distancesOf(const LodPath& path);

// The scene's camera, at this distance from its target.
hair::CameraSettings cameraAt(const hair::CameraSettings& camera, double distance);

// Draws the hair of one frame of the case, frozen, from every place of the path: by /lod with the
// mode distance, and at level 0. `settings` are the case's. `begin` is called with each distance.
// Throws Interrupted between pictures; `steps` then has what was done.
void walk(
    const engine::Device& device, measure::Case& hair, const hair::Settings& settings,
    const LodPath& path, const std::function<void(double)>& begin, std::vector<LodStep>& steps);

}  // namespace benchmarks::lod
