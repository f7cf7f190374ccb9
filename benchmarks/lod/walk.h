#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/scene/sweep.h"
#include "engine/frame_loop.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/strand_plan.h"

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

// Pictures of the hair of one frame, drawn with settings other than the case's.

// [row][column] RGBA, display values.
using Picture = std::vector<std::uint8_t>;

// Differences of pictures of one size, [row][column] RGBA, are over the red, green and blue of all
// pixels; display values count from 0 to 1.

// Root of the mean square difference.
double rootMeanSquare(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

// Returns the change by level of detail between two steps of a path, beyond the change that the
// steps make in any case: the root mean square of (b - a) - (full_b - full_a).
double popping(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b);

// Returns the mean magnitude of (b - a) - (full_b - full_a).
double shimmerBetween(
    std::span<const std::uint8_t> a, std::span<const std::uint8_t> b,
    std::span<const std::uint8_t> full_a, std::span<const std::uint8_t> full_b);

// The mean red of a picture with a black background: the share that white hair covers.
double whiteShare(std::span<const std::uint8_t> picture);

// Medians of isolated frames, ms.
struct LodTimes {
    double strands = 0.0;  // the pass
    double frame = 0.0;  // from submission to completion
};

// Returns the settings with a forced level of detail.
hair::Settings atLevel(hair::Settings settings, float level);

// White hair alone on black, opaque, with 16 samples per pixel. Its mean is the area that the hair
// covers.
hair::Settings coverageOf(hair::Settings settings);

// Zooms the camera in so that the square just contains the hair's bounding sphere. The resolution
// of the measure then does not depend on the distance.
hair::CameraSettings
zoomedOn(const hair::rendering::StrandView& view, const hair::CameraSettings& camera);

// Pictures of the frozen hair with one set of settings.
class FrozenView {
public:
    FrozenView(
        const engine::Device& device, const measure::Case& hair, const hair::Settings& settings);

    void setCamera(const hair::CameraSettings& camera) { renderer_.setCamera(camera); }
    void setLodError(float pixels) { renderer_.setLodError(pixels); }
    std::uint64_t strands() const { return renderer_.plan().strands(); }
    std::uint64_t segments() const { return renderer_.plan().drawnSegments(); }

    // Throws Interrupted.
    void draw();

    // Medians of the frames since the last call.
    LodTimes times();

    // Level of the frame before, over root triangles, and its strands; only for levels by cluster.
    hair::rendering::DistanceLod clusters() const;
    // The drawn segments of the same strands.
    std::uint64_t clusterSegments() const;

    Picture picture();

    // Linear light, [row][column] RGB; requires a tone map in the settings.
    std::vector<float> radiance();

private:
    const engine::Device& device_;
    hair::rendering::StrandView view_;
    hair::rendering::Renderer renderer_;
    engine::FrameLoop loop_;
};

// Costs and savings of level of detail along a camera path, and their report, which
// results/lod.schema.json describes.

inline constexpr const char* kLodSchema = "hairbench-lod/1.2.0";

// Levels of detail at one camera position, compared with level 0.
struct LodDrawn {
    double mean_level = 0.0;  // over root triangles
    std::optional<std::uint64_t> strands;  // drawn
    std::optional<std::uint64_t> segments;  // drawn; known by cluster
    double error = 0.0;  // rootMeanSquare of the two pictures
    double flip = 0.0;  // mean FLIP between them
    std::optional<double> popping;  // since the previous step
    double coverage = 0.0;  // share of a square round the hair that the hair covers
    LodTimes time;
};

// One camera position.
struct LodStep {
    double distance = 0.0;  // of the camera from its target, m
    LodDrawn drawn;  // by distance
    std::optional<LodDrawn> clusters;  // if requested
    std::uint64_t full_strands = 0;
    std::uint64_t full_segments = 0;
    double full_coverage = 0.0;
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

// Which of a step's levels are summed up.
enum class LodKind { distance, cluster };

// Needs at least one step, with these levels.
LodTotals totalsOf(const std::vector<LodStep>& steps, LodKind kind = LodKind::distance);

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

// Draws the frozen hair of one frame of the case from every position of the path, by /lod with the
// mode distance, at level 0 and, for LodKind::cluster, also with that mode. `settings` are the
// case's. `begin` is called with each distance. Throws Interrupted between pictures; `steps` then
// has what was complete.
void walk(
    const engine::Device& device, measure::Case& hair, const hair::Settings& settings,
    const LodPath& path, LodKind kind, const std::function<void(double)>& begin,
    std::vector<LodStep>& steps);

// How much a still subject shimmers while the camera walks round it: what its pictures change by
// from one view to the next, beyond what supersampled pictures change by.

// Views along an arc about the camera's target and up vector that begins at the scene's camera.
struct TurnPath {
    double degrees = 12.0;  // of the whole arc
    std::uint32_t steps = 24;  // from one view to the next
};

// Means over the steps of the path and over red, green and blue of all pixels, in display values
// from 0 to 1.
struct Shimmer {
    double shimmer = 0.0;  // shimmerBetween() the views of each step
    double change = 0.0;  // mean magnitude of the truth's change in a step
    double error = 0.0;  // mean magnitude of the difference from the truth, over the views
};

// Returns the scene's camera turned by an angle, in degrees, about its target and up vector. A
// positive angle moves it to its right.
hair::CameraSettings cameraTurned(const hair::CameraSettings& camera, double degrees);

// Returns the settings with 64 samples per pixel, 16 of them shaded, and sampled coverage; without
// transparency if hair is opaque.
hair::Settings supersampled(hair::Settings settings);

// The supersampled pictures of one path, which cases share that differ in their sampling alone.
class TurnTruth {
public:
    // Draws the views of the path unless they are those of the call before. `hair` is a case in
    // the same frame each time. Calls `begin` with each angle. Throws Interrupted.
    const std::vector<Picture>& pictures(
        const engine::Device& device, const measure::Case& hair, const hair::Settings& settings,
        const TurnPath& path, const std::function<void(double)>& begin);

private:
    std::optional<hair::Settings> settings_;  // of `pictures_`
    std::vector<Picture> pictures_;
};

// Draws the frozen hair of the case from every view of the path and compares it with the truth,
// which has the same path. Calls `begin` with each angle. Throws Interrupted.
Shimmer shimmerOf(
    const engine::Device& device, const measure::Case& hair, const hair::Settings& settings,
    const TurnPath& path, std::span<const Picture> truth, const std::function<void(double)>& begin);

// A case's name, its values on the axes of the sweep, and its figures.
struct ShimmerCase {
    std::string name;
    std::vector<scene::AxisValue> axes;
    Shimmer figures;
};

scene::Json shimmerJson(const std::vector<ShimmerCase>& cases);

// Text for a terminal: a row per case.
std::string shimmerTable(const std::vector<ShimmerCase>& cases);

}  // namespace benchmarks::lod
