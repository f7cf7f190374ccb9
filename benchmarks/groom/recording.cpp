#include "benchmarks/groom/recording.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/measure/case.h"
#include "benchmarks/measure/measure.h"
#include "benchmarks/measure/progress.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/frame_loop.h"
#include "engine/process.h"
#include "hair/groom/files.h"
#include "hair/groom/formats/formats.h"
#include "hair/groom/formats/npy.h"
#include "hair/groom/formats/usd_export.h"

namespace benchmarks::groom {
namespace {

class Recording {
public:
    Recording(
        const engine::Device& device, const std::filesystem::path& directory,
        const std::string& name, const hair::Settings& settings, const RecordingOptions& options,
        measure::HairCache& cache)
        : device_(device), name_(name), settings_(settings), options_(options),
          case_(device, settings, directory, &cache) {
        if (options.probes) probes_.emplace(device, case_, options.frames);
    }

    // In a format that holds moving strands.
    template <class Animation>
    Recorded everyFrame();
    Recorded array();
    Recorded lastFrame();
    Recorded onlyProbes();
    std::vector<std::string> warnings() const {
        std::vector<std::string> warnings = case_.warnings();
        std::ranges::move(measure::contactWarnings(case_), std::back_inserter(warnings));
        return warnings;
    }
    std::optional<measure::PlayedProbes> takeProbes() {
        return probes_ ? std::optional(probes_->take()) : std::nullopt;
    }

private:
    // Plays the frames without drawing them. Calls `after` with the index of each.
    void play(const std::function<void(std::uint32_t)>& after);
    hair::groom::StrandSet strands() const;
    // Throws unless a frame draws the same strands as the first.
    void checkEqual(
        std::uint32_t frame, const hair::groom::StrandSet& now,
        const hair::groom::StrandSet& first) const;

    const engine::Device& device_;
    const std::string& name_;
    const hair::Settings& settings_;
    const RecordingOptions& options_;
    measure::Case case_;
    std::optional<measure::ProbeRecorder> probes_;
};

void Recording::play(const std::function<void(std::uint32_t)>& after) {
    engine::FrameLoop loop(device_, engine::Timing::statistics);
    measure::Progress progress(options_.frames);
    if (probes_) {  // the start of the hair
        loop.frame([&](engine::Passes& passes) { probes_->record(passes); });
        probes_->frameDone();
    }
    try {
        for (std::uint32_t i = 0; i < options_.frames; ++i) {
            engine::checkInterrupted();
            progress.begin("frame " + std::to_string(i));
            loop.frame([&](engine::Passes& passes) {
                case_.simulate(passes);
                if (probes_) probes_->record(passes);
            });
            if (probes_) probes_->frameDone();
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
        throw engine::Error(name_, "no strands are drawn: --guides writes guides");
    strands.up = 1;
    strands.comment = "hairbench simulate, " + name_;
    return strands;
}

void Recording::checkEqual(
    std::uint32_t frame, const hair::groom::StrandSet& now,
    const hair::groom::StrandSet& first) const {
    if (now.ends == first.ends && now.widths.values == first.widths.values) return;
    throw engine::Error(
        "/lod/mode", "frame " + std::to_string(frame) +
                         " draws different strands from frame 0, and " +
                         hair::groom::lowerCaseExtension(options_.out) +
                         " holds one set: 'forced' draws the same in all");
}

template <class Animation>
Recorded Recording::everyFrame() {
    Recorded recorded;
    engine::writeFileAtomically(options_.out, [&](std::ostream& file) {
        std::optional<Animation> animation;
        play([&](std::uint32_t frame) {
            hair::groom::StrandSet now = strands();
            if (frame == 0) {
                animation.emplace(
                    file, now,
                    hair::groom::FrameTiming{options_.frames, double{settings_.run.frame_time}});
                recorded = {now, animation->warnings()};
            }
            checkEqual(frame, now, recorded.strands);
            animation->frame(now.points);
        });
        animation->finish();
    });
    return recorded;
}

Recorded Recording::array() {
    Recorded recorded;
    const bool is_archive = hair::groom::lowerCaseExtension(options_.out) == ".npz";
    engine::writeFileAtomically(options_.out, [&](std::ostream& file) {
        hair::groom::NpzStream archive(file);
        std::vector<double> times;
        play([&](std::uint32_t frame) {
            hair::groom::StrandSet now = strands();
            if (frame == 0) {
                const std::size_t points = now.ends.front();
                for (std::size_t i = 0; i < now.ends.size(); ++i)
                    if (now.ends[i] != (i + 1) * points)
                        throw engine::Error(
                            options_.out.string(),
                            "strands have different numbers of points: --guides writes guides");
                const std::uint64_t shape[]{options_.frames, now.ends.size(), points, 3};
                if (is_archive)
                    archive.begin("positions", hair::groom::NpyType::float32, shape);
                else
                    file << hair::groom::npyHeader(hair::groom::NpyType::float32, shape);
                recorded.strands = now;
            }
            checkEqual(frame, now, recorded.strands);
            times.push_back(case_.time());
            const auto bytes = std::as_bytes(std::span(now.points));
            if (is_archive)
                archive.append(bytes);
            else
                file.write(
                    reinterpret_cast<const char*>(bytes.data()),
                    static_cast<std::streamsize>(bytes.size()));
        });
        if (!is_archive) return;
        const std::uint64_t frames[]{times.size()};
        archive.begin("times", hair::groom::NpyType::float64, frames);
        archive.append(std::as_bytes(std::span(times)));
        const std::uint64_t bytes[]{options_.metadata.size()};
        archive.begin("metadata", hair::groom::NpyType::uint8, bytes);
        archive.append(std::as_bytes(std::span(options_.metadata)));
        archive.finish();
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

Recorded Recording::onlyProbes() {
    play([](std::uint32_t) {});
    return {};
}

}  // namespace

bool isArray(const std::filesystem::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    return extension == ".npy" || extension == ".npz";
}

bool holdsFrames(const std::filesystem::path& file) {
    const std::string extension = hair::groom::lowerCaseExtension(file);
    return extension == ".usda" || extension == ".usdc" || extension == ".abc" || isArray(file);
}

Recorded recordStrands(
    const engine::Device& device, const std::filesystem::path& directory, const std::string& name,
    const hair::Settings& settings, const RecordingOptions& options, measure::HairCache& cache) {
    Recording recording(device, directory, name, settings, options, cache);
    const std::string extension = hair::groom::lowerCaseExtension(options.out);
    Recorded recorded = options.out.empty()    ? recording.onlyProbes()
                        : isArray(options.out) ? recording.array()
                        : extension == ".usda" ? recording.everyFrame<hair::groom::UsdaAnimation>()
                        : extension == ".usdc" ? recording.everyFrame<hair::groom::UsdcAnimation>()
                        : extension == ".abc"
                            ? recording.everyFrame<hair::groom::AlembicAnimation>()
                            : recording.lastFrame();
    recorded.probes = recording.takeProbes();
    const std::vector<std::string> warnings = recording.warnings();
    recorded.warnings.insert(recorded.warnings.begin(), warnings.begin(), warnings.end());
    return recorded;
}

}  // namespace benchmarks::groom
