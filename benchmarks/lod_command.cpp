#include <iostream>

#include "benchmarks/commands.h"
#include "benchmarks/environment.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/hash.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/lod_report.h"
#include "benchmarks/lod_walk.h"
#include "benchmarks/progress.h"
#include "benchmarks/table.h"
#include "engine/error.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

void simulateTo(const engine::Device& device, Case& hair, std::uint32_t frame) {
    engine::FrameLoop loop(device, engine::Timing::statistics);
    for (std::uint32_t i = 0; i <= frame; ++i) {
        checkInterrupted();
        loop.frame([&](engine::Passes& passes) { hair.simulate(passes); });
    }
}

void checkPath(const LodPath& path, const hair::Settings& settings) {
    if (path.from >= path.to) throw engine::Error("--from", "is not below --to");
    if (path.to > double{settings.camera.far_plane})
        throw engine::Error("--to", "is beyond /camera/far_plane");
    if (!settings.render.hair) throw engine::Error("/render/hair", "is false: nothing to compare");
}

}  // namespace

int walkLod(const LodOptions& options) {
    Scene scene = loadScene(options.scene.scene);
    const CaseSpec spec = singleCase(scene, options.scene);
    const hair::Settings& settings = spec.settings;
    const LodPath path{.from = options.from, .to = options.to, .steps = options.steps};
    checkPath(path, settings);
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path("results/local/lod.json") : options.out;
    engine::checkWritable(out);

    catchInterrupts();
    const engine::Device device(options.scene.device);
    std::cerr << versionText() << " on " << device.info().name << " (" << device.info().driver
              << ' ' << device.info().driver_version << ")\n";
    LodReport report{
        .environment = describeEnvironment(
            device, options.command, scene.settings.seed, options.scene.device.validation),
        .scene =
            {.path = scene.path.string(),
             .hash = hashText(scene.resolved.text()),
             .document = scene.resolved},
        .frame = options.frame};
    Progress progress(path.steps);
    try {
        Case hair(device, settings, scene.directory);
        simulateTo(device, hair, options.frame);
        walk(
            device, hair, settings, path,
            [&](double distance) { progress.begin(shortNumber(distance) + " m"); }, report.steps);
    } catch (const Interrupted&) {
        report.interrupted = true;
    }
    progress.clear();
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    engine::writeFileAtomically(out, lodReportText(report));
    std::cout << lodTable(report) << "report: " << out.string() << '\n';
    if (!report.interrupted) return kOk;
    std::cerr << "interrupted after " << report.steps.size() << " of " << path.steps << " steps\n";
    return kInterrupted;
}

}  // namespace benchmarks
