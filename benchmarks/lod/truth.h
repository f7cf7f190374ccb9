#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/lod/frozen_view.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"

// Levels of detail against what a path tracer makes of level 0, lit from round about.
namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::lod {

// Degrees from the camera's direction to the light's, about the camera's target and up: 0 lights
// what is seen, 180 comes through the hair.
inline constexpr std::array kLightAngles{0.0, 45.0, 90.0, 180.0};

// A level is compared with what it is a little finer; what that changes is popping.
inline constexpr float kLevelStep = 0.05f;

// How far a level's picture is from the path-traced one of level 0: docs/rendering.md.
struct LightErrors {
    double angle = 0.0;  // of kLightAngles
    double flip = 0.0;
    double rmse = 0.0;
    std::optional<double> light_ratio;  // absent where the reference is black
};

struct LevelErrors {
    double level = 0.0;
    std::uint64_t strands = 0;  // drawn
    double coverage = 0.0;      // what hair hides of a square round it
    double full_coverage = 0.0;
    std::optional<double> popping;    // since kLevelStep before; of level 0 there is none
    std::vector<LightErrors> lights;  // those that were done
};

struct LodTruth {
    std::uint32_t samples = 0;  // of the path tracer, a pixel
    std::vector<LevelErrors> levels;
};

// The settings with one directional light at this angle, white, of strength 1, in front of black
// and in linear light: what is the same for a path tracer.
hair::Settings litFrom(hair::Settings settings, double angle);

// Whole levels from 0 on, up to /lod/maximum_level or the next one.
std::vector<float> comparedLevels(const hair::LodSettings& lod);

// How a frame is path-traced.
struct TruthOptions {
    std::uint32_t frame = 0;
    std::uint32_t samples = 64;  // of a pixel
};

// Fills `truth` from the frozen hair of the case, whose frame is that of the options. Needs the
// environment of references. Throws engine::Error, Interrupted; `truth` then has what was done.
void compareWithTruth(
    const engine::Device& device, const scene::Scene& scene, const measure::Case& hair,
    const hair::Settings& settings, const TruthOptions& options, measure::HairCache& cache,
    LodTruth& truth);

scene::Json truthJson(const LodTruth& truth);

// For a terminal: a row per level and light.
std::string truthTable(const LodTruth& truth);

}  // namespace benchmarks::lod
