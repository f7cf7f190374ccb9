#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/lod/walk.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/environment.h"
#include "benchmarks/report/text.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {
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
            {.path = scene.path.string(),
             .hash = report::hashText(scene.resolved.text()),
             .document = scene.resolved},
        .frame = options.frame};
    measure::Progress progress(path.steps);
    const auto finish = [&] {
        progress.clear();
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
            [&](double distance) { progress.begin(report::shortNumber(distance) + " m"); },
            report.steps);
        progress.clear();
        if (options.reference)
            lod::compareWithTruth(
                device, scene, hair, settings, {.frame = options.frame, .samples = options.samples},
                cache, report.truth.emplace());
    } catch (const engine::Interrupted&) {
        report.interrupted = true;
    }
    finish();
    return report.interrupted ? report::kInterrupted : report::kOk;
}

}  // namespace benchmarks::commands
