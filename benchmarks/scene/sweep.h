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

// A suite is a file that names scenes, each relative to it: {"$schema": ..., "description": ...,
// "suite": ["thesis.json", "msaa.json"]}. Suites of suites are not.
bool isSuite(const std::filesystem::path& path);

// The scene, or all of a suite's in its order. Throws engine::Error: what loadScene() throws, a
// suite that names none or one twice, another member, a member out of the suite's reach.
std::vector<Scene>
loadScenes(const std::filesystem::path& path, Outside outside = Outside::refused);

inline constexpr std::size_t kMaximumCases = 100000;

// One combination of a sweep's values.
struct CaseSpec {
    std::string name;  // "thesis/guides:86/msaa:4", distinct; the scene's name if nothing is swept
    std::vector<AxisValue> axes;  // in the sweep's order
    hair::Settings settings;
};

// The cartesian product of the scene's axes in their written order, the last one fastest, without
// what the scene excludes. An override replaces the values of the axis with its pointer, in place,
// or adds an axis at the end. Throws engine::Error: an override that names no field, a value it
// does not take or a field that is tied to others ("-a: <pointer>: ..."), a field twice or inside
// another, more than kMaximumCases combinations or all of them excluded, a case that breaks a rule
// between fields ("<file>: <case>: <pointer>: ...").
std::vector<CaseSpec> expand(const Scene& scene, std::span<const Axis> overrides = {});

// The scene's resolved document with the values of a case: what the case's settings are read from.
Document caseDocument(const Scene& scene, std::span<const AxisValue> axes);

// Which cases of a scene, and on what.
struct SceneOptions {
    std::filesystem::path scene;
    std::vector<std::string> axes;  // "POINTER=V1,V2"
    std::optional<std::uint32_t> frames;
    std::optional<std::uint32_t> warmup;
    std::optional<double> precision;  // a share
    std::optional<double> max_time;  // s
    std::vector<std::string> sets;  // "POINTER=VALUE": fields of every case
    engine::DeviceOptions device;
    bool reads_assets = true;  // before anything is made of them
    bool cache = true;  // what takes long to make is taken from disk and kept there
    Outside outside =
        Outside::refused;  // files that the scene names, not those of `sets` and `axes`
};

// The scene's cases with what the command line changes. Every asset that they name is read once,
// where options.reads_assets says so, and meshes and grooms are left in `assets`. What is odd about
// assets (checkAssets()) is added to `warnings`, each once. Both may be null.
std::vector<CaseSpec> selectCases(
    Scene& scene, const SceneOptions& options, AssetStore* assets = nullptr,
    std::vector<std::string>* warnings = nullptr);

// The scene's own settings, no axis applied but those of the command line with one value, with what
// it changes: what commands play that are for one case.
CaseSpec singleCase(Scene& scene, const SceneOptions& options, AssetStore* assets = nullptr);

}  // namespace benchmarks::scene
