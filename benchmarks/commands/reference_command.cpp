#include <iostream>
#include <optional>
#include <sstream>

#include "benchmarks/commands/commands.h"
#include "benchmarks/measure/progress.h"
#include "benchmarks/reference/mitsuba.h"
#include "benchmarks/reference/picture_errors.h"
#include "benchmarks/report/change.h"
#include "engine/files.h"
#include "engine/process.h"
#include "hair/groom/files.h"

namespace benchmarks::commands {
namespace {

// The tool's lines are "passes <how many>", then "pass <samples before it>" as each begins.
class PassProgress {
public:
    explicit PassProgress(std::uint32_t samples) : samples_(samples) {}
    ~PassProgress() {
        if (progress_) progress_->clear();
    }

    void line(std::string_view text) {
        std::istringstream words{std::string(text)};
        std::string what;
        std::size_t number = 0;
        words >> what >> number;
        if (what == "passes") progress_.emplace(number);
        if (what == "pass" && progress_)
            progress_->begin(
                std::to_string(number) + " of " + std::to_string(samples_) + " samples a pixel");
    }

private:
    std::uint32_t samples_;
    std::optional<measure::Progress> progress_;
};

void trace(const ReferenceOptions& options, const std::filesystem::path& folder) {
    PassProgress progress(options.samples);
    reference::runReferenceTool(
        "render.py",
        {(folder / "scene.xml").string(), std::filesystem::absolute(options.out).string(),
         std::to_string(options.samples)},
        [&](std::string_view line) { progress.line(line); });
}

}  // namespace

int renderReference(const ReferenceOptions& options) {
    const std::string extension = hair::groom::lowerCaseExtension(options.out);
    if (extension != ".exr" && extension != ".png")
        throw engine::Error(options.out.string(), "is neither .exr nor .png");
    scene::Scene scene = scene::loadScene(options.scene.scene);
    const scene::CaseSpec spec = scene::singleCase(scene, options.scene);
    const hair::Settings& settings = spec.settings;
    engine::checkWritable(options.out);
    reference::checkReferenceTool();

    engine::catchInterrupts();
    try {
        const engine::ScratchFolder folder;
        {
            const engine::Device device(options.scene.device);
            reference::exportMitsuba(device, scene, settings, options.frame, folder.path());
            for (const std::string& message : device.messages().take())
                std::cerr << message << '\n';
        }
        trace(options, folder.path());
    } catch (const engine::Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return report::kInterrupted;
    }
    std::cout << options.out.string() << ": frame " << options.frame << " of " << scene.name << ", "
              << settings.render.width << " x " << settings.render.height << " px, "
              << options.samples << " samples a pixel\n";
    return report::kOk;
}

}  // namespace benchmarks::commands
