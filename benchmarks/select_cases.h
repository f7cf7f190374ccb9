#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/scene.h"
#include "benchmarks/sweep.h"
#include "engine/device.h"

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

}  // namespace benchmarks
