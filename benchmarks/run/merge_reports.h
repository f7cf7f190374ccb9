#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/scene/json.h"

// Joins the reports of a sweep's shards.
namespace benchmarks::run {

struct MergeRules {
    std::filesystem::path out;  // what pictures' file names are to be relative to
    bool force = false;  // join what does not belong together; of a case that is there twice the
                         // first is taken
};

// One report of a sweep's parts: its cases in the sweep's order, all else of the first report,
// "interrupted" where cases are missing. `notes` gets a line for each thing to know: what `force`
// passed over, which cases are missing. Throws engine::Error "<path>: <reason>" as readReport, and
// for a report of another scene, build or device than the first's, or with a case of an earlier
// one.
scene::Json mergedReport(
    const std::vector<std::filesystem::path>& reports, const MergeRules& rules,
    std::vector<std::string>& notes);

}  // namespace benchmarks::run
