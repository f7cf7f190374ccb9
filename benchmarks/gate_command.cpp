#include <filesystem>
#include <iostream>

#include <nlohmann/json.hpp>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/gate/gate_report.h"
#include "benchmarks/gate/gate_session.h"
#include "benchmarks/interrupt.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

std::filesystem::path reportFile(const GateOptions& options) {
    if (!options.out.empty()) return options.out;
    return std::filesystem::path("results/local") /
           ("gate-" + options.scene.scene.stem().string() + ".json");
}

void printEnd(const GateRun& run) {
    if (run.end == GateRun::End::failed)
        std::cerr << "hairbench: " << run.failure << '\n';
    else if (run.end == GateRun::End::interrupted)
        std::cerr << "interrupted after " << run.pairs << (run.pairs == 1 ? " pair\n" : " pairs\n");
    else if (run.mismatches.empty() && run.changes.empty())
        std::cerr << "hairbench: no case ran in both that has a time to judge\n";
    else if (run.mismatches.empty())
        std::cout << "verdict: " << verdictName(overallVerdict(run)) << '\n';
}

}  // namespace

int gateBuilds(const GateOptions& options) {
    const std::filesystem::path out = reportFile(options);
    engine::checkWritable(out);
    catchInterrupts();
    const GateRun run = runGate(options);
    // What drivers and commands say need not be UTF-8.
    engine::writeFileAtomically(
        out, gateReport(run, options.verdict, options.command)
                     .dump(1, ' ', false, Json::error_handler_t::replace) +
                 '\n');
    std::cout << gateText(run) << "report: " << out.string() << '\n';
    printEnd(run);
    return exitStatus(run, options.verdict);
}

}  // namespace benchmarks
