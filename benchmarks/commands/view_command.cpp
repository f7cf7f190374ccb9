#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "benchmarks/commands/commands.h"
#include "benchmarks/report/change.h"
#include "benchmarks/viewer/script/script.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/device.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "engine/window.h"

namespace benchmarks::commands {
namespace {

// Time for a picture in progress to finish when the window closes.
constexpr std::chrono::milliseconds kPatience{300};

int view(const viewer::ViewOptions& options) {
    viewer::Viewer viewer(options);
    std::optional<viewer::Script> script;
    if (!options.script.empty()) script.emplace(options.script);
    try {
        for (std::uint32_t i = 0; !engine::interrupted(); ++i) {
            if (script && !script->step(viewer)) break;
            if (!viewer.frame()) break;
            if (options.frames > 0 && i + 1 == options.frames) break;
        }
    } catch (const engine::Interrupted&) {  // during a long step
    }
    if (script && !engine::interrupted()) script->finish();
    for (const std::string& message : viewer.takeMessages()) std::cerr << message << '\n';
    if (!options.screenshot.empty()) {
        const engine::Presenter::Picture picture = viewer.picture();
        engine::writePng(options.screenshot, picture.width, picture.height, picture.pixels);
    }
    const int status = engine::interrupted() ? report::kInterrupted : report::kOk;
    if (!viewer.finish(kPatience)) {
        // Only the end of the process stops drawing that a device has begun, and the user has
        // already closed the window.
        viewer.keepPreferences();
        std::cerr.flush();
        std::cout.flush();
        std::_Exit(status);
    }
    return status;
}

}  // namespace

int viewScene(const viewer::ViewOptions& options) {
    engine::processUse();  // counts threads that start from here on, including the device's
    try {
        return view(options);
    } catch (const engine::NoDisplay& error) {
        std::cerr << "hairbench: " << error.what()
                  << "; 'hairbench render' draws pictures without one\n";
        return report::kNoDevice;
    } catch (const viewer::ScriptFailure& failure) {
        std::cerr << failure.what() << '\n';
        return report::kCheckFailed;
    } catch (const engine::DeviceLost& error) {
        std::cerr << "hairbench: the device was lost (" << error.what()
                  << "), as after a hang or a reset of its driver; unsaved changes are lost\n";
        return report::kInternalError;
    }
}

}  // namespace benchmarks::commands
