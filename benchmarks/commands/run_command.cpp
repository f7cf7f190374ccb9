#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/report/baseline.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/run/estimate.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/run/record.h"
#include "benchmarks/run/run.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {
namespace {

void printReport(const run::FinishedRun& finished, const std::filesystem::path& out) {
    std::cout << finished.summary << "report: " << engine::shownText(out.string()) << '\n';
}

// The last line, if a case is not trusted.
void tellTrust(const report::Verdicts& verdicts) {
    if (const std::string summary = verdicts.summary(); !summary.empty())
        std::cerr << "hairbench: " << engine::shownText(summary) << '\n';
}

int conclude(
    const run::RunOptions& options, const run::FinishedRun& finished,
    const std::filesystem::path& out) {
    const bool any_ran = finished.measured > 0;
    int status = any_ran ? report::kOk : report::kNothingRan;
    if (any_ran && !options.baseline.empty())
        status = compareReports(
            {.a = {}, .b = out, .baseline = options.baseline, .verdict = options.verdict});
    // Saved after the comparison, because it may replace the baseline that was compared with.
    if (!options.save_baseline.empty()) report::saveBaseline(options.save_baseline, out);
    tellTrust(finished.verdicts);
    // A comparison of times that are not trusted says nothing.
    const bool is_of_times =
        status == report::kOk || status == report::kRegressed || status == report::kInconclusive;
    if (is_of_times && options.fail_on && finished.verdicts.worst() >= *options.fail_on)
        return report::kNotTrusted;
    return status;
}

int printNothingToRun(const run::RunOptions& options, const run::RunPlan& plan) {
    if (options.shard.empty())
        std::cerr << "hairbench: no case's name matches '" << options.filter << "'\n";
    else
        std::cerr << "hairbench: none of the " << plan.case_count << " cases is in shard "
                  << options.shard << '\n';
    return report::kNothingRan;
}

}  // namespace

int runScene(const run::RunOptions& options) {
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    scene::SceneOptions scene = options.scene;
    scene.reads_assets = !options.dry_run;  // growing hair takes too long for an estimate
    run::RunPlan plan = run::planRun(scene, options.filter, options.shard, &cache.assets());
    plan.max_memory = options.max_memory;
    if (options.list) return run::printNames(plan);
    if (options.dry_run) return run::estimateRun(plan, options.scene.device, cache);
    if (plan.cases.empty()) return printNothingToRun(options, plan);
    // Checks the baselines first, so that errors do not show only after hours of work.
    if (!options.save_baseline.empty()) report::baselineFile(options.save_baseline, plan.name);
    if (!options.baseline.empty())
        if (const auto file = report::baselineFile(options.baseline, plan.name);
            !std::filesystem::is_regular_file(file)) {
            std::cerr << "hairbench: no baseline '" << options.baseline << "': " << file.string()
                      << ": there is no such file\n";
            return report::kNoBaseline;
        }
    const std::filesystem::path out = run::reportFile(options, plan);
    engine::checkWritable(out);
    run::checkReferences(plan);

    engine::processUse();  // counts threads that start from here on, including the device's
    run::RunDevice device(options.scene.device);
    std::cerr << report::versionOnDevice(device.get()) << '\n';
    const auto print_short = [&](const char* why, const run::FinishedRun& finished) {
        printReport(finished, out);
        std::cerr << why << " after " << finished.done << " of " << plan.cases.size()
                  << " cases; --resume continues\n";
        tellTrust(finished.verdicts);
    };
    const auto print_interrupted = [&](const run::FinishedRun& finished) {
        print_short("interrupted", finished);
    };
    const run::FinishedRun finished =
        run::playRun(device, options, plan, out, cache, print_interrupted);
    if (finished.interrupted) {
        print_interrupted(finished);
        return report::kInterrupted;
    }
    if (!finished.no_device.empty()) {
        print_short("hairbench: the device was lost", finished);
        std::cerr << "hairbench: " << engine::shownText(finished.no_device) << '\n';
        return report::kNoDevice;
    }
    if (finished.was_complete)
        std::cout << "nothing left to do: " << engine::shownText(out.string()) << " is complete\n";
    else
        printReport(finished, out);
    return conclude(options, finished, out);
}

}  // namespace benchmarks::commands
