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
    engine::DeviceOptions device;
};

// The scene's cases with what the command line changes. Every asset that they name is read once.
std::vector<CaseSpec> selectCases(Scene& scene, const SceneOptions& options);

struct RunOptions {
    SceneOptions scene;
    std::string filter;
    std::filesystem::path out;  // empty: results/local/<scene>.json
    bool dry_run = false;
    std::vector<std::string> command;  // as the report quotes it
};
int runScene(const RunOptions& options);

struct RenderOptions {
    SceneOptions scene;
    std::filesystem::path out;  // .exr: linear light; others: PNG
    std::uint32_t frame = 0;
    std::string frames;  // "A:B" or "A:B:STEP", and `out` is a pattern; empty: `frame`
};
int renderScene(const RenderOptions& options);

struct PhysicsOptions {
    std::vector<std::string> solvers;  // empty: all but none
    std::string check;                 // regex of check names
    std::filesystem::path out;         // empty: results/local/physics.json
    engine::DeviceOptions device;
    std::vector<std::string> command;  // as the report quotes it
};
int checkPhysics(const PhysicsOptions& options);

struct GroomInfoOptions {
    std::filesystem::path file;
    std::filesystem::path mesh;   // that the hair grows on; empty: none
    std::optional<double> scale;  // metres in the file's unit
    bool json = false;
};
int inspectGroom(const GroomInfoOptions& options);

struct GroomConvertOptions {
    std::filesystem::path in;
    std::filesystem::path out;
    std::filesystem::path mesh;             // for root triangles; empty: from the roots alone
    std::optional<double> scale;            // metres in IN's unit; OUT is then in metres
    std::uint32_t followers = 0;            // for each strand
    double follower_radius = 0.0;           // of the disc that they are in, in IN's unit
    double tip_separation = 1.0;            // factor of their displacement at the tip
    std::optional<std::uint32_t> vertices;  // of a strand
    std::optional<std::uint32_t> guides;    // to keep; all strands
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
    double from = 0.5;          // m, distance from /camera/target
    double to = 20.0;
    std::uint32_t steps = 40;
    std::uint32_t frame = 0;
    std::vector<std::string> command;  // as the report quotes it
};
int walkLod(const LodOptions& options);

int validateScenes(const std::vector<std::filesystem::path>& scenes);
int printSchema();
int printDevices();

}  // namespace benchmarks
