#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/scene/axis.h"
#include "benchmarks/scene/json.h"
#include "benchmarks/scene/reach.h"
#include "hair/settings.h"

// Scene files.
namespace benchmarks::scene {

// Applies a scene's document to its base's, as JSON merge patch (RFC 7386): objects are merged,
// null removes, anything else replaces. Stricter in one thing: a null for a member that neither
// `target` nor `known` (every member there can be) has is an engine::Error "<JSON pointer>:
// <reason>", because a misspelt removal would silently remove nothing.
void mergePatch(Json& target, const Json& patch, const Json& known);

// Of a screenshot, which has its picture beside the scene.
inline constexpr std::size_t kLargestSceneFile = std::size_t{256} << 20;

// A scene file of at most 16 MiB, checked: hair::Settings members plus
//   "$schema"  a string for editors, ignored
//   "base"     another scene file, relative to this one; this document is applied to it as a JSON
//              merge patch (RFC 7386), so null takes a member of the base away; at most 16
//              follow one another
//   "sweep"    JSON pointer -> array of values, and the members in axis.h; one case for each
//              combination, in the written order
// A screenshot of the viewer is one too: a PNG with the text of a scene file in it.
struct Scene {
    std::filesystem::path path;  // as given
    std::filesystem::path directory;  // what file names in the scene are relative to
    Reach reach;  // where files may lie that it names
    std::string name;  // file name without its extension
    Document document;  // what is written, bases merged, without the three members above
    Document resolved;  // every field, absent ones with their defaults
    hair::Settings settings;  // of `resolved`: no axis applied
    std::vector<Axis> axes;
    std::vector<Exclusion> exclusions;  // of what the axes make: without axes they mean nothing
};

// Reads and checks everything but the rules between fields, which hold for cases: expand() checks
// those. Throws engine::Error, one line: "<file>: <JSON pointer>: <reason>"; what is wrong in a
// base is reported as "<file>: /base: <base file>: ...". A file out of reach is an error before it
// is opened; the second is of a member of a suite, with the suite's reach.
Scene loadScene(const std::filesystem::path& path, Outside outside = Outside::refused);
Scene loadScene(const std::filesystem::path& path, const Reach& reach);

// Sets one field of every case, as if the file had it. Throws engine::Error "<JSON pointer>:
// <reason>".
void setField(Scene& scene, const std::string& pointer, const Json& value);

// The keyword of the scene in the texts of a screenshot's PNG.
inline constexpr std::string_view kSceneKeyword = "hairbench-scene";

// The scene, JSON text, in a PNG; none where there is none. Throws engine::Error for what is no
// whole PNG.
std::optional<std::string> sceneOfScreenshot(const std::filesystem::path& path);

}  // namespace benchmarks::scene
