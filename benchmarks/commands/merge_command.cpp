#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/run/merge_reports.h"
#include "engine/files.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {

int mergeReports(const MergeOptions& options) {
    engine::checkWritable(options.out);
    std::vector<std::string> notes;
    const scene::Json report =
        run::mergedReport(options.reports, {.out = options.out, .force = options.force}, notes);
    report::writeReport(report, options.out);
    for (const std::string& note : notes)
        std::cerr << "hairbench: " << engine::shownText(note) << '\n';
    std::cout << engine::shownText(options.out.string()) << ": " << report.at("cases").size()
              << " cases of " << options.reports.size() << " reports";
    const report::Verdicts verdicts = report::verdictsOf(report);
    if (const std::string counts = verdicts.counts(); !counts.empty()) std::cout << ": " << counts;
    std::cout << '\n';
    if (const std::string summary = verdicts.summary(); !summary.empty())
        std::cerr << "hairbench: " << engine::shownText(summary) << '\n';
    // Missing cases give the exit status of an interrupted run.
    return report.at("interrupted").get<bool>() ? report::kInterrupted : report::kOk;
}

}  // namespace benchmarks::commands
