#include <iostream>
#include <optional>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/viewer/script/script.h"
#include "benchmarks/viewer/viewer.h"
#include "engine/device_lost.h"
#include "engine/image_file.h"
#include "engine/process_use.h"
#include "engine/window.h"

namespace benchmarks {

namespace {

int view(const ViewOptions& options) {
    Viewer viewer(options);
    std::optional<Script> script;
    if (!options.script.empty()) script.emplace(options.script);
    for (std::uint32_t i = 0; !interrupted(); ++i) {
        if (script && !script->step(viewer)) break;
        if (!viewer.frame()) break;
        if (options.frames > 0 && i + 1 == options.frames) break;
    }
    if (script && !interrupted()) script->finish();
    for (const std::string& message : viewer.takeMessages()) std::cerr << message << '\n';
    if (!options.screenshot.empty()) {
        const engine::Presenter::Picture picture = viewer.picture();
        engine::writePng(options.screenshot, picture.width, picture.height, picture.pixels);
    }
    return interrupted() ? kInterrupted : kOk;
}

}  // namespace

int viewScene(const ViewOptions& options) {
    catchInterrupts();
    engine::processUse();  // counts the threads that begin from here on: those of the device too
    try {
        return view(options);
    } catch (const engine::NoDisplay& error) {
        std::cerr << "hairbench: " << error.what()
                  << "; 'hairbench render' draws pictures without one\n";
        return kNoDevice;
    } catch (const ScriptFailure& failure) {
        std::cerr << failure.what() << '\n';
        return kCheckFailed;
    } catch (const engine::DeviceLost& error) {
        std::cerr << "hairbench: the device was lost (" << error.what()
                  << "): its driver gave up, as after a hang or a reset; what was not saved is "
                     "gone\n";
        return kInternalError;
    }
}

}  // namespace benchmarks
