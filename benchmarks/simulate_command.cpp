#include <functional>
#include <iostream>
#include <optional>

#include "benchmarks/case.h"
#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/progress.h"
#include "benchmarks/simulated_strands.h"
#include "engine/write_file.h"
#include "hair/groom/exporters.h"
#include "hair/groom/file_extension.h"
#include "hair/groom/formats/usda_animation.h"

namespace benchmarks {
namespace {

// What a file holds, for the closing line.
struct Written {
    hair::StrandSet strands;  // of its first frame
    std::vector<std::string> warnings;
};

class Recording {
public:
    Recording(
        const engine::Device& device, const Scene& scene, const hair::Settings& settings,
        const SimulateOptions& options)
        : device_(device), scene_(scene), settings_(settings), options_(options),
          case_(device, settings, scene.directory) {}

    Written everyFrame();
    Written lastFrame();

private:
    // Plays the frames without drawing them; `after` is called with the number of each.
    void play(const std::function<void(std::uint32_t)>& after);
    hair::StrandSet strands() const;

    const engine::Device& device_;
    const Scene& scene_;
    const hair::Settings& settings_;
    const SimulateOptions& options_;
    Case case_;
};

void Recording::play(const std::function<void(std::uint32_t)>& after) {
    engine::FrameLoop loop(device_, engine::Timing::statistics);
    Progress progress(options_.frames);
    try {
        for (std::uint32_t i = 0; i < options_.frames; ++i) {
            checkInterrupted();
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

hair::StrandSet Recording::strands() const {
    hair::StrandSet strands = options_.guides ? guideStrands(case_.groom(), case_.guides())
                                              : drawnStrands(case_.strands());
    if (strands.ends.empty())
        throw engine::Error(scene_.path.string(), "no strands are drawn: --guides writes guides");
    strands.comment = "hairbench simulate, " + scene_.name;
    return strands;
}

Written Recording::everyFrame() {
    Written written;
    engine::writeFileAtomically(options_.out, [&](std::ostream& file) {
        std::optional<hair::UsdaAnimation> animation;
        play([&](std::uint32_t frame) {
            hair::StrandSet now = strands();
            if (frame == 0) {
                animation.emplace(
                    file, now, hair::UsdaTiming{options_.frames, double{settings_.run.frame_time}});
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
    written.warnings = hair::exportStrands(written.strands, options_.out, checkInterrupted);
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
    Scene scene = loadScene(options.scene.scene);
    const CaseSpec spec = singleCase(scene, options.scene);
    hair::strandExporterOf(options.out);  // or there is nothing to play for
    engine::checkWritable(options.out);

    const engine::Device device(options.scene.device);
    Recording recording(device, scene, spec.settings, options);
    const bool moves = hair::lowerCaseExtension(options.out) == ".usda";
    catchInterrupts();
    try {
        const Written written = moves ? recording.everyFrame() : recording.lastFrame();
        for (const std::string& message : device.messages().take()) std::cerr << message << '\n';
        for (const std::string& warning : written.warnings) std::cerr << warning << '\n';
        const std::string last = std::to_string(options.frames - 1);
        std::cout << options.out.string() << ": " << written.strands.strandCount() << " strands, "
                  << written.strands.points.size() << " points, "
                  << (moves ? "frames 0 to " + last : "frame " + last + ", the last,") << " of "
                  << scene.name << sizeOf(options.out) << '\n';
    } catch (const Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return kInterrupted;
    }
    return kOk;
}

}  // namespace benchmarks
