#include <algorithm>
#include <iostream>
#include <random>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/baseline.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/case.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/run/record.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {
namespace {

// Shards of a sweep in one folder are not to take each other's place.
std::filesystem::path reportFile(const run::RunOptions& options, const run::RunPlan& plan) {
    if (!options.out.empty()) return options.out;
    std::string name = plan.name;
    if (!options.shard.empty()) {
        const report::Shard shard = run::parseShard(options.shard);
        name += '.' + std::to_string(shard.index) + "of" + std::to_string(shard.count);
    }
    return std::filesystem::path("results/local") / (name + ".json");
}

// Throws where a reference is not there.
void checkReferences(const run::RunPlan& plan) {
    for (const run::PlannedCase& each : plan.cases) {
        const std::string& file = each.spec.settings.run.reference;
        if (!file.empty() && !std::filesystem::is_regular_file(each.directory / file))
            throw engine::Error(
                plan.scene.path,
                "/run/reference: " + (each.directory / file).string() + ": is no file");
    }
}

report::ReportHeader
headerOf(const run::RunOptions& options, const run::RunPlan& plan, const engine::Device& device) {
    report::ReportHeader header;
    header.environment = report::describeEnvironment(
        device, options.command, plan.seed, options.scene.device.validation);
    header.scene = plan.scene;
    header.case_count = plan.case_count;
    header.order_seed = options.order_seed ? *options.order_seed : std::random_device()();
    if (!options.shard.empty()) header.shard = run::parseShard(options.shard);
    return header;
}

void printReport(const scene::Json& report, const std::filesystem::path& out) {
    std::cout << report::table(report) << '\n';
    for (const scene::Json& each : report.at("cases"))
        for (const scene::Json& warning :
             each.value("/trust/warnings"_json_pointer, scene::Json::array()))
            std::cout << each.at("name").get<std::string>() << ": " << warning.get<std::string>()
                      << '\n';
    std::cout << "report: " << out.string() << '\n';
}

// Keeps and compares a complete report as the command line asks; the exit status.
int conclude(
    const run::RunOptions& options, const scene::Json& report, const std::filesystem::path& out) {
    const bool any_ran = std::ranges::any_of(
        report.at("cases"), [](const scene::Json& each) { return each.at("status") == "ok"; });
    int status = any_ran ? report::kOk : report::kNothingRan;
    if (any_ran && !options.baseline.empty())
        status = compareReports(
            {.a = {}, .b = out, .baseline = options.baseline, .verdict = options.verdict});
    // Only now: the name may be that of the baseline that was compared with.
    if (!options.save_baseline.empty()) report::saveBaseline(options.save_baseline, out);
    return status;
}

int playCases(
    const run::RunOptions& options, const run::RunPlan& plan, const report::ReportHeader& header,
    const std::filesystem::path& out, const engine::Device& device) {
    run::RunRecord record(
        plan, header, {.out = out, .filter = options.filter, .resume = options.resume});
    if (record.done() > 0)
        std::cerr << "going on after " << record.done() << " of " << plan.cases.size()
                  << " cases\n";
    measure::Progress progress(plan.cases.size(), record.done());
    measure::DeviceKnowledge known;
    const measure::MeasureHooks hooks{
        .stop = engine::interrupted,
        .progress = [&](const measure::SamplingState& state) { progress.update(state); },
        .known = &known};
    const std::filesystem::path pictures_of =
        options.pictures && record.hasJournal() ? out : std::filesystem::path();
    reference::ReferenceComparison references;
    bool was_interrupted = false;
    try {
        for (const auto& [place, order] : record.remaining()) {
            const run::PlannedCase& each = plan.cases[place];
            progress.begin(each.spec.name);
            report::CaseResult result = run::runCase(device, each, hooks, pictures_of, references);
            result.order = order;
            record.add(result);
        }
    } catch (const engine::Interrupted&) {
        was_interrupted = true;
    } catch (...) {
        progress.clear();
        throw;
    }
    progress.clear();
    const scene::Json report = record.report(was_interrupted);
    record.write(report);
    printReport(report, out);
    if (was_interrupted) {
        std::cerr << "interrupted after " << record.done() << " of " << plan.cases.size()
                  << " cases; --resume goes on\n";
        return report::kInterrupted;
    }
    if (record.hasJournal()) run::removeOtherPictures(report, out);
    return conclude(options, report, out);
}

}  // namespace

int runScene(const run::RunOptions& options) {
    const run::RunPlan plan = run::planRun(options.scene, options.filter, options.shard);
    if (options.list) return run::printNames(plan);
    if (options.dry_run) return run::estimateRun(plan, options.scene.device);
    if (plan.cases.empty()) {
        if (options.shard.empty())
            std::cerr << "hairbench: no case's name matches '" << options.filter << "'\n";
        else
            std::cerr << "hairbench: none of the " << plan.case_count << " cases is in shard "
                      << options.shard << '\n';
        return report::kNothingRan;
    }
    // What is wrong shows before hours of work, not after them.
    if (!options.save_baseline.empty()) report::baselineFile(options.save_baseline, plan.name);
    if (!options.baseline.empty())
        if (const auto file = report::baselineFile(options.baseline, plan.name);
            !std::filesystem::is_regular_file(file)) {
            std::cerr << "hairbench: there is no such baseline: " << file.string() << '\n';
            return report::kNoBaseline;
        }
    const std::filesystem::path out = reportFile(options, plan);
    engine::checkWritable(out);
    checkReferences(plan);

    engine::catchInterrupts();
    engine::processUse();  // counts the threads that begin from here on: those of the device too
    const engine::Device device(options.scene.device);
    const report::ReportHeader header = headerOf(options, plan, device);
    std::cerr << report::versionText() << " on " << device.info().name << " ("
              << device.info().driver << ' ' << device.info().driver_version << ")\n";
    try {
        if (options.resume)
            if (const auto report = run::completeReport(plan, header, out)) {
                std::cout << "nothing left to do: " << out.string() << " is complete\n";
                return conclude(options, *report, out);
            }
        return playCases(options, plan, header, out, device);
    } catch (const run::WriteFailed& error) {
        std::cerr << "hairbench: " << error.what() << '\n';
        return report::kInternalError;
    }
}

}  // namespace benchmarks::commands
