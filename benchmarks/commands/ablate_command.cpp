#include <algorithm>
#include <iostream>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/ablate/ladder_walk.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/run/plan.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {
namespace {

std::vector<std::string> notesFor(const report::DeviceRecord& device) {
    std::vector<std::string> notes{"a marginal cost is the time that a stage adds to the pass, not "
                                   "the time that the stage works: stages overlap"};
    if (device.type == "cpu")
        notes.push_back("on a software device one thread makes the primitives while other threads "
                        "work on fragments");
    return notes;
}

void ablateAll(
    const engine::Device& device, const run::RunPlan& plan, std::uint32_t laps,
    measure::HairCache& cache, measure::Progress& progress,
    std::vector<ablate::CaseAblation>& cases) {
    for (const run::PlannedCase& each : plan.cases) {
        progress.begin(each.spec.name);
        const auto update = [&](const std::string& state) { progress.update(state); };
        ablate::ablateCase(
            device, each.spec, each.directory, laps, update, cache, cases.emplace_back());
        for (const std::string& message : device.messages().take())
            cases.back().warnings.push_back("validation: " + message);
        progress.clear();
        std::cout << ablate::ablationTable(cases.back()) << std::endl;
    }
}

}  // namespace

int ablateScene(const AblateOptions& options) {
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const run::RunPlan plan = run::planRun(options.scene, options.filter, "", &cache.assets());
    if (plan.cases.empty()) {
        std::cerr << "hairbench: no case's name matches '" << options.filter << "'\n";
        return report::kNothingRan;
    }
    const std::filesystem::path out = options.out.empty() ? std::filesystem::path("results/local") /
                                                                ("ablation-" + plan.name + ".json")
                                                          : options.out;
    engine::checkWritable(out);

    const engine::Device device(options.scene.device);
    std::cerr << report::versionOnDevice(device) << '\n';
    ablate::AblationReport report{
        .environment = report::describeEnvironment(
            device, options.command, plan.seed, options.scene.device.validation),
        .scene = plan.scene,
        .laps = options.passes};
    report.notes = notesFor(report.environment.device);
    measure::Progress progress(plan.cases.size());
    const auto finish = [&] {
        engine::writeFileAtomically(out, ablate::ablationText(report));
        for (const std::string& note : report.notes)
            std::cout << "note: " << engine::shownText(note) << '\n';
        std::cout << "report: " << out.string() << '\n';
    };
    const auto finish_interrupted = [&] {
        report.interrupted = true;
        progress.clear();
        const ablate::CaseAblation& interrupted_case = report.cases.back();
        if (interrupted_case.attribution)
            std::cout << ablate::ablationTable(interrupted_case) << '\n';
        else
            report.cases.pop_back();
        finish();
        std::cerr << "interrupted: " << report.cases.size() << " of " << plan.cases.size()
                  << " cases have results\n";
    };
    const engine::InterruptMessage last_words(finish_interrupted);
    try {
        ablateAll(device, plan, options.passes, cache, progress, report.cases);
    } catch (const engine::Interrupted&) {
        finish_interrupted();
        return report::kInterrupted;
    }
    finish();
    const bool any_ran = std::ranges::any_of(
        report.cases, [](const auto& each) { return each.status == report::Status::ok; });
    return any_ran ? report::kOk : report::kNothingRan;
}

}  // namespace benchmarks::commands
