#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/axis.h"
#include "benchmarks/scene.h"
#include "benchmarks/sweep.h"
#include "engine/device.h"

// The program's commands. Each prints what it has to say, returns the exit status, and throws
// engine::Error for what the user has to mend.
namespace benchmarks {

// Which cases of a scene, and on what.
struct SceneOptions {
    std::filesystem::path scene;
    std::vector<std::string> axes;  // "POINTER=V1,V2"
    std::optional<std::uint32_t> frames;
    std::optional<std::uint32_t> warmup;
    std::optional<double> precision;  // a share
    std::optional<double> max_time;   // s
    std::vector<std::string> sets;    // "POINTER=VALUE": fields of every case
    engine::DeviceOptions device;
};

// The scene's cases with what the command line changes. Every asset that they name is read once.
std::vector<CaseSpec> selectCases(Scene& scene, const SceneOptions& options);

// The scene's own settings, no axis applied but those of the command line with one value, with what
// it changes: what commands play that are for one case.
CaseSpec singleCase(Scene& scene, const SceneOptions& options);

// When a comparison fails.
struct VerdictOptions {
    double threshold = 0.02;  // a change of this share matters to nobody
    bool fail_on_inconclusive = false;
    std::string metrics;  // regex of the metrics that count; empty: all times
};

struct RunOptions {
    SceneOptions scene;
    std::string filter;
    // Empty: results/local/<scene>.json, of a shard <scene>.2of8.json.
    std::filesystem::path out;
    bool dry_run = false;  // say what would run
    bool list = false;  // print the cases' names
    std::optional<std::uint32_t> order_seed;  // absent: one that differs every time
    bool resume = false;  // go on with the journal beside `out`
    std::string shard;  // "2/8": the second of eight parts; empty: all
    bool pictures = true;  // a picture of each case beside the report
    std::string save_baseline;  // name; empty: none
    std::string baseline;  // name of what to compare with; empty: nothing
    VerdictOptions verdict;
    std::vector<std::string> command;  // as the report quotes it
};
int runScene(const RunOptions& options);

struct MergeOptions {
    std::vector<std::filesystem::path> reports;
    std::filesystem::path out;
    bool force = false;  // join what does not belong together
};
int mergeReports(const MergeOptions& options);

struct ConvertReportOptions {
    std::filesystem::path report;
    std::string format;
    std::filesystem::path out;  // empty: stdout
};
int convertReport(const ConvertReportOptions& options);

struct CompareOptions {
    std::filesystem::path a;  // empty where `baseline` is given
    std::filesystem::path b;
    std::string baseline;
    VerdictOptions verdict;
    bool all = false;  // rows of what stayed the same too
    bool json = false;
};
int compareReports(const CompareOptions& options);

struct GateOptions {
    std::string a;  // build folder, program, or command line
    std::string b;
    SceneOptions scene;
    std::string filter;
    std::vector<std::string> a_sets;  // "POINTER=VALUE" for A's or B's runs alone
    std::vector<std::string> b_sets;
    std::uint32_t pairs = 12;
    std::uint32_t calibration = 0;  // A/A pairs before the gate; 0: none
    VerdictOptions verdict;
    std::filesystem::path out;  // report of the gate; empty: results/local/gate-<scene>.json
    std::vector<std::string> command;
};
int gateBuilds(const GateOptions& options);

struct AblateOptions {
    SceneOptions scene;
    std::string filter;
    std::filesystem::path out;  // empty: results/local/ablation-<scene>.json
    std::uint32_t passes = 8;  // up and down the ladder, each
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
    std::uint32_t pairs = 0;  // of the A/A calibration; 0: none
    bool planted = false;  // and whether a planted slowdown is found
    std::filesystem::path out;  // findings as JSON; empty: none
    std::vector<std::string> command;
};
int examineMachine(const DoctorOptions& options);

struct RenderOptions {
    SceneOptions scene;
    std::filesystem::path out;  // .exr: linear light; others: PNG
    std::uint32_t frame = 0;
    std::string frames;  // "A:B" or "A:B:STEP", and `out` is a pattern; empty: `frame`
};
int renderScene(const RenderOptions& options);

struct PhysicsOptions {
    std::vector<std::string> solvers;  // empty: all but none
    std::string check;  // regex of check names
    std::filesystem::path out;  // empty: results/local/physics.json
    engine::DeviceOptions device;
    std::vector<std::string> command;  // as the report quotes it
};
int checkPhysics(const PhysicsOptions& options);

struct GroomInfoOptions {
    std::filesystem::path file;
    std::filesystem::path mesh;  // that the hair grows on; empty: none
    std::optional<double> scale;  // metres in the file's unit
    bool json = false;
};
int inspectGroom(const GroomInfoOptions& options);

struct GroomConvertOptions {
    std::filesystem::path in;
    std::filesystem::path out;
    std::filesystem::path mesh;  // for root triangles; empty: from the roots alone
    std::optional<double> scale;  // metres in IN's unit; OUT is then in metres
    std::uint32_t followers = 0;  // for each strand
    double follower_radius = 0.0;  // of the disc that they are in, in IN's unit
    double tip_separation = 1.0;  // factor of their displacement at the tip
    std::optional<std::uint32_t> vertices;  // of a strand
    std::optional<std::uint32_t> guides;  // to keep; all strands
    std::uint32_t seed = 1;
};
int convertGroom(const GroomConvertOptions& options);

struct SimulateOptions {
    SceneOptions scene;
    std::filesystem::path out;
    std::uint32_t frames = 60;
    bool guides = false;  // the simulated guides instead of the strands that are drawn
};
int simulateScene(const SimulateOptions& options);

struct ExportOptions {
    SceneOptions scene;
    std::filesystem::path mitsuba;  // folder
    std::uint32_t frame = 0;
};
int exportScene(const ExportOptions& options);

struct ReferenceOptions {
    SceneOptions scene;
    std::filesystem::path out;
    std::uint32_t samples = 64;  // of a pixel
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

struct LodOptions {
    SceneOptions scene;
    std::filesystem::path out;  // empty: results/local/lod.json
    double from = 0.5;  // m, distance from /camera/target
    double to = 20.0;
    std::uint32_t steps = 40;
    std::uint32_t frame = 0;
    std::vector<std::string> command;  // as the report quotes it
};
int walkLod(const LodOptions& options);

struct ViewOptions {
    SceneOptions scene;
    std::uint32_t width = 1600;  // of the window, screen coordinates
    std::uint32_t height = 900;
    double scale = 0.0;  // of widgets; 0: the screen's
    std::uint32_t frames = 0;  // of the window, after which it closes; 0: never
    std::filesystem::path screenshot;  // of the last one; empty: none
    std::filesystem::path script;  // steps that drive it; empty: none
    std::filesystem::path shaders;  // watched for changes; empty: those it was built from
    // What it remembers, a file; empty: the user's own, or nothing where a script drives it.
    std::filesystem::path preferences;
    std::vector<std::string> command;  // as reports quote it
};
int viewScene(const ViewOptions& options);

int validateScenes(const std::vector<std::filesystem::path>& scenes);
int printSchema();
int printDevices();

}  // namespace benchmarks
