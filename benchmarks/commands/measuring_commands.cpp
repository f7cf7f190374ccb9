#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <span>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/ablate/ablation.h"
#include "benchmarks/ablate/ladder_walk.h"
#include "benchmarks/commands/commands.h"
#include "benchmarks/gate/session.h"
#include "benchmarks/lod/walk.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/measure/metrics.h"
#include "benchmarks/physics/checks.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/compare.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "benchmarks/run/plan.h"
#include "benchmarks/run/record.h"
#include "benchmarks/run/run.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {

// ---- hairbench run ------------------------------------------------------------------------------

namespace {

int sayNothingMatches(const std::string& filter) {
    std::cerr << "hairbench: no case's name matches '" << filter << "'\n";
    return report::kNothingRan;
}

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
        status =
            compareReports({.b = out, .baseline = options.baseline, .verdict = options.verdict});
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
    if (options.shard.empty()) return sayNothingMatches(options.filter);
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
    if (options.list_passes) return run::printPasses(plan, options.scene.device, cache);
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
    engine::DeviceOptions wanted = options.scene.device;
    if (options.shader_costs) wanted.shader_figures = engine::ShaderFigures::where_told;
    run::RunDevice device(wanted);
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

// ---- hairbench gate -----------------------------------------------------------------------------

namespace {

std::filesystem::path reportFile(const gate::GateOptions& options) {
    if (!options.out.empty()) return options.out;
    return std::filesystem::path("results/local") /
           ("gate-" + options.scene.scene.stem().string() + ".json");
}

// Prints a failure. The lines that a failed process wrote are indented, so they can't pass for the
// program's own.
void printFailure(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    std::cerr << "hairbench: " << engine::shownText(line) << '\n';
    while (std::getline(lines, line)) std::cerr << "    " << engine::shownText(line) << '\n';
}

void printEnd(const gate::GateRun& run) {
    if (run.end == gate::GateRun::End::failed)
        printFailure(run.failure);
    else if (run.end == gate::GateRun::End::interrupted)
        std::cerr << "interrupted after " << run.pairs << (run.pairs == 1 ? " pair\n" : " pairs\n");
    else if (run.end == gate::GateRun::End::out_of_time)
        std::cerr << "out of time after " << run.pairs << (run.pairs == 1 ? " pair\n" : " pairs\n");
    else if (run.mismatches.empty() && run.changes.empty())
        std::cerr << "hairbench: no case with a time to judge ran in both builds\n";
    if (run.mismatches.empty() && (run.decided_at > 0 || run.end == gate::GateRun::End::decided) &&
        !run.changes.empty())
        std::cout << "verdict: " << report::verdictName(gate::overallVerdict(run)) << '\n';
}

// Figures of compiled shaders and probes have no noise: one process of each build decides.
int gateExactly(const gate::GateOptions& options, const std::filesystem::path& out) {
    gate::BlockRunner runner(options.scene.scene);
    const std::filesystem::path stem = out.parent_path() / out.stem();
    std::filesystem::path reports[2];
    for (const char name : {'A', 'B'}) {
        std::filesystem::path& report = reports[name - 'A'];
        report = stem.string() + (name == 'A' ? ".a.json" : ".b.json");
        try {
            runner.play(gate::parseSide(name, options), 1, report);
        } catch (const gate::BlockFailed& failed) {
            printFailure(failed.what());
            return failed.exitStatus();
        }
    }
    return compareReports(
        {.a = reports[0],
         .b = reports[1],
         .baseline = {},
         .verdict = options.verdict,
         .all = options.all,
         .out = out});
}

}  // namespace

int gateBuilds(const gate::GateOptions& options) {
    const std::filesystem::path out = reportFile(options);
    engine::checkWritable(out);
    if (options.shaders || options.verdict.probes) return gateExactly(options, out);
    const gate::GateRun run = gate::runGate(options);
    // Texts from drivers and the command line need not be UTF-8.
    engine::writeFileAtomically(
        out, gate::gateReport(run, options.verdict, options.command)
                     .dump(1, ' ', false, scene::Json::error_handler_t::replace) +
                 '\n');
    std::cout << gate::gateText(run) << "report: " << out.string() << '\n';
    printEnd(run);
    return gate::exitStatus(run, options.verdict);
}

// ---- hairbench shaders --------------------------------------------------------------------------

namespace {

report::CaseResult compileCase(
    const engine::Device& device, const run::PlannedCase& planned, measure::HairCache& cache) {
    report::CaseResult result{
        .name = planned.spec.name, .index = planned.index, .axes = planned.spec.axes};
    device.pipelines().takePrograms();
    try {
        const measure::Case compiled(device, planned.spec.settings, planned.directory, &cache);
        measure::addShaderCosts(device.pipelines().takePrograms(), result);
    } catch (const engine::Unsupported& error) {
        result.status = report::Status::skipped;
        result.reason = error.what();
    } catch (const engine::Error& error) {
        result.status = report::Status::failed;
        result.reason = error.what();
    }
    for (const std::string& message : device.messages().take())
        result.trust.warnings.push_back("validation: " + message);
    return result;
}

}  // namespace

int compileShaders(const ShadersOptions& options) {
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const run::RunPlan plan = run::planRun(options.scene, options.filter, "", &cache.assets());
    if (plan.cases.empty()) return sayNothingMatches(options.filter);
    const std::filesystem::path out = options.out.empty() ? std::filesystem::path("results/local") /
                                                                ("shaders-" + plan.name + ".json")
                                                          : options.out;
    engine::checkWritable(out);

    engine::DeviceOptions wanted = options.scene.device;
    wanted.shader_figures = engine::ShaderFigures::required;
    const engine::Device device(wanted);
    std::cerr << report::versionOnDevice(device) << '\n';
    report::Report report{
        {.environment = report::describeEnvironment(
             device, options.command, plan.seed, options.scene.device.validation),
         .scene = plan.scene,
         .case_count = plan.case_count}};
    measure::Progress progress(plan.cases.size());
    const auto finish = [&] {
        report::writeReport(report::reportJson(report), out);
        for (const report::CaseResult& each : report.cases)
            if (each.status != report::Status::ok)
                std::cout << engine::shownText(each.name) << ": " << report::statusName(each.status)
                          << ": " << engine::shownText(each.reason) << '\n';
        std::cout << measure::shaderTable(report.cases) << "report: " << out.string() << '\n';
        if (report.interrupted)
            std::cerr << "interrupted after " << report.cases.size() << " of " << plan.cases.size()
                      << " cases\n";
    };
    const engine::InterruptMessage last_words([&] {
        report.interrupted = true;
        finish();
    });
    try {
        for (const run::PlannedCase& each : plan.cases) {
            engine::checkInterrupted();
            progress.begin(each.spec.name);
            report::CaseResult compiled = compileCase(device, each, cache);
            const engine::HeldMessages held;
            report.cases.push_back(std::move(compiled));
        }
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    engine::finishInAnyCase();
    progress.clear();
    finish();
    if (report.interrupted) return report::kInterrupted;
    const bool any_ran = std::ranges::any_of(
        report.cases, [](const auto& each) { return each.status == report::Status::ok; });
    return any_ran ? report::kOk : report::kNothingRan;
}

// ---- hairbench ablate ---------------------------------------------------------------------------

namespace {

std::vector<std::string> notesFor(const report::DeviceRecord& device) {
    std::vector<std::string> notes{"a marginal cost is the time that a stage adds to the pass, not "
                                   "the time that the stage works: stages overlap"};
    if (device.type == engine::DeviceType::cpu)
        notes.push_back("on a software device one thread makes the primitives while other threads "
                        "work on fragments");
    return notes;
}

// Adds finished cases to `cases`. `current`: the case under way, which an InterruptMessage reads.
void ablateAll(
    const engine::Device& device, const run::RunPlan& plan, std::uint32_t laps,
    measure::HairCache& cache, measure::Progress& progress, ablate::CaseAblation& current,
    std::vector<ablate::CaseAblation>& cases) {
    for (const run::PlannedCase& each : plan.cases) {
        progress.begin(each.spec.name);
        const auto update = [&](const std::string& state) { progress.update(state); };
        ablate::ablateCase(device, each.spec, each.directory, laps, update, cache, current);
        progress.clear();
        const engine::HeldMessages held;
        for (const std::string& message : device.messages().take())
            current.warnings.push_back("validation: " + message);
        std::cout << ablate::ablationTable(current) << std::endl;
        cases.push_back(std::exchange(current, {}));
    }
}

}  // namespace

int ablateScene(const AblateOptions& options) {
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const run::RunPlan plan = run::planRun(options.scene, options.filter, "", &cache.assets());
    if (plan.cases.empty()) return sayNothingMatches(options.filter);
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
    ablate::CaseAblation current;
    const auto finish = [&] {
        engine::writeFileAtomically(out, ablate::ablationText(report));
        for (const std::string& note : report.notes)
            std::cout << "note: " << engine::shownText(note) << '\n';
        std::cout << "report: " << out.string() << '\n';
    };
    const auto finish_interrupted = [&] {
        report.interrupted = true;
        if (current.attribution) {
            std::cout << ablate::ablationTable(current) << '\n';
            report.cases.push_back(current);
        }
        finish();
        std::cerr << "interrupted: " << report.cases.size() << " of " << plan.cases.size()
                  << " cases have results\n";
    };
    const engine::InterruptMessage last_words(finish_interrupted);
    try {
        ablateAll(device, plan, options.passes, cache, progress, current, report.cases);
    } catch (const engine::Interrupted&) {
        progress.clear();
        finish_interrupted();
        return report::kInterrupted;
    }
    engine::finishInAnyCase();
    finish();
    const bool any_ran = std::ranges::any_of(
        report.cases, [](const auto& each) { return each.status == report::Status::ok; });
    return any_ran ? report::kOk : report::kNothingRan;
}

// ---- hairbench lod ------------------------------------------------------------------------------

namespace {

void simulateTo(const engine::Device& device, measure::Case& hair, std::uint32_t frame) {
    engine::FrameLoop loop(device, engine::Timing::statistics);
    engine::Step step("plays frames", frame + std::uint64_t{1});
    for (std::uint32_t i = 0; i <= frame; ++i) {
        step.advance();
        loop.frame([&](engine::Passes& passes) { hair.simulate(passes); });
    }
}

void checkPath(const lod::LodPath& path, const hair::Settings& settings) {
    if (path.from >= path.to) throw engine::Error("--from", "is not below --to");
    if (path.to > double{settings.camera.far_plane})
        throw engine::Error("--to", "is beyond /camera/far_plane");
    if (!settings.render.hair) throw engine::Error("/render/hair", "is false: nothing to compare");
}

}  // namespace

int walkLod(const LodOptions& options) {
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    const hair::Settings& settings = spec.settings;
    const lod::LodPath path{.from = options.from, .to = options.to, .steps = options.steps};
    checkPath(path, settings);
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path("results/local/lod.json") : options.out;
    engine::checkWritable(out);
    if (options.reference) reference::checkReferenceTool();

    const engine::Device device(options.scene.device);
    std::cerr << report::versionOnDevice(device) << '\n';
    lod::LodReport report{
        .environment = report::describeEnvironment(
            device, options.command, scene.settings.seed, options.scene.device.validation),
        .scene =
            {.path = scene.path.generic_string(),
             .hash = report::hashText(scene.resolved.text()),
             .document = scene.resolved},
        .frame = options.frame};
    measure::Progress progress(path.steps);
    const auto finish = [&] {
        for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
        engine::writeFileAtomically(out, lod::lodReportText(report));
        std::cout << lod::lodTable(report) << "report: " << out.string() << '\n';
        if (report.interrupted)
            std::cerr << "interrupted after " << report.steps.size() << " of " << path.steps
                      << " steps\n";
    };
    const engine::InterruptMessage last_words([&] {
        report.interrupted = true;
        finish();
    });
    try {
        measure::Case hair(device, settings, scene.directory, &cache);
        simulateTo(device, hair, options.frame);
        lod::walk(
            device, hair, settings, path,
            options.clusters ? lod::LodKind::cluster : lod::LodKind::distance,
            [&](double distance) { progress.begin(report::shortNumber(distance) + " m"); },
            report.steps);
        progress.clear();
        if (options.reference) {
            {
                const engine::HeldMessages held;
                report.truth.emplace();
            }
            lod::compareWithTruth(
                device, scene, hair, settings, {.frame = options.frame, .samples = options.samples},
                cache, *report.truth);
        }
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    engine::finishInAnyCase();
    progress.clear();
    finish();
    return report.interrupted ? report::kInterrupted : report::kOk;
}

// ---- hairbench shimmer --------------------------------------------------------------------------

int measureShimmer(const ShimmerOptions& options) {
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const std::vector<run::PlannedCase> cases =
        run::planRun(options.scene, options.filter, "", &cache.assets()).cases;
    if (cases.empty()) return sayNothingMatches(options.filter);
    for (const run::PlannedCase& each : cases)
        if (!each.spec.settings.render.hair)
            throw engine::Error("/render/hair", "is false: nothing to compare");

    const engine::Device device(options.scene.device);
    std::cerr << report::versionOnDevice(device) << '\n';
    const lod::TurnPath path{.degrees = options.turn, .steps = options.steps};
    std::vector<lod::ShimmerCase> measured;
    bool interrupted = false;
    const auto finish = [&] {
        if (options.json) {
            const scene::Json document = {
                {"schema", "hairbench-shimmer/1.0.0"},
                {"scene", options.scene.scene.string()},
                {"device", device.info().name},
                {"frame", options.frame},
                {"turn", path.degrees},
                {"steps", path.steps},
                {"interrupted", interrupted},
                {"cases", lod::shimmerJson(measured)}};
            std::cout << document.dump(2, ' ', false, scene::Json::error_handler_t::replace)
                      << '\n';
        } else {
            std::cout << lod::shimmerTable(measured);
        }
        if (interrupted)
            std::cerr << "interrupted after " << measured.size() << " of " << cases.size()
                      << " cases\n";
    };
    const engine::InterruptMessage last_words([&] {
        interrupted = true;
        finish();
    });
    try {
        lod::TurnTruth truth;
        for (const run::PlannedCase& each : cases) {
            const hair::Settings& settings = each.spec.settings;
            measure::Case hair(device, settings, each.directory, &cache);
            simulateTo(device, hair, options.frame);
            const auto with_progress = [&](const std::string& what, const auto& draw) {
                measure::Progress progress(path.steps + std::size_t{1});
                draw([&](double degrees) {
                    progress.begin(what + ", " + report::shortNumber(degrees) + " degrees");
                });
                progress.clear();
            };
            std::span<const lod::Picture> pictures;
            with_progress("truth", [&](const auto& begin) {
                pictures = truth.pictures(device, hair, settings, path, begin);
            });
            with_progress(each.spec.name, [&](const auto& begin) {
                lod::ShimmerCase result{
                    .name = each.spec.name,
                    .axes = each.spec.axes,
                    .figures = lod::shimmerOf(device, hair, settings, path, pictures, begin)};
                const engine::HeldMessages held;
                measured.push_back(std::move(result));
            });
            for (const std::string& message : device.messages().take())
                std::cerr << message << '\n';
        }
    } catch (const engine::Interrupted&) {
        interrupted = true;
    }
    engine::finishInAnyCase();
    finish();
    return interrupted ? report::kInterrupted : report::kOk;
}

// ---- hairbench physics --------------------------------------------------------------------------

namespace {

constexpr std::uint64_t kSeed = 1;

}  // namespace

int checkPhysics(const PhysicsOptions& options) {
    std::vector<physics::CheckedSolver> solvers = physics::chosenSolvers(options.solvers);
    std::vector<physics::Check> checks = physics::chosenChecks(options.check);
    if (options.invariance || options.work_precision) {
        const auto instead =
            options.invariance ? physics::invarianceChecks() : physics::workChecks();
        checks.assign(instead.begin(), instead.end());
        solvers = physics::withVariants(solvers);
    }
    if (checks.empty()) {
        std::cerr << "hairbench: no check's name matches '" << options.check << "'\n";
        return report::kNothingRan;
    }
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path("results/local/physics.json") : options.out;
    engine::checkWritable(out);

    const engine::Device device(options.device);
    std::cerr << report::versionOnDevice(device) << '\n';
    physics::PhysicsReport report{
        .environment =
            report::describeEnvironment(device, options.command, kSeed, options.device.validation)};
    const auto finish = [&] {
        if (options.work_precision) physics::recommendSolvers(report);
        engine::writeFileAtomically(out, physics::physicsReportText(report));
        std::cout << physics::physicsTable(report);
        if (options.invariance) std::cout << physics::invarianceTables(report) << '\n';
        if (options.work_precision) std::cout << physics::workTables(report) << '\n';
        std::cout << "report: " << out.string() << '\n';
        if (report.interrupted) std::cerr << "interrupted\n";
    };
    const engine::InterruptMessage last_words([&] {
        report.interrupted = true;
        finish();
    });
    if (options.papers)
        physics::playPapers(device, report);
    else
        physics::runChecks(device, checks, solvers, report);
    engine::finishInAnyCase();
    finish();
    return physics::exitStatus(report);
}

}  // namespace benchmarks::commands
