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

// ---- One for each row of the table --------------------------------------------------------------

// RFC 4180, but lines end with LF alone: a row for each metric of each case, with a column for each
// axis, and a row with the reason for each case that has none. Empty fields are not known.
std::string csv(const scene::Json& report);

// A table in GitHub's Markdown, a row a case: axes, FPS, medians in ms, how it went.
std::string markdown(const scene::Json& report);

// google-benchmark's JSON, of times only: its aggregates and counters are taken for times by those
// who read it. Each metric is a benchmark of its own, "<case>/<metric>", whose real time and CPU
// time are both the median, as some readers look at the one and some at the other.
std::string gbench(const scene::Json& report);

// Bencher Metric Format: times as `latency` in ns, rates as `throughput`, memory as `bytes`; lower
// and upper value are the quartiles.
std::string bmf(const scene::Json& report);

// What github-action-benchmark takes as customSmallerIsBetter: times and memory, with the median
// absolute deviation as range.
std::string customSmallerIsBetter(const scene::Json& report);

// Chrome's trace events, which Perfetto opens: for each case, its isolated frames one after another
// with their passes, and its overlapped frames with what the CPU did for each.
std::string perfetto(const scene::Json& report);

}  // namespace benchmarks::report
