#pragma once

#include <filesystem>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// A written report with all its samples, those of a sidecar too. Throws engine::Error "<path>:
// <reason>": no such file, no report, one of another major version, a sidecar that is missing.
Json readReport(const std::filesystem::path& path);

// Writes a report in one step: whoever opens the file sees the old one or the new one. Large
// samples go into a file beside it (samples_file.h). Creates missing folders. Throws engine::Error
// "<path>: <reason>".
void writeReport(const Json& report, const std::filesystem::path& path);

}  // namespace benchmarks
