#include "benchmarks/groom/recording.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/progress.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/frame_loop.h"
#include "engine/process.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/usd_export.h"

namespace benchmarks::groom {
namespace {

class Recording {
public:
    Recording(
        const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
        const RecordingOptions& options, measure::HairCache& cache)
        : device_(device), scene_(scene), settings_(settings), options_(options),
          case_(device, settings, scene.directory, &cache) {}

    Recorded everyFrame();
    Recorded lastFrame();
    std::vector<std::string> warnings() const { return case_.warnings(); }

private:
    // Plays the frames without drawing them. Calls `after` with the index of each.
    void play(const std::function<void(std::uint32_t)>& after);
    hair::groom::StrandSet strands() const;

    const engine::Device& device_;
    const scene::Scene& scene_;
    const hair::Settings& settings_;
    const RecordingOptions& options_;
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
                                         ? measure::guideStrands(case_.groom(), case_.drawnGuides())
                                         : measure::drawnStrands(case_.strands());
    if (strands.ends.empty())
        throw engine::Error(scene_.path.string(), "no strands are drawn: --guides writes guides");
    strands.up = 1;
    strands.comment = "hairbench simulate, " + scene_.name;
    return strands;
}

Recorded Recording::everyFrame() {
    Recorded recorded;
    engine::writeFileAtomically(options_.out, [&](std::ostream& file) {
        std::optional<hair::groom::UsdaAnimation> animation;
        play([&](std::uint32_t frame) {
            hair::groom::StrandSet now = strands();
            if (frame == 0) {
                animation.emplace(
                    file, now,
                    hair::groom::UsdaTiming{options_.frames, double{settings_.run.frame_time}});
                recorded = {now, animation->warnings()};
            }
            if (now.ends != recorded.strands.ends ||
                now.widths.values != recorded.strands.widths.values) {
                throw engine::Error(
                    "/lod/mode",
                    "frame " + std::to_string(frame) +
                        " draws different strands from frame 0, and .usda holds one set: "
                        "'forced' draws the same in all");
            }
            animation->frame(now.points);
        });
        animation->end();
    });
    return recorded;
}

Recorded Recording::lastFrame() {
    play([](std::uint32_t) {});
    Recorded recorded{.strands = strands(), .warnings = {}};
    recorded.warnings =
        hair::groom::exportStrands(recorded.strands, options_.out, engine::checkInterrupted);
    return recorded;
}

}  // namespace

bool holdsFrames(const std::filesystem::path& file) {
    return hair::groom::lowerCaseExtension(file) == ".usda";
}

Recorded recordStrands(
    const engine::Device& device, const scene::Scene& scene, const hair::Settings& settings,
    const RecordingOptions& options, measure::HairCache& cache) {
    Recording recording(device, scene, settings, options, cache);
    Recorded recorded = holdsFrames(options.out) ? recording.everyFrame() : recording.lastFrame();
    const std::vector<std::string> warnings = recording.warnings();
    recorded.warnings.insert(recorded.warnings.begin(), warnings.begin(), warnings.end());
    return recorded;
}

}  // namespace benchmarks::groom
