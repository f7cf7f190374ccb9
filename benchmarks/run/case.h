#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/report.h"
#include "benchmarks/run/backends.h"
#include "benchmarks/run/plan.h"
#include "engine/device.h"

// One case of a run: its measurement and the picture beside the report.
namespace benchmarks::run {

// Writes a case's picture, [row][column] RGBA, top row first, beside the report, as a PNG at most
// 480 px wide: "<report without extension>.pictures/<index>.png". Returns that file relative to the
// report's folder, with forward slashes. Throws engine::Error "<path>: <reason>".
std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index);

// Removes the pictures that older runs left beside the report and that are none of `pictures`,
// those that it names.
void removeOtherPictures(
    const std::set<std::string>& pictures, const std::filesystem::path& report);

// What the cases of a run are compared with.
struct CaseComparisons {
    reference::ReferenceComparison references;
    BackendComparison backends;
};

struct PlayedCase {
    report::CaseResult result;
    bool lost_device = false;  // nothing more can be done with it
};

// Measures a case. One that can't run here, or that fails, is part of the result with its reason;
// for lack of memory (measure/memory_need.h), or of `max_memory`, B, it is not even made. `report`
// is the file beside which its picture goes; empty: none is written. Throws Interrupted.
PlayedCase runCase(
    const engine::Device& device, const PlannedCase& planned, const measure::MeasureHooks& hooks,
    const std::filesystem::path& report, CaseComparisons& comparisons, measure::HairCache& cache,
    std::optional<std::uint64_t> max_memory = {});

}  // namespace benchmarks::run
