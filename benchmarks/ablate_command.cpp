#include <algorithm>
#include <iostream>

#include "benchmarks/ablate/ablate_case.h"
#include "benchmarks/ablate/ablation_text.h"
#include "benchmarks/commands.h"
#include "benchmarks/environment.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/progress.h"
#include "benchmarks/run/run_plan.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

std::vector<std::string> notesFor(const DeviceRecord& device) {
    std::vector<std::string> notes{
        "a marginal cost is what the pass takes longer with a stage, not how long the stage works: "
        "stages overlap in time"};
    if (device.type == "cpu")
        notes.push_back(
            "on a CPU device what makes primitives is one thread, and fragments are worked on by "
            "others beside it");
    return notes;
}

void ablateAll(
    const engine::Device& device, const RunPlan& plan, std::uint32_t laps, Progress& progress,
    std::vector<CaseAblation>& cases) {
    for (const PlannedCase& each : plan.cases) {
        progress.begin(each.spec.name);
        const auto update = [&](const std::string& state) { progress.update(state); };
        ablateCase(device, each.spec, each.directory, laps, update, cases.emplace_back());
        for (const std::string& message : device.messages().take())
            cases.back().warnings.push_back("validation: " + message);
        progress.clear();
        std::cout << ablationTable(cases.back()) << std::endl;
    }
}

}  // namespace

int ablateScene(const AblateOptions& options) {
    const RunPlan plan = planRun(options.scene, options.filter, "");
    if (plan.cases.empty()) {
        std::cerr << "hairbench: no case's name matches '" << options.filter << "'\n";
        return kNothingRan;
    }
    const std::filesystem::path out = options.out.empty() ? std::filesystem::path("results/local") /
                                                                ("ablation-" + plan.name + ".json")
                                                          : options.out;
    engine::checkWritable(out);

    catchInterrupts();
    const engine::Device device(options.scene.device);
    std::cerr << versionText() << " on " << device.info().name << " (" << device.info().driver
              << ' ' << device.info().driver_version << ")\n";
    AblationReport report{
        .environment = describeEnvironment(
            device, options.command, plan.seed, options.scene.device.validation),
        .scene = plan.scene,
        .laps = options.passes};
    report.notes = notesFor(report.environment.device);
    Progress progress(plan.cases.size());
    try {
        ablateAll(device, plan, options.passes, progress, report.cases);
    } catch (const Interrupted&) {
        report.interrupted = true;
        progress.clear();
        const CaseAblation& interrupted_case = report.cases.back();
        if (interrupted_case.attribution)
            std::cout << ablationTable(interrupted_case) << '\n';
        else
            report.cases.pop_back();
    }
    engine::writeFileAtomically(out, ablationText(report));
    for (const std::string& note : report.notes) std::cout << "note: " << note << '\n';
    std::cout << "report: " << out.string() << '\n';
    if (report.interrupted) {
        std::cerr << "interrupted: " << report.cases.size() << " of " << plan.cases.size()
                  << " cases have results\n";
        return kInterrupted;
    }
    const bool any_ran = std::ranges::any_of(
        report.cases, [](const auto& each) { return each.status == Status::ok; });
    return any_ran ? kOk : kNothingRan;
}

}  // namespace benchmarks
