#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/report/change.h"
#include "engine/files.h"
#include "engine/process.h"

namespace benchmarks::commands {

int exportScene(const ExportOptions& options) {
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    engine::checkWritable(options.mitsuba / "scene.xml");

    const engine::Device device(options.scene.device);
    try {
        const reference::MitsubaExport written = reference::exportMitsuba(
            device, scene, spec.settings, options.frame, options.mitsuba, cache);
        for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
        std::cout << (options.mitsuba / "scene.xml").string() << ": frame " << options.frame
                  << " of " << scene.name << ", " << written.strands << " strands, "
                  << written.points << " points, " << written.triangles << " triangles\n";
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: the scene is not written\n";
        return report::kInterrupted;
    }
    return report::kOk;
}

}  // namespace benchmarks::commands
