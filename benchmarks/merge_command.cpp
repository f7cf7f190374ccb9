#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/report_file.h"
#include "benchmarks/run/merge_reports.h"
#include "engine/write_file.h"

namespace benchmarks {

int mergeReports(const MergeOptions& options) {
    engine::checkWritable(options.out);
    std::vector<std::string> notes;
    const Json report =
        mergedReport(options.reports, {.out = options.out, .force = options.force}, notes);
    writeReport(report, options.out);
    for (const std::string& note : notes) std::cerr << "hairbench: " << note << '\n';
    std::cout << options.out.string() << ": " << report.at("cases").size() << " cases of "
              << options.reports.size() << " reports\n";
    // As a run that did not come to its end.
    return report.at("interrupted").get<bool>() ? kInterrupted : kOk;
}

}  // namespace benchmarks
