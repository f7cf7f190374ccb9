#include <iostream>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/mitsuba_export.h"
#include "engine/write_file.h"

namespace benchmarks {

int exportScene(const ExportOptions& options) {
    Scene scene = loadScene(options.scene.scene);
    const CaseSpec spec = singleCase(scene, options.scene);
    engine::checkWritable(options.mitsuba / "scene.xml");

    const engine::Device device(options.scene.device);
    catchInterrupts();
    try {
        const MitsubaExport written =
            exportMitsuba(device, scene, spec.settings, options.frame, options.mitsuba);
        for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
        std::cout << (options.mitsuba / "scene.xml").string() << ": frame " << options.frame
                  << " of " << scene.name << ", " << written.strands << " strands, "
                  << written.points << " points, " << written.triangles << " triangles\n";
    } catch (const Interrupted&) {
        std::cerr << "interrupted: the scene is not written\n";
        return kInterrupted;
    }
    return kOk;
}

}  // namespace benchmarks
