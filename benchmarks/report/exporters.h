#pragma once

#include <span>
#include <string>
#include <string_view>

#include "benchmarks/scene/json.h"

// Exports a written report (results/report.schema.json) in the formats of other tools. Every
// exporter depends on the report alone, ends its text with a newline, and writes only finite
// numbers.
namespace benchmarks::report {

struct Exporter {
    const char* name;
    const char* description;
    const char* extension;  // of the file, with the dot
    std::string (*write)(const scene::Json& report);
};

std::span<const Exporter> exporters();

// Returns the report in the format of that name. Throws engine::Error for an unknown format,
// another kind of document or a damaged report.
std::string exportReport(const scene::Json& report, std::string_view format);

}  // namespace benchmarks::report
