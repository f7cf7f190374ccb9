#include <iostream>
#include <optional>
#include <sstream>

#include "benchmarks/commands.h"
#include "benchmarks/exit_codes.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/mitsuba_export.h"
#include "benchmarks/progress.h"
#include "benchmarks/reference_tool.h"
#include "benchmarks/scratch_folder.h"
#include "engine/write_file.h"
#include "hair/groom/file_extension.h"

namespace benchmarks {
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
    std::optional<Progress> progress_;
};

void trace(const ReferenceOptions& options, const std::filesystem::path& folder) {
    PassProgress progress(options.samples);
    runReferenceTool(
        "render.py",
        {(folder / "scene.xml").string(), std::filesystem::absolute(options.out).string(),
         std::to_string(options.samples)},
        [&](std::string_view line) { progress.line(line); });
}

}  // namespace

int renderReference(const ReferenceOptions& options) {
    const std::string extension = hair::lowerCaseExtension(options.out);
    if (extension != ".exr" && extension != ".png")
        throw engine::Error(options.out.string(), "is neither .exr nor .png");
    Scene scene = loadScene(options.scene.scene);
    const CaseSpec spec = singleCase(scene, options.scene);
    const hair::Settings& settings = spec.settings;
    engine::checkWritable(options.out);
    checkReferenceTool();

    catchInterrupts();
    try {
        const ScratchFolder folder;
        {
            const engine::Device device(options.scene.device);
            exportMitsuba(device, scene, settings, options.frame, folder.path());
            for (const std::string& message : device.messages().take())
                std::cerr << message << '\n';
        }
        trace(options, folder.path());
    } catch (const Interrupted&) {
        std::cerr << "interrupted: nothing is written\n";
        return kInterrupted;
    }
    std::cout << options.out.string() << ": frame " << options.frame << " of " << scene.name << ", "
              << settings.render.width << " x " << settings.render.height << " px, "
              << options.samples << " samples a pixel\n";
    return kOk;
}

}  // namespace benchmarks
