#include <iostream>

#include "benchmarks/commands.h"
#include "benchmarks/doctor/checks.h"
#include "benchmarks/doctor/doctor_report.h"
#include "benchmarks/doctor/doctor_scene.h"
#include "benchmarks/doctor/gather_facts.h"
#include "benchmarks/environment.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "engine/process_use.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

constexpr std::uint32_t kPlantedGates = 10;

// In this process, whose device is gone when others measure theirs.
void examineDevice(const DoctorOptions& options, DoctorReport& report) {
    engine::processUse();  // counts threads that start from here on
    const engine::Device device(options.device);
    std::cerr << versionText() << " on " << device.info().name << " (" << device.info().driver
              << ' ' << device.info().driver_version << ")\n";
    report.environment = describeEnvironment(
        device, options.command, doctorSettings().seed, options.device.validation);
    const MeasureHooks hooks{.stop = interrupted};
    report.findings = judgeAll(gatherFacts(device, options.device.validation, hooks));
}

void examineGates(const DoctorOptions& options, DoctorReport& report) {
    if (options.pairs == 0) return;
    std::cerr << "measuring " << options.pairs << " pairs of processes\n";
    report.sensitivities = measureSensitivity(options.device, options.pairs);
    if (!options.planted) return;
    std::cerr << "looking for " << kPlantedGates << " planted slowdowns\n";
    report.planted = plantSlowdowns(options.device, report.sensitivities, kPlantedGates);
    report.findings.push_back(judgePlanted(report.planted));
}

}  // namespace

int examineMachine(const DoctorOptions& options) {
    if (options.planted && options.pairs == 0)
        throw engine::Error("--planted", "needs --pairs: how large a slowdown to plant");
    if (!options.out.empty()) engine::checkWritable(options.out);
    catchInterrupts();
    DoctorReport report;
    try {
        examineDevice(options, report);
        examineGates(options, report);
    } catch (const Interrupted&) {
        report.interrupted = true;
    }
    if (!report.findings.empty()) {
        if (!options.out.empty())
            engine::writeFileAtomically(options.out, doctorReportText(report));
        std::cout << doctorText(report);
        if (!options.out.empty()) std::cout << "report: " << options.out.string() << '\n';
    }
    if (report.interrupted) {
        std::cerr << "interrupted\n";
        return kInterrupted;
    }
    return isTrusted(report) ? kOk : kCheckFailed;
}

}  // namespace benchmarks
