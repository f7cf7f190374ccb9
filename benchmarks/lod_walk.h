#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "benchmarks/case.h"
#include "benchmarks/lod_report.h"

namespace benchmarks {

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
    const engine::Device& device, Case& hair, const hair::Settings& settings, const LodPath& path,
    const std::function<void(double)>& begin, std::vector<LodStep>& steps);

}  // namespace benchmarks
