#pragma once

#include <cstddef>
#include <filesystem>

#include "benchmarks/json_fwd.h"

// Samples of large metrics lie in a file beside the report, "<report without extension>
// .samples.jsonl": a line {"case", "metric", "samples"} for each. Such a metric has "samples_file",
// its name relative to the report, and "sample_count" instead of "samples".
namespace benchmarks {

inline constexpr std::size_t kMostSamplesInReport = 2000;

// Moves what is large out of the report, into the file beside `path`, and returns whether anything
// was. Throws engine::Error "<path>: <reason>".
bool moveSamplesOut(Json& report, const std::filesystem::path& path);

// The file of an older report there, when it is needed no more.
void removeSamples(const std::filesystem::path& path);

// Undoes that for a report that was read from `path`. Throws engine::Error where the file is
// missing, damaged or of another report.
void moveSamplesIn(Json& report, const std::filesystem::path& path);

}  // namespace benchmarks
