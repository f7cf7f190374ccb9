#include <algorithm>
#include <iostream>
#include <regex>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/report.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {
namespace {

using physics::Check;
using physics::Findings;
using physics::Outcome;
using physics::PhysicsReport;
using physics::Verdict;

constexpr std::uint64_t kSeed = 1;

std::vector<hair::Solver> chosenSolvers(const std::vector<std::string>& names) {
    std::vector<hair::Solver> solvers;
    std::vector<std::string> known;
    for (const auto& each : physics::checkedSolvers()) {
        known.emplace_back(each.name);
        if (names.empty() || std::ranges::find(names, each.name) != names.end())
            solvers.push_back(each.value);
    }
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw engine::Error(
                "--solver " + name, scene::unknownName("unknown solver", name, known));
    return solvers;
}

std::vector<physics::Check> chosenChecks(const std::string& regex) {
    std::vector<physics::Check> chosen;
    try {
        const std::regex pattern(regex, std::regex::ECMAScript);
        for (const physics::Check& check : physics::allChecks())
            if (std::regex_search(check.name, pattern)) chosen.push_back(check);
    } catch (const std::regex_error& error) {
        throw engine::Error("--check " + regex, error.what());
    }
    return chosen;
}

// A check that can't be carried out is part of the result, and the suite goes on. Where the user
// stops it, what it found out so far is kept.
void runCheck(
    const engine::Device& device, const physics::Check& check, hair::Solver solver,
    physics::PhysicsReport& report) {
    physics::Findings findings(check.name, solver);
    try {
        check.run(device, solver, findings);
    } catch (const engine::Unsupported& error) {
        findings.skip(error.what());
    } catch (const engine::Error& error) {
        findings.fail(error.what());
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    for (const std::string& message : device.messages().take())
        findings.fail("validation: " + message);
    std::ranges::copy(findings.outcomes(), std::back_inserter(report.outcomes));
    std::ranges::copy(findings.curves(), std::back_inserter(report.curves));
}

int statusOf(const physics::PhysicsReport& report) {
    if (report.interrupted) return report::kInterrupted;
    const auto has = [&](physics::Verdict verdict) {
        return std::ranges::find(report.outcomes, verdict, &physics::Outcome::verdict) !=
               report.outcomes.end();
    };
    if (has(physics::Verdict::fail)) return report::kCheckFailed;
    return has(physics::Verdict::pass) || has(physics::Verdict::reported) ? report::kOk
                                                                          : report::kNothingRan;
}

}  // namespace

int checkPhysics(const PhysicsOptions& options) {
    const std::vector<hair::Solver> solvers = chosenSolvers(options.solvers);
    const std::vector<physics::Check> checks = chosenChecks(options.check);
    if (checks.empty()) {
        std::cerr << "hairbench: no check's name matches '" << options.check << "'\n";
        return report::kNothingRan;
    }
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path("results/local/physics.json") : options.out;
    engine::checkWritable(out);

    engine::catchInterrupts();
    const engine::Device device(options.device);
    std::cerr << report::versionText() << " on " << device.info().name << " ("
              << device.info().driver << ' ' << device.info().driver_version << ")\n";
    physics::PhysicsReport report{
        .environment =
            report::describeEnvironment(device, options.command, kSeed, options.device.validation),
        .outcomes = {},
        .curves = {}};
    measure::Progress progress(checks.size() * solvers.size());
    for (const physics::Check& check : checks)
        for (const hair::Solver solver : solvers) {
            if (report.interrupted) break;
            progress.begin(std::string(check.name) + ", " + physics::nameOf(solver));
            runCheck(device, check, solver, report);
        }
    progress.clear();
    engine::writeFileAtomically(out, physics::physicsReportText(report));
    std::cout << physics::physicsTable(report) << "report: " << out.string() << '\n';
    if (report.interrupted) std::cerr << "interrupted\n";
    return statusOf(report);
}

}  // namespace benchmarks::commands
