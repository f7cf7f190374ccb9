#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/lod/frozen_view.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"

// Compares levels of detail with a path-traced level 0, lit from several directions.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::lod {

// Degrees from the camera's direction to the light's, about the camera's target and up vector. At 0
// the light comes from the camera; at 180 it comes through the hair.
inline constexpr std::array kLightAngles{0.0, 45.0, 90.0, 180.0};

// A level is compared with a slightly finer one; the difference is the popping.
inline constexpr float kLevelStep = 0.05f;

// Differences between a level's picture and the path-traced picture of level 0: docs/rendering.md.
struct LightErrors {
    double angle = 0.0;  // of kLightAngles
    double flip = 0.0;
    double rmse = 0.0;
    std::optional<double> light_ratio;  // absent if the reference is black
};

struct LevelErrors {
    double level = 0.0;
    std::uint64_t strands = 0;  // drawn
    double coverage = 0.0;  // share of a square round the hair that the hair covers
    double full_coverage = 0.0;
    std::optional<double> popping;  // relative to the level finer by kLevelStep; absent at level
                                    // 0
    std::vector<LightErrors> lights;  // those that are complete
};

struct LodTruth {
    std::uint32_t samples = 0;  // of the path tracer, per pixel
    std::vector<LevelErrors> levels;
};

// The settings with one directional light at this angle, white and of strength 1, a black
// background and linear light. A path tracer can reproduce this exactly.
hair::Settings litFrom(hair::Settings settings, double angle);

// Integer levels from 0 up to /lod/maximum_level, rounded up.
std::vector<float> comparedLevels(const hair::LodSettings& lod);

// Options for path-tracing a frame.
struct TruthOptions {
    std::uint32_t frame = 0;
    std::uint32_t samples = 64;  // per pixel
};

// Fills `truth` from the frozen hair of the case, at the frame of the options. Needs the Python
// environment for references. Throws engine::Error and Interrupted; `truth` then has what was
// complete.
void compareWithTruth(
    const engine::Device& device, const scene::Scene& scene, const measure::Case& hair,
    const hair::Settings& settings, const TruthOptions& options, measure::HairCache& cache,
    LodTruth& truth);

scene::Json truthJson(const LodTruth& truth);

// Text for a terminal: a row per level and light.
std::string truthTable(const LodTruth& truth);

}  // namespace benchmarks::lod
