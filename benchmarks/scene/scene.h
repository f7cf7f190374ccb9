#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/scene/axis.h"
#include "benchmarks/scene/extensions.h"
#include "benchmarks/scene/json.h"
#include "hair/settings.h"

// Scene files.
namespace benchmarks::scene {

// Applies a scene's document to its base's as a JSON merge patch (RFC 7386): objects are merged,
// null removes, anything else replaces. It is stricter in one respect: throws engine::Error "<JSON
// pointer>: <reason>" for a null member that neither `target` nor `known` (every possible member)
// has, because a misspelt removal would silently remove nothing.
void mergePatch(Json& target, const Json& patch, const Json& known);

// Limit for screenshots, which contain a picture as well as the scene, B.
inline constexpr std::size_t kLargestSceneFile = std::size_t{256} << 20;

// A scene file of at most 16 MiB, checked: hair::Settings members and
//   "$schema"  a string for editors, ignored
//   "base"     another scene file, relative to this one, or the name of a shipped scene; this
//              document is applied to it as a JSON merge patch (RFC 7386), so null removes a member
//              of the base; at most 16 in a chain
//   "sweep"    JSON pointer -> array of values, and the members in axis.h; one case for each
//              combination, in the written order
// A screenshot of the viewer also works: a PNG that contains the text of a scene file.
struct Scene {
    std::filesystem::path path;  // as given
    std::filesystem::path directory;  // file names in the scene are relative to this
    Reach reach;  // folders that the files it names may lie in
    std::string name;  // file name without its extension
    hair::Settings written;  // parameters of GLSL files only as far as the scene sets them
    hair::Settings settings;  // with the files' parameters, without any axis applied
    Document resolved;  // `settings` as reports have them
    std::vector<Axis> axes;
    std::vector<Exclusion> exclusions;  // from combinations of the axes; ignored without axes
};

// Loads a scene and checks everything except the rules between fields, which hold for cases:
// expand() checks those. Throws engine::Error in one line: "<file>: <JSON pointer>: <reason>";
// errors in a base read "<file>: /base: <base file>: ...". Files are checked against the reach
// before they are opened. The second overload loads a member of a suite with the suite's reach.
Scene loadScene(const std::filesystem::path& path, Outside outside = Outside::refused);
Scene loadScene(const std::filesystem::path& path, const Reach& reach);

// Sets one field of every case, as if the file contained it. Throws engine::Error "<JSON pointer>:
// <reason>".
void setField(Scene& scene, const std::string& pointer, const Json& value);

// The keyword of the scene among the texts of a screenshot's PNG.
inline constexpr std::string_view kSceneKeyword = "hairbench-scene";

// Returns the JSON text of the scene in a PNG; nothing if it contains none. Throws engine::Error
// for a damaged PNG or another kind of file.
std::optional<std::string> sceneOfScreenshot(const std::filesystem::path& path);

}  // namespace benchmarks::scene
