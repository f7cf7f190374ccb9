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

// The cases of a run and their order.
namespace benchmarks::run {

struct RunOptions {
    scene::SceneOptions scene;
    std::string filter;
    // Empty: results/local/<scene>.json, or <scene>.2of8.json for a shard.
    std::filesystem::path out;
    bool dry_run = false;  // only print what would run
    bool list = false;  // print the cases' names
    std::optional<std::uint32_t> order_seed;  // absent: a random one
    bool resume = false;  // continue with the journal beside `out`
    std::string shard;  // "2/8": the second of eight parts; empty: all
    bool pictures = true;  // save a picture of each case beside the report
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

// "2/8" -> {2, 8}. Throws engine::Error "--shard: ...".
report::Shard parseShard(const std::string& text);

// Returns 0 ... count - 1 in an order that depends on the seed alone, on every machine (Fisher and
// Yates 1938).
std::vector<std::size_t> shuffledOrder(std::size_t count, std::uint32_t seed);

// Prints the names and the number of the cases. Returns the exit status.
int printNames(const RunPlan& plan);

}  // namespace benchmarks::run
