#include "benchmarks/exporters/exporters.h"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/names.h"
#include "benchmarks/report.h"
#include "benchmarks/report_file.h"
#include "engine/error.h"

namespace benchmarks {
namespace {

constexpr Exporter kExporters[] = {
    {"csv", "comma-separated values: a row for each metric of each case", ".csv", csv},
    {"markdown", "a table for GitHub, a row for each case", ".md", markdown},
    {"gbench", "google-benchmark's JSON: times, for its compare.py and others", ".json", gbench},
    {"bmf", "Bencher Metric Format", ".json", bmf},
    {"customSmallerIsBetter", "for github-action-benchmark: times and memory", ".json",
     customSmallerIsBetter},
    {"perfetto", "Chrome's trace events: frames and passes", ".json", perfetto},
};

}  // namespace

std::span<const Exporter> exporters() { return kExporters; }

std::string exportReport(const Json& report, std::string_view format) {
    const auto exporter = std::ranges::find(kExporters, format, &Exporter::name);
    if (exporter == std::end(kExporters)) {
        std::vector<std::string> names;
        for (const Exporter& each : kExporters) names.emplace_back(each.name);
        throw engine::Error(unknownName("unknown format", format, names));
    }
    try {
        const auto schema = report.at("schema").get<std::string>();
        if (!isReadable(schema))
            throw engine::Error("/schema", schema + " is not " + kReportSchema);
        return exporter->write(report);
    } catch (const Json::exception& error) {
        throw engine::Error("no report", error.what());
    }
}

}  // namespace benchmarks
