#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"
#include "hair/extension.h"
#include "hair/settings.h"

// Finds scenes and limits the files that they may name, so that a scene from a stranger can only
// open its own files.

namespace benchmarks::scene {

// Returns the file for a scene's name: the file of that name in `folder` (empty: the current one)
// if it exists, otherwise the scene of that name that comes with the program: "thesis",
// "scenes/thesis.json", "portraits/braid". Returns the name in the folder if neither exists.
std::filesystem::path
sceneNamed(const std::filesystem::path& name, const std::filesystem::path& folder = {});

// Returns the names of the scenes that come with the program, as sceneNamed() takes them, in
// alphabetical order: "thesis", "portraits/braid".
std::vector<std::string> shippedScenes();

// The user's choice about files outside: --allow-outside.
enum class Outside { refused, allowed };

// The folders in which files named by a scene may lie, after links are followed:
//   - the nearest folder with scene.schema.json, from the scene's own folder upwards, so that
//     scenes in subfolders can share assets; without one, the scene's own folder
//   - the program's own scenes, which can be bases of others
class Reach {
public:
    // Allows every file.
    Reach() = default;
    // Reach of the file that the user opens. Its bases and the members of a suite have the same
    // reach.
    Reach(const std::filesystem::path& opened, Outside outside);

    // Throws engine::Error "<file>: <reason>" for a file elsewhere.
    void check(const std::filesystem::path& file) const;

    // Reach of a file that `owner` names. Files in the owner's folder and below always belong to
    // it.
    void check(const std::filesystem::path& file, const std::filesystem::path& owner) const;

    // Returns the canonical folders in which the files that `owner` names may be; empty:
    // everywhere.
    std::vector<std::filesystem::path> folders(const std::filesystem::path& owner) const;

private:
    std::vector<std::filesystem::path> folders_;  // canonical; empty: every file is allowed
};

// Calls `visit` with the JSON pointer of each field that names a file, and the name.
using FileNameVisitor = std::function<void(const std::string& pointer, std::string& name)>;
void forEachFileName(hair::Settings& settings, const FileNameVisitor& visit);

// Checks every file that the settings of a scene in `directory` name at `pointer` or below it;
// empty: anywhere. Throws engine::Error "<JSON pointer>: <file>: <reason>" for a file out of reach.
void checkNamedFiles(
    hair::Settings settings, const std::string& pointer, const std::filesystem::path& directory,
    const Reach& reach);

// GLSL files that scenes name: docs/extending.md.

// A field that may name a GLSL file, and the field of its parameters.
struct ExtensionField {
    hair::ExtensionKind kind;
    const char* pointer;
    const char* parameters;
};

inline constexpr ExtensionField kExtensionFields[]{
    {hair::ExtensionKind::shading, "/shading/model", "/shading/model_parameters"},
    {hair::ExtensionKind::offset, "/strands/offset_function", "/strands/offset_parameters"},
    {hair::ExtensionKind::force, "/simulation/force", "/simulation/force_parameters"},
    {hair::ExtensionKind::solver, "/simulation/solver", "/simulation/solver_parameters"},
    {hair::ExtensionKind::curve, "/strands/curve", "/strands/curve_parameters"}};

// Returns the parameters of such a field.
hair::ExtensionParameters& parametersOf(hair::Settings& settings, hair::ExtensionKind kind);
const hair::ExtensionParameters&
parametersOf(const hair::Settings& settings, hair::ExtensionKind kind);

// Treatment of parameters that the file does not declare.
enum class UnknownParameters { refused, dropped };

// Reads the files that the settings name, and completes and checks their parameters. Names are
// relative to `directory`. Throws engine::Error "<JSON pointer>: <reason>" for a file that cannot
// be read or is out of reach, and for parameters that it does not declare.
void loadExtensions(
    hair::Settings& settings, const std::filesystem::path& directory, const Reach& reach = {},
    UnknownParameters unknown = UnknownParameters::refused);

// Returns the settings with their files read.
hair::Settings
withExtensions(const hair::Settings& settings, const std::filesystem::path& directory);

// Reads the files again and drops parameters that they no longer have. If that fails, leaves the
// settings unchanged; playing them then reports the error.
void rereadExtensions(hair::Settings& settings, const std::filesystem::path& directory);

// Compiles the files for every stage that calls them, to find errors. Throws engine::Error "<JSON
// pointer>: <file>:<line>: <reason>".
void checkExtensions(const hair::Settings& settings);

// A GLSL file that was read.
struct NamedExtension {
    std::string pointer;  // of the field that names it
    std::string file;  // as the field names it
    std::string text;
};
std::vector<NamedExtension> namedExtensions(const hair::Settings& settings);

}  // namespace benchmarks::scene
