#pragma once

#include <filesystem>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"
#include "hair/settings.h"

// The files of the viewer: scenes that are opened, saved and quoted as arguments of the command
// line, and what becomes of a file that is dropped on the window.
namespace benchmarks::viewer {

// What follows `hairbench run SCENE` on a command line to play these settings and nothing else:
// "-a /strands/density=16 …", quoted for a POSIX shell. Axes of the scene's sweep get the one value
// that the settings have. What would make a case's name long, lists and the description, is a
// --set, and so is a list in which the sweep varies something. Empty where there is nothing to say.
// `scene` is as it is on disk. Throws engine::Error "<file>: <reason>" where a command line can't
// say it: axes that are tied to each other, a combination that the sweep excludes, settings that
// break a rule.
std::string caseArguments(const scene::Scene& scene, const hair::Settings& settings);

// JSON text as the files of scenes/ have it, with a newline at the end: members of the document on
// lines of their own, indented by two spaces; whatever is inside a member on one line where that
// has at most 100 columns.
std::string readableJson(const scene::Json& document);

// The settings with file names that were relative to `from` and are now to `to`. Empty and absolute
// names stay as they are.
hair::Settings movedFiles(
    hair::Settings settings, const std::filesystem::path& from, const std::filesystem::path& to);

// The scene that has these settings and no sweep: JSON text, for a file in the folder `to`, of what
// differs from the defaults. It reads back bit-equal.
std::string sceneText(
    const hair::Settings& settings, const std::filesystem::path& from,
    const std::filesystem::path& to);

// Writes sceneText() in one step. Throws engine::Error "<path>: <reason>".
void saveScene(
    const hair::Settings& settings, const std::filesystem::path& from,
    const std::filesystem::path& file);

// A scene that is open in the viewer.
struct SceneFile {
    std::filesystem::path path;
    std::filesystem::path directory;  // what file names in it are relative to
    std::string name;
    hair::Settings settings;
};

// A scene file, or a screenshot that has one in it. No axis of its sweep is applied. Throws
// engine::Error, one line, also for a suite.
SceneFile
openScene(const std::filesystem::path& path, scene::Outside outside = scene::Outside::refused);

// What is to be done with a file that was dropped on the window: .json and PNGs with a scene in
// them, or damaged, are scenes, .exr and .hdr environments, and what strands and meshes are read
// from goes by its first bytes or its extension. A file of a format of both (OBJ, PLY, glTF) is a
// mesh where it has triangles.
enum class Dropped { scene, groom, mesh, environment, unknown };
Dropped whatIs(const std::filesystem::path& file);

// Settings with the groom or environment of a file in place of what was there, or with one more
// mesh beside the head. The file's name is relative to `directory` where it is below it, otherwise
// absolute. A groom takes the style, the placement and the pulls of the hair before with it; where
// its roots are not on the mesh, the mesh goes too. Throws engine::Error that names the file for
// what can't be used.
hair::Settings withDropped(
    hair::Settings settings, const std::filesystem::path& directory,
    const std::filesystem::path& file);

}  // namespace benchmarks::viewer
