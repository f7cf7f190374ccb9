#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/facts.h"
#include "benchmarks/doctor/reports.h"
#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/exporters.h"
#include "benchmarks/report/page.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/run/run.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {

// ---- hairbench compare --------------------------------------------------------------------------

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
    std::cout << '\n';
    const bool has_times = std::ranges::any_of(comparison.changes, [](const report::Change& each) {
        return each.metric.of != report::MetricOf::shader && !report::isProbe(each.metric);
    });
    std::cout << report::codeChangesText(comparison.code) << (comparison.code.empty() ? "" : "\n");
    if (has_times) std::cout << report::kOneProcessCaveat << '\n';
}

}  // namespace

namespace {

// Says how many changes can't be known. They must not look like unchanged times.
void tellUnknown(const report::ReportComparison& comparison) {
    const auto unknown = std::ranges::count_if(comparison.changes, [](const report::Change& each) {
        return each.comparison.verdict == report::Verdict::inconclusive &&
               !std::isfinite(each.comparison.upper);
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
                      : options.verdict.probes
                          ? "the reports have no probe in common: see /run/probes\n"
                          : "the reports have no time in common\n");
        return with_baseline ? report::kNoBaseline : report::kNothingRan;
    }
    const std::string json = report::comparisonJson(comparison, files.a.string(), files.b.string())
                                 .dump(2, ' ', false, scene::Json::error_handler_t::replace) +
                             '\n';
    if (!options.out.empty()) engine::writeFileAtomically(options.out, json);
    if (options.json)
        std::cout << json;
    else
        print(
            comparison, files,
            comparison.common_cases > 1 ? report::ShowCases::yes : report::ShowCases::no,
            options.all);
    tellUnknown(comparison);
    return report::verdictStatus(
        report::overallVerdict(comparison), options.verdict.fail_on_inconclusive);
}

// ---- hairbench convert --------------------------------------------------------------------------

int convertReport(const ConvertReportOptions& options) {
    const std::string text =
        report::exportReport(report::readReport(options.report), options.format);
    if (options.out.empty()) {
        std::cout << text;
        return report::kOk;
    }
    engine::writeFileAtomically(options.out, text);
    std::cout << engine::shownText(options.out.string()) << ": " << options.format << " of "
              << engine::shownText(options.report.string()) << '\n';
    return report::kOk;
}

// ---- hairbench merge ----------------------------------------------------------------------------

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

// ---- hairbench report ---------------------------------------------------------------------------

int writeReportPage(const ReportPageOptions& options) {
    const report::PageParts parts = report::readPageParts(report::readPlotly());
    const scene::Json data = report::pageData(options.reports);
    engine::writeFileAtomically(options.out, report::assemblePage(parts, data));
    for (const scene::Json& each : data.at("left_out"))
        std::cerr << "hairbench: left out " << engine::shownText(each.at("file").get<std::string>())
                  << ": is not a report of 'hairbench run': "
                  << engine::shownText(each.at("reason").get<std::string>()) << '\n';
    std::size_t missing = 0;
    for (const scene::Json& report : data.at("reports"))
        for (const scene::Json& each : report.at("cases"))
            missing += each.contains("picture_missing");
    if (missing > 0)
        std::cerr << "hairbench: " << missing
                  << (missing == 1 ? " picture of a case is missing\n"
                                   : " pictures of cases are missing\n");
    std::cout << "page: " << engine::shownText(options.out.string()) << '\n';
    const scene::Json& reports = data.at("reports");
    for (const scene::Json& each : reports)
        if (const std::string summary = report::verdictsOf(each).summary(); !summary.empty()) {
            const std::string file = each.at("file").get<std::string>() + ": ";
            std::cerr << "hairbench: "
                      << engine::shownText((reports.size() > 1 ? file : "") + summary) << '\n';
        }
    return report::kOk;
}

// ---- hairbench doctor ---------------------------------------------------------------------------

namespace {

constexpr std::uint32_t kPlantedGates = 10;

// Runs in this process, but releases its device before other processes measure.
void examineDevice(const DoctorOptions& options, doctor::DoctorReport& report) {
    engine::processUse();  // counts threads that start from here on
    const engine::Device device(options.device);
    std::cerr << report::versionOnDevice(device) << '\n';
    report.environment = report::describeEnvironment(
        device, options.command, doctor::doctorSettings().seed, options.device.validation);
    measure::addBoard(device.info(), report.environment.device);
    const measure::MeasureHooks hooks{.stop = engine::interrupted};
    const engine::Step step("examines the machine");
    std::vector<doctor::Finding> findings =
        doctor::judgeAll(doctor::gatherFacts(device, options.device.validation, hooks));
    const engine::HeldMessages held;
    report.findings = std::move(findings);
}

void examineGates(const DoctorOptions& options, doctor::DoctorReport& report) {
    if (options.pairs == 0) return;
    std::cerr << "measuring " << options.pairs << " pairs of processes\n";
    std::vector<doctor::Sensitivity> sensitivities =
        doctor::measureSensitivity(options.device, options.pairs);
    {
        const engine::HeldMessages held;
        report.sensitivities = std::move(sensitivities);
    }
    if (!options.planted) return;
    std::cerr << "looking for " << kPlantedGates << " planted slowdowns\n";
    std::vector<doctor::PlantedGate> planted =
        doctor::plantSlowdowns(options.device, report.sensitivities, kPlantedGates);
    const engine::HeldMessages held;
    report.planted = std::move(planted);
    report.findings.push_back(doctor::judgePlanted(report.planted));
}

int examineReports(const std::vector<std::filesystem::path>& reports) {
    int status = report::kOk;
    for (const std::filesystem::path& path : reports) {
        if (path.string().ends_with(".schema.json")) continue;  // results/*.json matches it too
        std::string said;
        bool accepted = false;
        try {
            const doctor::ReportExamination examination = doctor::examineReport(path);
            accepted = doctor::isAccepted(examination);
            said = engine::shownText(path.string()) + ": " + doctor::examinationText(examination);
        } catch (const engine::Error& error) {
            said = shortMessage(error);
        }
        (accepted ? std::cout : std::cerr) << said << '\n';
        if (!accepted) status = report::kCheckFailed;
    }
    return status;
}

}  // namespace

int examineMachine(const DoctorOptions& options) {
    if (!options.reports.empty()) return examineReports(options.reports);
    if (!options.rules.empty()) {
        const std::vector<doctor::RuleFinding> findings =
            doctor::judgeRules(report::readReport(options.rules));
        std::cout << doctor::rulesText(findings);
        return doctor::meetsRules(findings) ? report::kOk : report::kCheckFailed;
    }
    if (options.planted && options.pairs == 0)
        throw engine::Error(
            "--planted", "needs --pairs, which estimate how large a slowdown to plant");
    if (!options.out.empty()) engine::checkWritable(options.out);
    doctor::DoctorReport report;
    const auto finish = [&] {
        if (!report.findings.empty()) {
            if (!options.out.empty())
                engine::writeFileAtomically(options.out, doctor::doctorReportText(report));
            std::cout << doctor::doctorText(report);
            if (!options.out.empty()) std::cout << "report: " << options.out.string() << '\n';
        }
        if (report.interrupted) std::cerr << "interrupted\n";
    };
    const engine::InterruptMessage last_words([&] {
        report.interrupted = true;
        finish();
    });
    try {
        examineDevice(options, report);
        examineGates(options, report);
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    engine::finishInAnyCase();
    finish();
    if (report.interrupted) return report::kInterrupted;
    return doctor::isTrusted(report) ? report::kOk : report::kCheckFailed;
}

}  // namespace benchmarks::commands
