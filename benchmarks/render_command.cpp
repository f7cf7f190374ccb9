#include <iostream>

#include "benchmarks/case.h"
#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/report.h"
#include "engine/write_file.h"
#include "engine/image_file.h"

namespace benchmarks {

int renderScene(const RenderOptions& options) {
    Scene scene = loadScene(options.scene.scene);
    scene.axes.clear();  // the scene's own settings, with what the command line changes
    const std::vector<CaseSpec> cases = selectCases(scene, options.scene);
    engine::checkWritable(options.out);
    const hair::Settings& settings = cases.front().settings;

    const engine::Device device(options.scene.device);
    Case picture(device, settings, scene.directory);
    {
        engine::FrameLoop loop(device, engine::Timing::isolated);
        for (std::uint32_t i = 0; i <= options.frame; ++i) {
            loop.frame([&](engine::Passes& passes) { picture.frame(passes); });
        }
    }
    engine::writePng(options.out, settings.render.width, settings.render.height, picture.picture());
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    std::cout << options.out.string() << ": frame " << options.frame << " of " << scene.name << ", "
              << settings.render.width << " x " << settings.render.height << " px, image "
              << picture.pictureHash() << '\n';
    return kOk;
}

}  // namespace benchmarks
