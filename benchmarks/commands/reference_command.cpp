#include <iostream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {

int renderReference(const ReferenceOptions& options) {
    const std::string extension = hair::groom::lowerCaseExtension(options.out);
    if (extension != ".exr" && extension != ".png")
        throw engine::Error(options.out.string(), "is neither .png nor .exr");
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    const hair::Settings& settings = spec.settings;
    engine::checkWritable(options.out);
    reference::checkReferenceTool();

    try {
        const engine::ScratchFolder folder;
        {
            const engine::Device device(options.scene.device);
            reference::exportMitsuba(device, scene, settings, options.frame, folder.path(), cache);
            for (const std::string& message : device.messages().take())
                std::cerr << message << '\n';
        }
        reference::traceMitsuba(folder.path(), options.samples, options.out);
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return report::kInterrupted;
    }
    std::cout << options.out.string() << ": frame " << options.frame << " of " << scene.name << ", "
              << settings.render.width << " x " << settings.render.height << " px, "
              << options.samples << " samples per pixel\n";
    return report::kOk;
}

}  // namespace benchmarks::commands
