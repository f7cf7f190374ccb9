#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/facts.h"
#include "benchmarks/doctor/play_pairs.h"
#include "benchmarks/doctor/report.h"
#include "benchmarks/doctor/reports.h"
#include "benchmarks/doctor/rules.h"
#include "benchmarks/measure/machine_watch.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/report.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/shown_text.h"

namespace benchmarks::commands {
namespace {

constexpr std::uint32_t kPlantedGates = 10;

// Runs in this process, but releases its device before other processes measure.
void examineDevice(const DoctorOptions& options, doctor::DoctorReport& report) {
    engine::processUse();  // counts threads that start from here on
    const engine::Device device(options.device);
    std::cerr << report::versionOnDevice(device) << '\n';
    report.environment = report::describeEnvironment(
        device, options.command, doctor::doctorSettings().seed, options.device.validation);
    measure::addBoard(device.info(), report.environment.device);
    const measure::MeasureHooks hooks{.stop = engine::interrupted};
    const engine::Step step("examines the machine");
    report.findings =
        doctor::judgeAll(doctor::gatherFacts(device, options.device.validation, hooks));
}

void examineGates(const DoctorOptions& options, doctor::DoctorReport& report) {
    if (options.pairs == 0) return;
    std::cerr << "measuring " << options.pairs << " pairs of processes\n";
    report.sensitivities = doctor::measureSensitivity(options.device, options.pairs);
    if (!options.planted) return;
    std::cerr << "looking for " << kPlantedGates << " planted slowdowns\n";
    report.planted = doctor::plantSlowdowns(options.device, report.sensitivities, kPlantedGates);
    report.findings.push_back(doctor::judgePlanted(report.planted));
}

int examineReports(const std::vector<std::filesystem::path>& reports) {
    int status = report::kOk;
    for (const std::filesystem::path& path : reports) {
        if (path.string().ends_with(".schema.json")) continue;  // results/*.json matches it too
        std::string said;
        bool accepted = false;
        try {
            const doctor::ReportExamination examination = doctor::examineReport(path);
            accepted = doctor::isAccepted(examination);
            said = engine::shownText(path.string()) + ": " + doctor::examinationText(examination);
        } catch (const engine::Error& error) {
            said = shortMessage(error);
        }
        (accepted ? std::cout : std::cerr) << said << '\n';
        if (!accepted) status = report::kCheckFailed;
    }
    return status;
}

}  // namespace

int examineMachine(const DoctorOptions& options) {
    if (!options.reports.empty()) return examineReports(options.reports);
    if (!options.rules.empty()) {
        const std::vector<doctor::RuleFinding> findings =
            doctor::judgeRules(report::readReport(options.rules));
        std::cout << doctor::rulesText(findings);
        return doctor::meetsRules(findings) ? report::kOk : report::kCheckFailed;
    }
    if (options.planted && options.pairs == 0)
        throw engine::Error(
            "--planted", "needs --pairs, which estimate how large a slowdown to plant");
    if (!options.out.empty()) engine::checkWritable(options.out);
    doctor::DoctorReport report;
    const auto finish = [&] {
        if (!report.findings.empty()) {
            if (!options.out.empty())
                engine::writeFileAtomically(options.out, doctor::doctorReportText(report));
            std::cout << doctor::doctorText(report);
            if (!options.out.empty()) std::cout << "report: " << options.out.string() << '\n';
        }
        if (report.interrupted) std::cerr << "interrupted\n";
    };
    const engine::InterruptMessage last_words([&] {
        report.interrupted = true;
        finish();
    });
    try {
        examineDevice(options, report);
        examineGates(options, report);
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    finish();
    if (report.interrupted) return report::kInterrupted;
    return doctor::isTrusted(report) ? report::kOk : report::kCheckFailed;
}

}  // namespace benchmarks::commands
