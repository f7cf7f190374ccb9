#include <filesystem>
#include <iostream>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/gate/report.h"
#include "benchmarks/gate/session.h"
#include "benchmarks/report/change.h"
#include "engine/files.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {
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

}  // namespace

int gateBuilds(const gate::GateOptions& options) {
    const std::filesystem::path out = reportFile(options);
    engine::checkWritable(out);
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

}  // namespace benchmarks::commands
