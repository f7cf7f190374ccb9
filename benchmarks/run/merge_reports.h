#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// Merges the reports of a sweep's shards.
namespace benchmarks::run {

struct MergeRules {
    std::filesystem::path out;  // the merged report, to which picture paths become relative
    bool force = false;  // merge even reports that do not belong together; of two equal cases, keep
                         // the first
};

// Merges the reports of parts of a sweep: the cases in the sweep's order, everything else from the
// first report, "interrupted" if cases are missing. Adds a line to `notes` for each objection that
// `force` overrode, and for missing cases. Throws engine::Error "<path>: <reason>" like readReport,
// for a report of another scene, build or device than the first one, and for a case that an earlier
// report has.
scene::Json mergedReport(
    const std::vector<std::filesystem::path>& reports, const MergeRules& rules,
    std::vector<std::string>& notes);

}  // namespace benchmarks::run
