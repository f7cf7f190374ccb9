#include <functional>
#include <iostream>
#include <optional>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/case.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/report/change.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/usd_export.h"

namespace benchmarks::commands {
namespace {

// What a file holds, for the closing line.
struct Written {
    hair::groom::StrandSet strands;  // of its first frame
    std::vector<std::string> warnings;
};

class Recording {
public:
    Recording(
        const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
        const SimulateOptions& options)
        : device_(device), scene_(scene), settings_(settings), options_(options),
          case_(device, settings, scene.directory) {}

    Written everyFrame();
    Written lastFrame();

private:
    // Plays the frames without drawing them; `after` is called with the number of each.
    void play(const std::function<void(std::uint32_t)>& after);
    hair::groom::StrandSet strands() const;

    const engine::Device& device_;
    const scene::Scene& scene_;
    const hair::Settings& settings_;
    const SimulateOptions& options_;
    measure::Case case_;
};

void Recording::play(const std::function<void(std::uint32_t)>& after) {
    engine::FrameLoop loop(device_, engine::Timing::statistics);
    measure::Progress progress(options_.frames);
    try {
        for (std::uint32_t i = 0; i < options_.frames; ++i) {
            engine::checkInterrupted();
            progress.begin("frame " + std::to_string(i));
            loop.frame([&](engine::Passes& passes) { case_.simulate(passes); });
            after(i);
        }
    } catch (...) {
        progress.clear();
        throw;
    }
    progress.clear();
}

hair::groom::StrandSet Recording::strands() const {
    hair::groom::StrandSet strands = options_.guides
                                         ? measure::guideStrands(case_.groom(), case_.guides())
                                         : measure::drawnStrands(case_.strands());
    if (strands.ends.empty())
        throw engine::Error(scene_.path.string(), "no strands are drawn: --guides writes guides");
    strands.comment = "hairbench simulate, " + scene_.name;
    return strands;
}

Written Recording::everyFrame() {
    Written written;
    engine::writeFileAtomically(options_.out, [&](std::ostream& file) {
        std::optional<hair::groom::UsdaAnimation> animation;
        play([&](std::uint32_t frame) {
            hair::groom::StrandSet now = strands();
            if (frame == 0) {
                animation.emplace(
                    file, now,
                    hair::groom::UsdaTiming{options_.frames, double{settings_.run.frame_time}});
                written = {now, animation->warnings()};
            }
            if (now.ends != written.strands.ends ||
                now.widths.values != written.strands.widths.values) {
                throw engine::Error(
                    "/lod/mode", "frame " + std::to_string(frame) +
                                     " draws other strands than frame 0, of which .usda holds one "
                                     "set: \"forced\" draws the same in all");
            }
            animation->frame(now.points);
        });
        animation->end();
    });
    return written;
}

Written Recording::lastFrame() {
    play([](std::uint32_t) {});
    Written written{.strands = strands(), .warnings = {}};
    written.warnings =
        hair::groom::exportStrands(written.strands, options_.out, engine::checkInterrupted);
    return written;
}

std::string sizeOf(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(path, error);
    if (error) return "";
    if (bytes < 1'000'000) return ", " + std::to_string((bytes + 999) / 1000) + " kB";
    return ", " + std::to_string((bytes + 500'000) / 1'000'000) + " MB";
}

}  // namespace

int simulateScene(const SimulateOptions& options) {
    scene::Scene scene = scene::loadScene(options.scene.scene);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene);
    hair::groom::strandExporterOf(options.out);  // or there is nothing to play for
    engine::checkWritable(options.out);

    const engine::Device device(options.scene.device);
    Recording recording(device, scene, spec.settings, options);
    const bool moves = hair::groom::lowerCaseExtension(options.out) == ".usda";
    engine::catchInterrupts();
    try {
        const Written written = moves ? recording.everyFrame() : recording.lastFrame();
        for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
        for (const std::string& warning : written.warnings) std::cerr << warning << '\n';
        const std::string last = std::to_string(options.frames - 1);
        std::cout << options.out.string() << ": " << written.strands.strandCount() << " strands, "
                  << written.strands.points.size() << " points, "
                  << (moves ? "frames 0 to " + last : "frame " + last + ", the last,") << " of "
                  << scene.name << sizeOf(options.out) << '\n';
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return report::kInterrupted;
    }
    return report::kOk;
}

}  // namespace benchmarks::commands
