#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/report/change.h"
#include "benchmarks/report/report.h"
#include "benchmarks/scene/sweep.h"

// Which cases a run plays, and in which order.
namespace benchmarks::run {

struct RunOptions {
    scene::SceneOptions scene;
    std::string filter;
    // Empty: results/local/<scene>.json, of a shard <scene>.2of8.json.
    std::filesystem::path out;
    bool dry_run = false;  // say what would run
    bool list = false;  // print the cases' names
    std::optional<std::uint32_t> order_seed;  // absent: one that differs every time
    bool resume = false;  // go on with the journal beside `out`
    std::string shard;  // "2/8": the second of eight parts; empty: all
    bool pictures = true;  // a picture of each case beside the report
    std::optional<std::uint64_t> max_memory;  // B, that a case may need; absent: what there is
    std::string save_baseline;  // name; empty: none
    std::string baseline;  // name of what to compare with; empty: nothing
    report::VerdictOptions verdict;
    std::vector<std::string> command;  // as the report quotes it
};

struct PlannedCase {
    scene::CaseSpec spec;
    std::filesystem::path directory;  // what file names in the settings are relative to
    std::size_t index = 0;            // in the whole sweep, from 0
};

// What a run is to do: the cases of a scene, or of a suite's scenes one after another, that the
// command line left.
struct RunPlan {
    std::string name;   // of the scene or suite
    report::SceneRecord
        scene;  // a suite's document: {"suite": {<scene name>: <its document>, ...}}
    std::uint32_t seed = 1;
    std::size_t case_count = 0;      // before --filter and --shard
    std::string cases_hash;  // of all cases' documents: what journals and shards must share
    std::vector<PlannedCase> cases;  // in the sweep's order
    std::optional<std::uint64_t> max_memory;  // RunOptions::max_memory
};

// Reads scenes and checks them and their assets. Throws engine::Error for what is wrong with them
// or with the options; `cases` may be empty where --filter leaves none. Meshes and grooms are left
// in `assets`, which may be null.
RunPlan planRun(
    const scene::SceneOptions& scene, const std::string& filter, const std::string& shard,
    scene::AssetStore* assets = nullptr);

// "2/8" -> {2, 8}. Throws engine::Error "--shard: ...".
report::Shard parseShard(const std::string& text);

// 0 ... count - 1 in an order that the seed decides alone (Fisher and Yates 1938; the order is the
// same on every machine).
std::vector<std::size_t> shuffledOrder(std::size_t count, std::uint32_t seed);

// Prints the names of the cases and how many there are. Returns the exit status.
int printNames(const RunPlan& plan);

}  // namespace benchmarks::run
