#include <algorithm>
#include <iostream>

#include "benchmarks/case.h"
#include "benchmarks/commands.h"
#include "benchmarks/environment.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/hash.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/measure.h"
#include "benchmarks/picture_errors.h"
#include "benchmarks/progress.h"
#include "benchmarks/report.h"
#include "benchmarks/table.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

// A case that can't run here is part of the result, and the sweep goes on.
CaseResult runCase(
    const engine::Device& device, const CaseSpec& spec, const std::filesystem::path& directory,
    ReferenceComparison& references) {
    CaseResult result{.name = spec.name, .axes = spec.axes};
    try {
        Case test_case(device, spec.settings, directory);
        const hair::RunSettings& run = spec.settings.run;
        const hair::RenderSettings& render = spec.settings.render;
        const auto picture = measure(device, test_case, run, interrupted, result);
        if (!run.reference.empty())
            references.add(directory / run.reference, render.width, render.height, picture, result);
    } catch (const engine::Unsupported& error) {
        result = {
            .name = spec.name,
            .axes = spec.axes,
            .status = Status::skipped,
            .reason = error.what()};
    } catch (const engine::Error& error) {
        result = {
            .name = spec.name, .axes = spec.axes, .status = Status::failed, .reason = error.what()};
    }
    return result;
}

// The errors of references that are not there, before anything runs.
void checkReferences(const std::vector<CaseSpec>& cases, const Scene& scene) {
    for (const CaseSpec& each : cases) {
        const std::string& file = each.settings.run.reference;
        if (!file.empty() && !std::filesystem::is_regular_file(scene.directory / file))
            throw engine::Error(
                scene.path.string(),
                "/run/reference: " + (scene.directory / file).string() + ": is no file");
    }
}

void listCases(const std::vector<CaseSpec>& cases) {
    for (const CaseSpec& each : cases) std::cout << each.name << '\n';
    std::cout << cases.size() << (cases.size() == 1 ? " case\n" : " cases\n");
}

}  // namespace

int runScene(const RunOptions& options) {
    Scene scene = loadScene(options.scene.scene);
    std::vector<CaseSpec> cases = selectCases(scene, options.scene);
    if (!options.filter.empty()) cases = keepMatching(std::move(cases), options.filter);
    if (options.dry_run) {
        listCases(cases);
        return kOk;
    }
    if (cases.empty()) {
        std::cerr << "hairbench: no case's name matches '" << options.filter << "'\n";
        return kNothingRan;
    }
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path("results/local") / (scene.name + ".json")
                            : options.out;
    engine::checkWritable(out);
    checkReferences(cases, scene);

    catchInterrupts();
    const engine::Device device(options.scene.device);
    Report report{
        .environment = describeEnvironment(device.info(), options.command, scene.settings.seed),
        .scene = {
            .path = scene.path.string(),
            .hash = hashText(scene.resolved),
            .document = scene.resolved}};
    std::cerr << versionText() << " on " << device.info().name << " (" << device.info().driver
              << ' ' << device.info().driver_version << ")\n";
    Progress progress(cases.size());
    ReferenceComparison references;
    try {
        for (const CaseSpec& each : cases) {
            progress.begin(each.name);
            report.cases.push_back(runCase(device, each, scene.directory, references));
            for (const std::string& message : device.messages().take()) {
                report.cases.back().trust.warnings.push_back("validation: " + message);
            }
        }
    } catch (const Interrupted&) {
        report.interrupted = true;
    }
    progress.clear();
    writeReport(report, out);

    std::cout << table(report) << '\n';
    for (const CaseResult& each : report.cases) {
        for (const std::string& warning : each.trust.warnings) {
            std::cout << each.name << ": " << warning << '\n';
        }
    }
    std::cout << "report: " << out.string() << '\n';
    if (report.interrupted) {
        std::cerr << "interrupted after " << report.cases.size() << " of " << cases.size()
                  << " cases\n";
        return kInterrupted;
    }
    const bool any_ran = std::ranges::any_of(
        report.cases, [](const CaseResult& each) { return each.status == Status::ok; });
    return any_ran ? kOk : kNothingRan;
}

}  // namespace benchmarks
