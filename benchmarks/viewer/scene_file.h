#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "benchmarks/scene/json.h"
#include "benchmarks/scene/scene.h"
#include "benchmarks/viewer/player.h"
#include "engine/pictures.h"
#include "hair/settings.h"

// Files of the viewer: opens and saves scenes, quotes them as command-line arguments, handles files
// that are dropped on the window, and writes recordings and screenshots.
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

// ---- Recordings and screenshots -----------------------------------------------------------------

// Writes every shown frame to an animated PNG, which browsers play at the scene's own speed.
class Recorder {
public:
    bool records() const { return !path_.empty(); }
    // Starts a recording. Throws engine::Error if the file can't be written.
    void start(const std::filesystem::path& path);
    void stop();
    // Adds the shown frame, once even if called repeatedly. The first one brings its scene, as a
    // screenshot does. Does nothing without a recording. Stops the recording if it throws
    // engine::Error, also for a frame of another size.
    void frame(const Shown& shown);

    // "recording 12 frames to <path>, 3.1 MB"; empty without a recording.
    std::string message() const;
    // The same with "recorded".
    std::string summary() const;

private:
    std::string figures() const;

    std::filesystem::path path_;  // empty: no recording
    std::optional<engine::AnimatedPng> film_;  // from the first frame on
    std::uint32_t width_ = 0;
    std::uint32_t height_ = 0;
    std::optional<std::uint32_t> last_;  // number of the last written frame
};

// Writes a PNG of RGBA pixels, [row][column], top row first, with a scene in its metadata: an iTXt
// chunk "hairbench-scene" for sceneOfScreenshot() and loadScene(). `scene` is from sceneText() for
// the picture's folder. Replaces the file atomically. Throws engine::Error.
void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene);

// Returns the first free name in the folder: "hairbench-rest-0001.png" for the stem
// "hairbench-rest".
std::filesystem::path freeName(
    const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

}  // namespace benchmarks::viewer
