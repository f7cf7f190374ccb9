#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/gate/blocks.h"
#include "benchmarks/groom/convert.h"
#include "benchmarks/groom/recording.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/scene/sweep.h"
#include "engine/device.h"
#include "hair/groom/mesh/mesh.h"

// The program's commands. Each prints its output, returns the exit status, and throws engine::Error
// for errors that the user has to fix.
namespace benchmarks::viewer {
struct ViewOptions;
}  // namespace benchmarks::viewer

namespace benchmarks::commands {

// Returns an error's message in at most 500 bytes, so that long text from a file cannot bury the
// rest of it.
std::string shortMessage(const std::exception& error);

int runScene(const run::RunOptions& options);

struct MergeOptions {
    std::vector<std::filesystem::path> reports;
    std::filesystem::path out;
    bool force = false;  // merge reports even if they do not belong together
};
int mergeReports(const MergeOptions& options);

struct ConvertReportOptions {
    std::filesystem::path report;
    std::string format;
    std::filesystem::path out;  // empty: stdout
};
int convertReport(const ConvertReportOptions& options);

int compareReports(const report::CompareOptions& options);

int gateBuilds(const gate::GateOptions& options);

struct ShadersOptions {
    scene::SceneOptions scene;
    std::string filter;
    std::filesystem::path out;  // empty: results/local/shaders-<scene>.json
    std::vector<std::string> command;
};
int compileShaders(const ShadersOptions& options);

struct AblateOptions {
    scene::SceneOptions scene;
    std::string filter;
    std::filesystem::path out;  // empty: results/local/ablation-<scene>.json
    std::uint32_t passes = 8;  // upward and downward passes over the ladder, each
    std::vector<std::string> command;
};
int ablateScene(const AblateOptions& options);

struct ReportPageOptions {
    std::vector<std::filesystem::path> reports;
    std::filesystem::path out;
};
int writeReportPage(const ReportPageOptions& options);

struct DoctorOptions {
    engine::DeviceOptions device;
    std::uint32_t pairs = 0;  // pairs of the A/A calibration; 0: none
    bool planted = false;  // also test for planted slowdowns
    std::filesystem::path out;  // findings as JSON; empty: none
    std::filesystem::path rules;  // report to check against rules instead; empty: none
    std::vector<std::filesystem::path> reports;  // reports to examine instead; empty: none
    std::vector<std::string> command;
};
int examineMachine(const DoctorOptions& options);

// The cases that a command plays if its file has a place for their names.
struct SweepOptions {
    scene::SceneOptions scene;
    std::string filter;
    std::string shard;  // "2/8": the second of eight parts; empty: all
    bool resume = false;  // play only the cases that an interrupted sweep left
    bool json = false;  // print what was written as JSON
};

struct RenderOptions {
    SweepOptions sweep;
    // .npy: an array of 8 bits, or with `linear` of floats; .exr: linear light; otherwise PNG
    std::filesystem::path out;
    bool linear = false;
    std::uint32_t frame = 0;
    std::string frames;  // "A:B" or "A:B:STEP", with `out` as a pattern; empty: only `frame`
};
int renderScene(const RenderOptions& options);

struct PhysicsOptions {
    std::vector<std::string> solvers;  // names or files; empty: all except none
    std::string check;  // regex of check names
    bool invariance = false;  // tables of invariance instead of the checks
    bool work_precision = false;  // errors and times instead of the checks
    bool papers = false;  // the published results instead of the checks
    std::filesystem::path out;  // empty: results/local/physics.json
    engine::DeviceOptions device;
    std::vector<std::string> command;  // for the report
};
int checkPhysics(const PhysicsOptions& options);

struct GroomInfoOptions {
    std::filesystem::path file;
    std::filesystem::path mesh;  // mesh that the hair grows on; empty: none
    std::optional<double> scale;  // metres per unit of the file
    std::uint32_t points_per_strand = 0;  // if the file does not state it
    bool strict = false;  // refuse strands that can't be used
    std::vector<std::int32_t> groups;  // that count; empty: all
    bool json = false;
};
int inspectGroom(const GroomInfoOptions& options);

struct GroomFormatsOptions {
    bool markdown = false;  // print the table of the documentation
};
int printGroomFormats(const GroomFormatsOptions& options);

// Returns the strands of these groups, or all if there are none. Throws engine::Error as
// keepGroups() does, with the file and --group.
hair::groom::StrandSet chosenGroups(
    hair::groom::StrandSet strands, const std::vector<std::int32_t>& groups,
    const std::filesystem::path& file);

// Reads a mesh, and prints the warnings about its file.
hair::groom::Mesh meshOf(const std::filesystem::path& file);

struct GroomSceneOptions {
    std::filesystem::path hair;
    std::filesystem::path head;  // mesh that the hair grows on; empty: none
    std::filesystem::path out;
    std::optional<double> scale;  // metres per unit of the hair file
    std::string up;  // upward axis of the hair file: "x", "y" or "z"; empty: guessed
    std::uint32_t points_per_strand = 0;  // if the file does not state it
    bool strict = false;  // refuse strands that can't be used
    std::vector<std::int32_t> groups;  // that are kept; empty: all
    std::filesystem::path sheet;  // PNG of four views; empty: none
    engine::DeviceOptions device;  // device for the sheet
    bool force = false;  // replace existing files
};
int makeGroomScene(const GroomSceneOptions& options);

struct GroomSheetOptions {
    std::filesystem::path folder;  // of files of hair, or an archive
    std::filesystem::path out;  // .png
    std::filesystem::path json;  // empty: none
    std::filesystem::path head;  // mesh that all of the hair grows on; empty: none
    std::optional<double> scale;  // metres per unit of the files
    std::string up;  // upward axis of the files: "x", "y" or "z"; empty: guessed
    std::uint32_t points_per_strand = 0;  // if the files do not state it
    bool strict = false;  // refuse files with strands that can't be used
    std::uint32_t most = 200;  // files that are read
    std::uint32_t size = 256;  // px of a picture
    std::uint32_t columns = 0;  // 0: about as many as rows
    engine::DeviceOptions device;
    bool force = false;  // replace existing files
};
int makeGroomSheet(const GroomSheetOptions& options);

int convertGroom(const groom::ConvertOptions& options);

// Edits of a file of hair; each command reads some of them.
struct EditGroomOptions {
    std::filesystem::path in;
    std::filesystem::path out;
    std::filesystem::path mesh;  // head, in metres; empty: none
    std::optional<double> scale;  // metres per unit of IN
    std::uint32_t points_per_strand = 0;  // of IN, if it does not state it
    // Lengths in mm.
    std::optional<double> shortest;
    std::optional<double> longest;
    std::optional<std::uint32_t> fewest_points;
    std::optional<std::uint32_t> most_points;
    std::vector<std::int32_t> groups;  // that are kept; empty: all
    std::optional<double> farthest_root;
    std::optional<double> deepest;
    double smooth_length = 0.0;
    std::optional<std::uint32_t> vertices;
    std::optional<double> spacing;
};
int filterGroom(const EditGroomOptions& options);
int reverseGroom(const EditGroomOptions& options);
int smoothGroom(const EditGroomOptions& options);
int resampleGroom(const EditGroomOptions& options);
int fixGroom(const EditGroomOptions& options);

struct TransformGroomOptions {
    std::filesystem::path in;
    std::filesystem::path out;
    std::uint32_t points_per_strand = 0;  // of IN, if it does not state it
    // Units are "m", "cm", "mm" or "inch" and axes "x", "y" or "z"; empty: as IN states, or no
    // change.
    std::string from_unit;
    std::string unit;
    std::string from_up;
    std::string up;
    std::string mirror;
    double scale = 1.0;  // factor of lengths
    std::vector<double> translation;  // none, or x, y, z in OUT's unit
};
int transformGroom(const TransformGroomOptions& options);

struct GroomGroupsOptions {
    std::filesystem::path in;
    std::filesystem::path out;  // empty: only list
    std::uint32_t points_per_strand = 0;  // of IN, if it does not state it
    std::vector<std::string> renumber;  // "OLD=NEW"
    bool json = false;
};
int groomGroups(const GroomGroupsOptions& options);

struct CompareGroomsOptions {
    std::filesystem::path first;  // the reference
    std::filesystem::path second;
    std::filesystem::path mesh;  // head; empty: none
    std::optional<double> first_scale;  // metres per unit of the file
    std::optional<double> second_scale;
    std::uint32_t first_points_per_strand = 0;  // if the file does not state it
    std::uint32_t second_points_per_strand = 0;
    std::vector<std::string> thresholds;  // "MM/DEGREES"; empty: the defaults
    double spacing = 2.0;  // mm
    double curvature_step = 5.0;  // mm
    std::uint32_t consistency_samples = 16;  // per strand; 0: all
    std::uint32_t threads = 0;  // 0: one per processor of the machine
    bool undirected = false;  // do not distinguish root and tip
    bool json = false;
    std::filesystem::path out;  // JSON; empty: none
};
int compareGrooms(const CompareGroomsOptions& options);

struct SimulateOptions {
    SweepOptions sweep;
    groom::RecordingOptions recording;  // without a file if only `probes` is written
    std::filesystem::path probes;  // table of /run/probes; may be empty
};
int simulateScene(const SimulateOptions& options);

struct ExportOptions {
    scene::SceneOptions scene;
    std::filesystem::path mitsuba;  // folder
    std::uint32_t frame = 0;
};
int exportScene(const ExportOptions& options);

struct ReferenceOptions {
    scene::SceneOptions scene;
    std::filesystem::path out;
    std::uint32_t samples = 64;  // per pixel
    std::uint32_t frame = 0;
};
int renderReference(const ReferenceOptions& options);

struct DiffOptions {
    std::filesystem::path reference;
    std::filesystem::path picture;
    std::filesystem::path out;  // FLIP's error map; empty: none
    bool json = false;
};
int diffPictures(const DiffOptions& options);

struct ShimmerOptions {
    scene::SceneOptions scene;
    std::string filter;  // of the cases' names; empty: all
    double turn = 12.0;  // degrees about /camera/target
    std::uint32_t steps = 24;  // from one view to the next
    std::uint32_t frame = 0;
    bool json = false;
};
int measureShimmer(const ShimmerOptions& options);

struct LodOptions {
    scene::SceneOptions scene;
    std::filesystem::path out;  // empty: results/local/lod.json
    double from = 0.5;  // m, distance from /camera/target
    double to = 20.0;
    std::uint32_t steps = 40;
    bool clusters = false;  // also compare levels by cluster
    bool reference = false;  // also compare levels with the path-traced level 0
    std::uint32_t samples = 64;  // per pixel of the reference
    std::uint32_t frame = 0;
    std::vector<std::string> command;  // for the report
};
int walkLod(const LodOptions& options);

int viewScene(const viewer::ViewOptions& options);

struct ValidateOptions {
    std::vector<std::filesystem::path> scenes;
    scene::Outside outside = scene::Outside::refused;
    bool start = false;  // also inspect each scene's hair on the device
    bool strict = false;  // with `start`: refuse files with strands that can't be used
    engine::DeviceOptions device;  // device for `start`
};
int validateScenes(const ValidateOptions& options);
struct SchemaOptions {
    std::filesystem::path examples;  // folder of example scenes, for a page of Markdown; empty:
                                     // print the JSON Schema
};
int printSchema(const SchemaOptions& options);
int printDevices();

struct ScenesOptions {
    bool names = false;  // print only names
};
int printScenes(const ScenesOptions& options);

struct NewOptions {
    std::filesystem::path folder;
    std::string from = "thesis";  // a shipped scene
};
// Makes a folder with a scene based on a shipped one, the schema and a README. Throws engine::Error
// "<path>: <reason>" if something is there, or if there is no such scene.
int makeScene(const NewOptions& options);

struct CompletionOptions {
    std::string shell;
};
int printCompletion(const CompletionOptions& options);

struct ManualOptions {
    std::vector<std::string> words;  // of the command, without the program's name
    std::filesystem::path out;  // folder for its page and those of its subcommands; empty: stdout
};
int printManual(const ManualOptions& options);

}  // namespace benchmarks::commands
