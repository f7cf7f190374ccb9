#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/change.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/sweep.h"
#include "engine/device.h"

// The cases of a run and their order.

namespace benchmarks::measure {
class HairCache;
}  // namespace benchmarks::measure

namespace benchmarks::run {

struct RunOptions {
    scene::SceneOptions scene;
    std::string filter;
    // Empty: results/local/<scene>.json, or <scene>.2of8.json for a shard.
    std::filesystem::path out;
    bool dry_run = false;  // only print what would run
    bool list = false;  // print the cases' names
    bool list_passes = false;  // print the passes of their frames
    std::optional<std::uint32_t> order_seed;  // absent: a random one
    bool resume = false;  // continue with the journal beside `out`
    std::string shard;  // "2/8": the second of eight parts; empty: all
    bool pictures = true;  // save a picture of each case beside the report
    bool shader_costs = true;  // in the report, where the driver tells them
    std::optional<std::uint64_t> max_memory;  // limit for a case, B; absent: the available memory
    std::string save_baseline;  // name; empty: none
    std::string baseline;  // name of a baseline to compare with; empty: none
    report::VerdictOptions verdict;
    std::optional<report::Trusted> fail_on;  // fail if a case is this or worse
    std::vector<std::string> command;  // for the report
};

struct PlannedCase {
    scene::CaseSpec spec;
    std::filesystem::path directory;  // file names in the settings are relative to this
    std::size_t index = 0;  // in the whole sweep, from 0
};

// The cases that a run will play: those of a scene, or of a suite's scenes one after another,
// without those that the command line excludes.
struct RunPlan {
    std::string name;  // of the scene or suite
    report::SceneRecord
        scene;  // a suite's document: {"suite": {<scene name>: <its document>, ...}}
    std::uint32_t seed = 1;
    std::size_t case_count = 0;  // before --filter and --shard
    std::string cases_hash;  // over all cases' documents; equal in journals and shards that belong
                             // together
    std::vector<PlannedCase> cases;  // in the sweep's order
    std::optional<std::uint64_t> max_memory;  // RunOptions::max_memory
};

// Reads and checks the scenes and their assets. Throws engine::Error for errors in them or in the
// options. `cases` may be empty if --filter matches none. Keeps meshes and grooms in `assets`,
// which may be null.
RunPlan planRun(
    const scene::SceneOptions& scene, const std::string& filter, const std::string& shard,
    scene::AssetStore* assets = nullptr);

// Returns all settings of a case, as a scene's document has them.
scene::Document documentOf(const scene::CaseSpec& spec);

// "2/8" -> {2, 8}. Throws engine::Error "--shard: ...".
report::Shard parseShard(const std::string& text);

// Returns 0 ... count - 1 in an order that depends on the seed alone, on every machine (Fisher and
// Yates 1938).
std::vector<std::size_t> shuffledOrder(std::size_t count, std::uint32_t seed);

// Prints the names and the number of the cases. Returns the exit status.
int printNames(const RunPlan& plan);

// Plays frames of each case and prints the passes of the last: the buffers and images that each
// reads and writes, and its barriers. Returns the exit status.
int printPasses(const RunPlan& plan, engine::DeviceOptions device, measure::HairCache& cache);

// Estimates the cost of a run within seconds.

// Amount of work in a frame of a case, from its settings alone.
struct FrameWork {
    double updates = 0.0;  // vertices of guides, in all substeps
    double segments = 0.0;  // drawn segments of strands
    double samples = 0.0;  // samples of the picture and the shadow maps
};
FrameWork frameWork(const hair::Settings& settings);

// Whether creating a case and drawing two frames takes about a second, on a device `speed` times as
// fast as a software device on two cores.
bool isSmall(const hair::Settings& settings, double speed);

// Reduces a case's settings until it is small on any device: fewer strands, guides, pixels and
// lights, no settling, coarse distance fields and shadows.
hair::Settings smaller(const hair::Settings& settings);

// Costs differ between kinds of cases: a trial of one kind tells nothing about another.
struct CaseKind {
    hair::Backend backend{};
    hair::ShadingModel shading{};
    hair::Solver solver{};

    auto operator<=>(const CaseKind&) const = default;
};
CaseKind kindOf(const hair::Settings& settings);

// Returns an upper bound of the ratio of frame times, `of` over `tried`, if times grow at most
// linearly with each part of the work: the sum of the parts then grows at most as much as the part
// that grows most.
double mostTimesLonger(const FrameWork& of, const FrameWork& tried);

// Prints an upper bound of the time of each case, from its creation to its last round, and the sum.
// Tries two frames of cases: first those with the most work of a sort, made smaller(), then one of
// each CaseKind, then the small cases unchanged until some seconds are over. Estimates the times of
// other cases from those of their kind by mostTimesLonger() and marks them as bounds. Memory is
// the device memory that a case held if it was tried unchanged, otherwise an upper bound
// (measure/memory_need.h). Cases that do not fit are not tried. Without a device, prints only the
// names and the reason. Returns the exit status.
int estimateRun(
    const RunPlan& plan, const engine::DeviceOptions& device, measure::HairCache& cache);

}  // namespace benchmarks::run
