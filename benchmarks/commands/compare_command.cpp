#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/report/baseline.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/report.h"
#include "engine/error.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {
namespace {

struct Pair {
    std::filesystem::path a;
    std::filesystem::path b;
};

// With a baseline, the only report is B, whether it was given first or second.
Pair wantedReports(const report::CompareOptions& options) {
    const bool both = !options.a.empty() && !options.b.empty();
    if (options.baseline.empty()) {
        if (!both) throw engine::Error("compare", "two reports are needed, or one and --baseline");
        return {options.a, options.b};
    }
    if (both) throw engine::Error("--baseline", "names report A: give only report B");
    const std::filesystem::path& b = options.b.empty() ? options.a : options.b;
    if (b.empty()) throw engine::Error("compare", "a report is needed");
    return {{}, b};
}

void print(
    const report::ReportComparison& comparison, const Pair& files, report::ShowCases show_cases,
    bool all) {
    std::cout << "A: " << engine::shownText(files.a.string())
              << "\nB: " << engine::shownText(files.b.string()) << '\n';
    for (const std::string& each : comparison.warnings)
        std::cout << "warning: " << engine::shownText(each) << '\n';
    for (const std::string& each : comparison.unmatched)
        std::cout << engine::shownText(each) << '\n';
    for (const report::Mismatch& each : comparison.mismatches)
        std::cout << engine::shownText(report::mismatchText(each)) << '\n';
    std::vector<report::Change> rows;
    for (const report::Change& each : comparison.changes)
        if (all || each.comparison.verdict != report::Verdict::same) rows.push_back(each);
    std::cout << '\n' << report::changesTable(rows, show_cases) << (rows.empty() ? "" : "\n");
    if (!comparison.mismatches.empty())
        std::cout << comparison.mismatches.size() << " mismatch"
                  << (comparison.mismatches.size() == 1 ? "" : "es") << ", ";
    std::cout << report::verdictCounts(comparison.changes);
    if (!comparison.too_short.empty())
        std::cout << "; " << comparison.too_short.size() << " shorter than 0.05 ms, not judged";
    std::cout << '\n' << report::kOneProcessCaveat << '\n';
}

}  // namespace

namespace {

// Says how many changes can't be known. They must not look like unchanged times.
void tellUnknown(const report::ReportComparison& comparison) {
    const auto unknown = std::ranges::count_if(comparison.changes, [](const report::Change& each) {
        return !std::isfinite(each.comparison.upper);
    });
    if (unknown > 0)
        std::cerr << "hairbench: " << unknown << " of " << comparison.changes.size()
                  << " changes can't be known, because the reports have too few frames: measure "
                     "longer (--max-time 10)\n";
}

}  // namespace

int compareReports(const report::CompareOptions& options) {
    Pair files = wantedReports(options);
    const scene::Json b = report::readReport(files.b);
    const bool with_baseline = !options.baseline.empty();
    scene::Json a;
    if (with_baseline) {
        files.a = report::baselineFile(options.baseline, report::sceneNameOf(b));
        try {
            a = report::readReport(files.a);
        } catch (const engine::Error& error) {
            std::cerr << "hairbench: no baseline '" << options.baseline << "': " << error.what()
                      << '\n';
            return report::kNoBaseline;
        }
    } else {
        a = report::readReport(files.a);
    }
    const report::ReportComparison comparison = report::compareReports(a, b, options.verdict);
    if (with_baseline && !comparison.same_device) {
        for (const std::string& each : comparison.warnings)
            std::cerr << engine::shownText(each) << '\n';
        std::cerr << "hairbench: baseline '" << options.baseline << "' comes from another device\n";
        return report::kNoBaseline;
    }
    if (comparison.changes.empty() && comparison.mismatches.empty()) {
        std::cerr << "hairbench: "
                  << (comparison.common_cases == 0 ? "the reports have no case in common\n"
                                                   : "the reports have no time in common\n");
        return with_baseline ? report::kNoBaseline : report::kNothingRan;
    }
    if (options.json)
        std::cout << report::comparisonJson(comparison, files.a.string(), files.b.string())
                         .dump(2, ' ', false, scene::Json::error_handler_t::replace)
                  << '\n';
    else
        print(
            comparison, files,
            comparison.common_cases > 1 ? report::ShowCases::yes : report::ShowCases::no,
            options.all);
    tellUnknown(comparison);
    return report::verdictStatus(
        report::overallVerdict(comparison), options.verdict.fail_on_inconclusive);
}

}  // namespace benchmarks::commands
