#include <algorithm>
#include <cstdio>
#include <functional>
#include <iomanip>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "benchmarks/commands/commands.h"
#include "benchmarks/groom/recording.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/hair_cache.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "benchmarks/report/text.h"
#include "benchmarks/scene/pattern.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "engine/process.h"
#include "hair/groom/files.h"
#include "hair/simulation/probes.h"

namespace benchmarks::commands {

// ---- hairbench render ---------------------------------------------------------------------------

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

// ---- hairbench reference ------------------------------------------------------------------------

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

// ---- hairbench export ---------------------------------------------------------------------------

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

// ---- hairbench diff -----------------------------------------------------------------------------

namespace {

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return text;
}

scene::Json toJson(const reference::PictureErrors& errors) {
    return {{"width", errors.width},
            {"height", errors.height},
            {"rmse", errors.rmse},
            {"psnr_db", errors.psnr ? scene::Json(*errors.psnr) : scene::Json()},
            {"ssim", errors.ssim},
            {"flip", errors.flip}};
}

}  // namespace

int diffPictures(const DiffOptions& options) {
    if (!options.out.empty()) engine::checkWritable(options.out);
    const reference::PictureErrors errors =
        reference::comparePictures(options.reference, options.picture, options.out);
    if (options.json) {
        std::cout << toJson(errors).dump(2) << '\n';
        return report::kOk;
    }
    std::cout << engine::shownText(options.picture.string()) << " against "
              << engine::shownText(options.reference.string()) << ", " << errors.width << " x "
              << errors.height << " px\n"
              << "RMSE  " << figure(errors.rmse) << '\n'
              << "PSNR  " << (errors.psnr ? figure(*errors.psnr) : "infinite") << " dB\n"
              << "SSIM  " << figure(errors.ssim) << '\n'
              << "FLIP  " << figure(errors.flip) << '\n';
    return report::kOk;
}

// ---- hairbench simulate -------------------------------------------------------------------------

namespace {

constexpr std::string_view kCasePlace = "{case}";

// The name of a case's file: "{case}" stands for its values of axes, "msaa-1_stiffness-0.1".
std::filesystem::path
fileOf(const std::filesystem::path& pattern, const scene::Scene& scene, const std::string& name) {
    std::string text = name == scene.name ? name : name.substr(scene.name.size() + 1);
    for (char& each : text) {
        if (each == '/') each = '_';
        if (std::string_view(":\\\"*?<>|").find(each) != std::string_view::npos) each = '-';
    }
    std::string file = pattern.string();
    for (std::size_t at = 0; (at = file.find(kCasePlace, at)) != file.npos; at += text.size())
        file.replace(at, kCasePlace.size(), text);
    return file;
}

void recordCase(
    const engine::Device& device, const scene::Scene& scene, const scene::CaseSpec& spec,
    const groom::RecordingOptions& recording, measure::HairCache& cache) {
    const groom::Recorded recorded =
        groom::recordStrands(device, scene, spec.settings, recording, cache);
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
              << " of " << engine::shownText(spec.name)
              << (no_size ? "" : ", " + report::sizeText(size)) << '\n';
}

// Writes a table with a row for each frame of each case, and a column for each probe of any case,
// as RFC 4180 has it.
void writeProbes(
    const engine::Device& device, const scene::Scene& scene,
    const std::vector<scene::CaseSpec>& specs, const SimulateOptions& options,
    measure::HairCache& cache) {
    std::vector<measure::PlayedProbes> played;
    std::vector<std::string> names;
    for (const scene::CaseSpec& spec : specs) {
        if (!hair::simulation::hasProbes(spec.settings.run.probes))
            throw engine::Error("--probes", spec.name + " asks for none: see /run/probes");
        measure::Case test_case(device, spec.settings, scene.directory, &cache);
        played.push_back(measure::playProbes(device, test_case, options.recording.frames, [] {
            engine::checkInterrupted();
            return false;
        }));
        for (const std::string& name : played.back().names)
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    std::ostringstream table;
    table.precision(9);  // enough for 32 bits
    table << "case,frame,probe.time";
    for (const std::string& name : names) table << ',' << name;
    table << '\n';
    for (std::size_t i = 0; i < specs.size(); ++i) {
        const measure::PlayedProbes& probes = played[i];
        for (std::size_t frame = 0; frame < probes.times.size(); ++frame) {
            table << std::quoted(specs[i].name, '"', '"') << ',' << frame << ','
                  << probes.times[frame];
            for (const std::string& name : names) {
                table << ',';
                const auto found = std::ranges::find(probes.names, name);
                if (found != probes.names.end())
                    table << probes.values[static_cast<std::size_t>(found - probes.names.begin())]
                                          [frame];
            }
            table << '\n';
        }
    }
    engine::writeFileAtomically(options.probes, table.str());
    std::cout << engine::shownText(options.probes.string()) << ": " << names.size()
              << " probes, frames 0 to " << options.recording.frames << " of " << specs.size()
              << (specs.size() == 1 ? " case\n" : " cases\n");
}

}  // namespace

int simulateScene(const SimulateOptions& options) {
    const std::filesystem::path& out = options.recording.out;
    if (out.empty() && options.probes.empty())
        throw engine::Error("simulate", "needs --export or --probes");
    scene::Scene scene = scene::loadScene(options.scene.scene, options.scene.outside);
    measure::HairCache cache = measure::userHairCache(options.scene.cache);
    // Throws early for an unknown format.
    if (!out.empty() && !groom::isArray(out)) hair::groom::strandExporterOf(out);
    std::vector<scene::CaseSpec> specs;
    if (out.empty() || out.string().find(kCasePlace) != std::string::npos) {
        specs = scene::selectCases(scene, options.scene, &cache.assets());
    } else {
        specs.push_back(scene::singleCase(scene, options.scene, &cache.assets()));
        specs.front().name = scene.name;
    }
    std::vector<groom::RecordingOptions> recordings;
    std::set<std::filesystem::path> files;
    for (const scene::CaseSpec& spec : specs) {
        if (out.empty()) break;
        groom::RecordingOptions& recording = recordings.emplace_back(options.recording);
        recording.out = fileOf(out, scene, spec.name);
        engine::checkWritable(recording.out);
        if (!files.insert(recording.out).second)
            throw engine::Error(recording.out.string(), "is the file of two cases");
    }

    if (!options.probes.empty()) engine::checkWritable(options.probes);

    const engine::Device device(options.scene.device);
    try {
        for (std::size_t i = 0; i < recordings.size(); ++i)
            recordCase(device, scene, specs[i], recordings[i], cache);
        if (!options.probes.empty()) writeProbes(device, scene, specs, options, cache);
    } catch (const engine::Interrupted&) {
        std::cerr
            << (specs.size() == 1 ? "interrupted: nothing is written\n"
                                  : "interrupted: only finished cases are written\n");
        return report::kInterrupted;
    }
    return report::kOk;
}

}  // namespace benchmarks::commands
