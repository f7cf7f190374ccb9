#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/commands.h"
#include "benchmarks/report.h"
#include "benchmarks/sweep.h"

namespace benchmarks {

struct PlannedCase {
    CaseSpec spec;
    std::filesystem::path directory;  // what file names in the settings are relative to
    std::size_t index = 0;            // in the whole sweep, from 0
};

// What a run is to do: the cases of a scene, or of a suite's scenes one after another, that the
// command line left.
struct RunPlan {
    std::string name;   // of the scene or suite
    SceneRecord scene;  // a suite's document: {"suite": {<scene name>: <its document>, ...}}
    std::uint32_t seed = 1;
    std::size_t case_count = 0;      // before --filter and --shard
    std::string cases_hash;  // of all cases' documents: what journals and shards must share
    std::vector<PlannedCase> cases;  // in the sweep's order
};

// Reads scenes and checks them and their assets. Throws engine::Error for what is wrong with them
// or with the options; `cases` may be empty where --filter leaves none.
RunPlan planRun(const SceneOptions& scene, const std::string& filter, const std::string& shard);

// "2/8" -> {2, 8}. Throws engine::Error "--shard: ...".
Shard parseShard(const std::string& text);

// 0 ... count - 1 in an order that the seed decides alone (Fisher and Yates 1938; the order is the
// same on every machine).
std::vector<std::size_t> shuffledOrder(std::size_t count, std::uint32_t seed);

}  // namespace benchmarks
