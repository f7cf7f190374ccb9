#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/recording.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "engine/files.h"
#include "engine/process.h"
#include "engine/shown_text.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {

int simulateScene(const SimulateOptions& options) {
    const groom::RecordingOptions& recording = options.recording;
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    hair::groom::strandExporterOf(recording.out);  // throws early for an unknown format
    engine::checkWritable(recording.out);

    const engine::Device device(options.scene.device);
    groom::Recorded recorded;
    try {
        recorded = groom::recordStrands(device, scene, spec.settings, recording, cache);
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return report::kInterrupted;
    }
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    for (const std::string& warning : recorded.warnings)
        std::cerr << engine::shownText(warning) << '\n';
    const std::string last = std::to_string(recording.frames - 1);
    std::error_code no_size;  // for a pipe
    const std::uintmax_t size = std::filesystem::file_size(recording.out, no_size);
    std::cout << engine::shownText(recording.out.string()) << ": " << recorded.strands.strandCount()
              << " strands, " << recorded.strands.points.size() << " points, "
              << (groom::holdsFrames(recording.out) ? "frames 0 to " + last
                                                    : "frame " + last + ", the last,")
              << " of " << scene.name << (no_size ? "" : ", " + report::sizeText(size)) << '\n';
    return report::kOk;
}

}  // namespace benchmarks::commands
