#include <functional>
#include <iostream>
#include <optional>

#include "benchmarks/case.h"
#include "benchmarks/commands.h"
#include "benchmarks/dropped_fragments.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/frame_path.h"
#include "benchmarks/frame_range.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/progress.h"
#include "engine/image_file.h"
#include "engine/write_file.h"
#include "hair/groom/file_extension.h"

namespace benchmarks {
namespace {

bool isLinear(const std::filesystem::path& file) {
    return hair::lowerCaseExtension(file) == ".exr";
}

void checkFormat(const std::filesystem::path& file) {
    const std::string extension = hair::lowerCaseExtension(file);
    if (extension.empty() || extension == ".png" || extension == ".exr") return;
    throw engine::Error(file.string(), "pictures are .png or .exr");
}

void writePicture(
    const Case& picture, const hair::RenderSettings& render, const std::filesystem::path& file) {
    if (isLinear(file)) {
        engine::writeExr(file, render.width, render.height, picture.radiance());
    } else {
        engine::writePng(file, render.width, render.height, picture.picture());
    }
}

// Plays a case from its first frame and draws those of the range; `drawn` is called after each.
void play(
    const engine::Device& device, Case& picture, const FrameRange& range,
    const std::function<void(std::uint32_t)>& drawn) {
    engine::FrameLoop loop(device, engine::Timing::isolated);
    for (std::uint32_t i = 0; i < range.end; ++i) {
        checkInterrupted();
        const bool draws = range.holds(i);
        loop.frame([&](engine::Passes& passes) {
            draws ? picture.frame(passes) : picture.simulate(passes);
        });
        if (draws) drawn(i);
    }
}

}  // namespace

int renderScene(const RenderOptions& options) {
    FrameRange range{.first = options.frame, .end = options.frame + 1};
    std::optional<FramePaths> paths;
    if (!options.frames.empty()) {
        range = parseFrameRange(options.frames);
        paths.emplace(options.out);
        if (!paths->hasNumber() && range.count() > 1)
            throw engine::Error(options.out.string(), "needs a number, as in out/%04d.png");
    }
    const auto file = [&](std::uint32_t frame) { return paths ? paths->of(frame) : options.out; };
    checkFormat(file(range.first));

    Scene scene = loadScene(options.scene.scene);
    const CaseSpec spec = singleCase(scene, options.scene);
    engine::checkWritable(file(range.first));
    const hair::RenderSettings& render = spec.settings.render;

    const engine::Device device(options.scene.device);
    Case picture(device, spec.settings, scene.directory);
    catchInterrupts();
    Progress progress(range.count());
    std::uint32_t written = 0;
    try {
        play(device, picture, range, [&](std::uint32_t frame) {
            if (paths) progress.begin("frame " + std::to_string(frame));
            writePicture(picture, render, file(frame));
            ++written;
        });
    } catch (const Interrupted&) {
        progress.clear();
        std::cerr << "interrupted: " << written << " of " << range.count()
                  << " pictures are written\n";
        return kInterrupted;
    }
    progress.clear();
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    if (const std::string text = droppedFragments(picture); !text.empty())
        std::cerr << "hairbench: " << text << '\n';
    std::cout << options.out.string() << ": ";
    if (range.count() > 1) {
        std::cout << range.count() << " pictures, frames " << range.first << " to "
                  << range.first + (range.count() - 1) * range.step;
    } else {
        std::cout << "frame " << range.first;
    }
    std::cout << " of " << scene.name << ", " << render.width << " x " << render.height
              << " px, image " << picture.pictureHash() << '\n';
    return kOk;
}

}  // namespace benchmarks
