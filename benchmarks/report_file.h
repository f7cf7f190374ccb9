#pragma once

#include <filesystem>
#include <string_view>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// Whether this program reads reports of that schema: "hairbench-report/1.2.0" for one of 1.1.0, as
// minor versions add members.
bool isReadable(std::string_view schema);

// A written report with all its samples, those of a sidecar too. Throws engine::Error "<path>:
// <reason>": no such file, no report, one of another major version, a sidecar that is missing.
Json readReport(const std::filesystem::path& path);

// Writes a report in one step: whoever opens the file sees the old one or the new one. Large
// samples go into a file beside it (samples_file.h). Creates missing folders. Throws engine::Error
// "<path>: <reason>".
void writeReport(const Json& report, const std::filesystem::path& path);

}  // namespace benchmarks
