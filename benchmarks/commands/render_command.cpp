#include <functional>
#include <iostream>
#include <optional>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/measure/start.h"
#include "benchmarks/report/change.h"
#include "benchmarks/scene/frames.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "engine/shown_text.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {
namespace {

bool isLinear(const std::filesystem::path& file) {
    return hair::groom::lowerCaseExtension(file) == ".exr";
}

void checkFormat(const std::filesystem::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    if (extension.empty() || extension == ".png" || extension == ".exr") return;
    throw engine::Error(file.string(), "is neither .png nor .exr");
}

void writePicture(
    const measure::Case& picture, const hair::RenderSettings& render,
    const std::filesystem::path& file) {
    if (isLinear(file)) {
        engine::writeExr(file, render.width, render.height, picture.radiance());
    } else {
        engine::writePng(file, render.width, render.height, picture.picture());
    }
}

// Plays a case from its first frame, one step of `progress` per frame, and draws the frames of the
// range. Calls `drawn` after each drawn frame.
void play(
    const engine::Device& device, measure::Case& picture, const scene::FrameRange& range,
    measure::Progress& progress, const std::function<void(std::uint32_t)>& drawn) {
    engine::FrameLoop loop(device, engine::Timing::isolated);
    for (std::uint32_t i = 0; i < range.end; ++i) {
        engine::checkInterrupted();
        const bool draws = range.holds(i);
        progress.begin((draws ? "draws frame " : "plays frame ") + std::to_string(i));
        loop.frame([&](engine::Passes& passes) {
            draws ? picture.frame(passes) : picture.simulate(passes);
        });
        if (draws) drawn(i);
    }
}

}  // namespace

int renderScene(const RenderOptions& options) {
    scene::FrameRange range{.first = options.frame, .end = options.frame + 1};
    std::optional<scene::FramePaths> paths;
    if (!options.frames.empty()) {
        range = scene::parseFrameRange(options.frames);
        paths.emplace(options.out);
        if (!paths->hasNumber() && range.count() > 1)
            throw engine::Error(
                options.out.string(),
                "needs a place for the number of the frame, as in out/%04d.png");
    }
    const auto file = [&](std::uint32_t frame) { return paths ? paths->of(frame) : options.out; };
    checkFormat(file(range.first));

    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene, &cache.assets());
    engine::checkWritable(file(range.first));
    const hair::RenderSettings& render = spec.settings.render;

    const engine::Device device(options.scene.device);
    measure::Case picture(device, spec.settings, scene.directory, &cache);
    for (const std::string& warning : measure::inspectStart(picture).warnings)
        std::cerr << "hairbench: " << engine::shownText(warning) << '\n';
    measure::Progress progress(range.end);
    std::uint32_t written = 0;
    const auto say_interrupted = [&] {
        std::cerr << "interrupted: " << written << " of " << range.count()
                  << " pictures are written\n";
    };
    const engine::InterruptMessage last_words(say_interrupted);
    try {
        play(device, picture, range, progress, [&](std::uint32_t frame) {
            writePicture(picture, render, file(frame));
            ++written;
        });
    } catch (const engine::Interrupted&) {
        progress.clear();
        say_interrupted();
        return report::kInterrupted;
    }
    progress.clear();
    for (const std::string& warning : picture.warnings())
        std::cerr << "hairbench: " << engine::shownText(warning) << '\n';
    for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
    if (const std::string text = measure::droppedFragments(picture); !text.empty())
        std::cerr << "hairbench: " << text << '\n';
    std::cout << engine::shownText(options.out.string()) << ": ";
    if (range.count() > 1) {
        std::cout << range.count() << " pictures, frames " << range.first << " to "
                  << range.first + (range.count() - 1) * range.step;
    } else {
        std::cout << "frame " << range.first;
    }
    std::cout << " of " << scene.name << ", " << render.width << " x " << render.height
              << " px, image " << picture.pictureHash() << '\n';
    return report::kOk;
}

}  // namespace benchmarks::commands
