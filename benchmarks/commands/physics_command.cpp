#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/physics/checks.h"
#include "benchmarks/physics/report.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {
namespace {

constexpr std::uint64_t kSeed = 1;

}  // namespace

int checkPhysics(const PhysicsOptions& options) {
    const std::vector<hair::Solver> solvers = physics::chosenSolvers(options.solvers);
    const std::vector<physics::Check> checks = physics::chosenChecks(options.check);
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
            report::describeEnvironment(device, options.command, kSeed, options.device.validation),
        .outcomes = {},
        .curves = {}};
    const auto finish = [&] {
        engine::writeFileAtomically(out, physics::physicsReportText(report));
        std::cout << physics::physicsTable(report) << "report: " << out.string() << '\n';
        if (report.interrupted) std::cerr << "interrupted\n";
    };
    const engine::InterruptMessage last_words([&] {
        report.interrupted = true;
        finish();
    });
    physics::runChecks(device, checks, solvers, report);
    finish();
    return physics::exitStatus(report);
}

}  // namespace benchmarks::commands
