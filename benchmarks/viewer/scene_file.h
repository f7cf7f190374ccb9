#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"
#include "hair/settings.h"

// Files of the viewer: opens and saves scenes, quotes them as command-line arguments, and handles
// files that are dropped on the window.
namespace benchmarks::viewer {

// Returns the arguments after `hairbench run SCENE` that play exactly these settings: "-a
// /strands/density=16 …", quoted for a POSIX shell; empty if there is nothing to change. Axes of
// the scene's sweep get their single value in the settings. Lists and the description become a
// --set, because they would make a case's name long, and so does a list in which the sweep varies
// something. `scene` is the scene on disk. Throws engine::Error "<file>: <reason>" if arguments
// cannot express the settings: with tied axes, a combination that the sweep excludes, or settings
// that break a rule.
std::string caseArguments(const scene::Scene& scene, const hair::Settings& settings);

// Returns JSON text in the style of the files in scenes/, with a newline at the end. Members of the
// document are on separate lines, indented by two spaces. The contents of a member are on one line
// if that fits 100 columns.
std::string readableJson(const scene::Json& document);

// Changes relative file names in the settings from the folder `from` to the folder `to`. Empty and
// absolute names stay unchanged.
hair::Settings movedFiles(
    hair::Settings settings, const std::filesystem::path& from, const std::filesystem::path& to);

// Returns a scene with these settings and no sweep, as JSON text for a file in the folder `to`. It
// contains only differences from the defaults and reads back bit-equal.
std::string sceneText(
    const hair::Settings& settings, const std::filesystem::path& from,
    const std::filesystem::path& to);

// Writes sceneText() atomically. Throws engine::Error "<path>: <reason>".
void saveScene(
    const hair::Settings& settings, const std::filesystem::path& from,
    const std::filesystem::path& file);

// A scene that is open in the viewer.
struct SceneFile {
    std::filesystem::path path;
    std::filesystem::path directory;  // file names in it are relative to this
    std::string name;
    hair::Settings settings;
};

// Opens a scene file, or a screenshot that contains one. Applies no axis of its sweep. Throws
// engine::Error in one line, also for a suite.
SceneFile
openScene(const std::filesystem::path& path, scene::Outside outside = scene::Outside::refused);

// The use of a file that was dropped on the window. .json files and PNGs with a scene, even a
// damaged one, are scenes; .exr and .hdr files are environments. Strands and meshes are recognised
// by their first bytes or their extension. A file in a format for both (OBJ, PLY, glTF, USD) is a
// mesh if it has triangles.
enum class Dropped { scene, groom, mesh, environment, unknown };
Dropped whatIs(const std::filesystem::path& file);

// Returns settings with the groom or environment of a file in place of the previous one, or with
// one more mesh beside the head. The file's name is relative to `directory` if it lies below that,
// otherwise absolute. A groom removes the style, placement and pulls of the previous hair; it also
// removes the mesh if its roots are not on that. Throws engine::Error with the file's name if it
// cannot be used.
hair::Settings withDropped(
    hair::Settings settings, const std::filesystem::path& directory,
    const std::filesystem::path& file);

}  // namespace benchmarks::viewer
