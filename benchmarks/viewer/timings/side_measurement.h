#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/measure.h"
#include "benchmarks/report.h"
#include "engine/device.h"
#include "hair/settings.h"

namespace benchmarks {

// What the runner found out of settings.
struct SideMeasurement {
    hair::Settings settings;
    CaseResult result;
    std::vector<std::uint8_t> picture;  // [row][column] RGBA, top row first: that which is hashed
};

// Measures settings as `hairbench run` does, with a case of its own, so that what is shown stays as
// it is. The memory in the result is that case's. What `hooks.progress` does to the device, such as
// a picture of the window, is done before the next round begins. Throws as Case and measure().
SideMeasurement measureSide(
    const engine::Device& device, const hair::Settings& settings,
    const std::filesystem::path& directory, const std::string& name, const MeasureHooks& hooks);

}  // namespace benchmarks
