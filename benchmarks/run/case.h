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

// Runs one case: its measurement, and the picture beside the report.
namespace benchmarks::run {

// Writes a case's picture, [row][column] RGBA, top row first, beside the report, as a PNG at most
// 480 px wide: "<report without extension>.pictures/<index>.png". Returns that path relative to the
// report's folder, with forward slashes. Throws engine::Error "<path>: <reason>".
std::string writeCasePicture(
    std::span<const std::uint8_t> pixels, std::uint32_t width, std::uint32_t height,
    const std::filesystem::path& report, std::size_t index);

// Removes pictures of earlier runs beside the report that are not in `pictures`, the report's own.
void removeOtherPictures(
    const std::set<std::string>& pictures, const std::filesystem::path& report);

// References for the cases of a run.
struct CaseComparisons {
    reference::ReferenceComparison references;
    BackendComparison backends;
};

struct PlayedCase {
    report::CaseResult result;
    bool lost_device = false;  // the device cannot be used any more
};

// Measures a case. A case that cannot run here, or that fails, gives a result with the reason. If
// the device, the host or `max_memory`, B, has too little memory (measure/memory_need.h), the case
// is not even created. The picture goes beside the file `report`; if that is empty, none is
// written. Throws Interrupted.
PlayedCase runCase(
    const engine::Device& device, const PlannedCase& planned, const measure::MeasureHooks& hooks,
    const std::filesystem::path& report, CaseComparisons& comparisons, measure::HairCache& cache,
    std::optional<std::uint64_t> max_memory = {});

}  // namespace benchmarks::run
