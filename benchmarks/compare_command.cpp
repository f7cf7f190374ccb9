#include <iostream>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/baseline.h"
#include "benchmarks/commands.h"
#include "benchmarks/compare/report_comparison.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/report_file.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

struct Pair {
    std::filesystem::path a;
    std::filesystem::path b;
};

// With a baseline the only report is B, whichever place it was given in.
Pair wantedReports(const CompareOptions& options) {
    const bool both = !options.a.empty() && !options.b.empty();
    if (options.baseline.empty()) {
        if (!both) throw engine::Error("compare", "two reports are needed, or one and --baseline");
        return {options.a, options.b};
    }
    if (both) throw engine::Error("--baseline", "is report A: give the other one only");
    const std::filesystem::path& b = options.b.empty() ? options.a : options.b;
    if (b.empty()) throw engine::Error("compare", "a report is needed");
    return {{}, b};
}

void print(const ReportComparison& comparison, const Pair& files, ShowCases show_cases, bool all) {
    std::cout << "A: " << files.a.string() << "\nB: " << files.b.string() << '\n';
    for (const std::string& each : comparison.warnings) std::cout << "warning: " << each << '\n';
    for (const std::string& each : comparison.unmatched) std::cout << each << '\n';
    for (const Mismatch& each : comparison.mismatches) std::cout << mismatchText(each) << '\n';
    std::vector<Change> rows;
    for (const Change& each : comparison.changes)
        if (all || each.comparison.verdict != Verdict::same) rows.push_back(each);
    std::cout << '\n' << changesTable(rows, show_cases) << (rows.empty() ? "" : "\n");
    if (!comparison.mismatches.empty())
        std::cout << comparison.mismatches.size() << " mismatch"
                  << (comparison.mismatches.size() == 1 ? "" : "es") << ", ";
    std::cout << verdictCounts(comparison.changes);
    if (!comparison.too_short.empty())
        std::cout << "; " << comparison.too_short.size() << " shorter than 0.05 ms, not judged";
    std::cout << '\n' << kOneProcessCaveat << '\n';
}

}  // namespace

int compareReports(const CompareOptions& options) {
    Pair files = wantedReports(options);
    const Json b = readReport(files.b);
    const bool with_baseline = !options.baseline.empty();
    Json a;
    if (with_baseline) {
        files.a = baselineFile(options.baseline, sceneNameOf(b));
        try {
            a = readReport(files.a);
        } catch (const engine::Error& error) {
            std::cerr << "hairbench: no baseline '" << options.baseline << "': " << error.what()
                      << '\n';
            return kNoBaseline;
        }
    } else {
        a = readReport(files.a);
    }
    const ReportComparison comparison = compareReports(a, b, options.verdict);
    if (with_baseline && !comparison.same_device) {
        for (const std::string& each : comparison.warnings) std::cerr << each << '\n';
        std::cerr << "hairbench: baseline '" << options.baseline << "' is of another device\n";
        return kNoBaseline;
    }
    if (comparison.changes.empty() && comparison.mismatches.empty()) {
        std::cerr << "hairbench: "
                  << (comparison.common_cases == 0 ? "the reports have no case in common\n"
                                                   : "the reports have no time in common\n");
        return with_baseline ? kNoBaseline : kNothingRan;
    }
    if (options.json)
        std::cout << comparisonJson(comparison, files.a.string(), files.b.string())
                         .dump(2, ' ', false, Json::error_handler_t::replace)
                  << '\n';
    else
        print(
            comparison, files, comparison.common_cases > 1 ? ShowCases::yes : ShowCases::no,
            options.all);
    return verdictStatus(overallVerdict(comparison), options.verdict.fail_on_inconclusive);
}

}  // namespace benchmarks
