#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/scene/axis.h"
#include "benchmarks/scene/scene.h"
#include "engine/device.h"

// Cases of scenes, sweeps and suites.
namespace benchmarks::scene {

class AssetStore;

// Whether the file is a suite: a file that names scenes, relative to itself: {"$schema": ...,
// "description": ..., "suite": ["thesis.json", "msaa.json"]}. A suite may not contain suites.
bool isSuite(const std::filesystem::path& path);

// Loads the scene, or all scenes of a suite in its order. Throws engine::Error like loadScene(),
// and for a suite without scenes, with the same scene name twice, with another member, or with a
// scene out of its reach.
std::vector<Scene>
loadScenes(const std::filesystem::path& path, Outside outside = Outside::refused);

// One combination of a sweep's values.
struct CaseSpec {
    std::string name;  // "thesis/guides:86/msaa:4", unique; the scene's name without a sweep
    std::vector<AxisValue> axes;  // in the sweep's order
    hair::Settings settings;
};

// Returns the Cartesian product of the scene's axes in their written order, the last one fastest,
// without the cases that the scene excludes. An override replaces the values of the axis with its
// pointer, in place, or adds an axis at the end. Throws engine::Error for an override of an unknown
// field, with an invalid value or of a tied field ("-a: <pointer>: ..."), for a field twice or
// inside another, for more than kMaximumCases combinations, if all are excluded, and for a case
// that breaks a rule between fields ("<file>: <case>: <pointer>: ...").
std::vector<CaseSpec> expand(const Scene& scene, std::span<const Axis> overrides = {});

// Selects the cases of a scene and the device.
struct SceneOptions {
    std::filesystem::path scene;
    std::vector<std::string> axes;  // "POINTER=V1,V2"
    std::optional<std::uint32_t> frames;
    std::optional<std::uint32_t> warmup;
    std::optional<double> precision;  // share
    std::optional<double> max_time;  // s
    std::vector<std::string> sets;  // "POINTER=VALUE": fields of every case, none of them an axis
    engine::DeviceOptions device;
    bool reads_assets = true;  // check every file before anything is made from them
    bool cache = true;  // cache slow results on disk
    Outside outside = Outside::refused;  // applies to files that the scene names, not to those in
                                         // `sets` and `axes`
};

// Returns the scene's cases, changed by the command line. Reads every asset of the cases once if
// options.reads_assets is set, and keeps meshes and grooms in `assets`. Adds warnings about odd
// assets (checkAssets()) to `warnings`, each once. Both may be null. Throws engine::Error like
// expand(), and for a field that is set and swept, because setting it would have no effect.
std::vector<CaseSpec> selectCases(
    Scene& scene, const SceneOptions& options, AssetStore* assets = nullptr,
    std::vector<std::string>* warnings = nullptr);

// Returns the scene's own settings, changed by the command line, with no axis applied except the
// command line's. This is for commands that play one case.
CaseSpec singleCase(Scene& scene, const SceneOptions& options, AssetStore* assets = nullptr);

}  // namespace benchmarks::scene
