#pragma once

#include <span>
#include <string>
#include <string_view>

#include "benchmarks/scene/json.h"

// A written report (results/report.schema.json) in the formats of other tools. All are functions of
// the report alone, end with a newline, and never hold a number that is not finite.
namespace benchmarks::report {

struct Exporter {
    const char* name;
    const char* description;
    const char* extension;  // of the file, with its dot
    std::string (*write)(const scene::Json& report);
};

std::span<const Exporter> exporters();

// The report in the format of that name. An unknown format, another kind of document or one that is
// damaged is an engine::Error.
std::string exportReport(const scene::Json& report, std::string_view format);

}  // namespace benchmarks::report
