#include "benchmarks/screenshot_scene.h"

#include "engine/error.h"
#include "engine/png_text.h"
#include "engine/read_file.h"

namespace benchmarks {

std::optional<std::string> sceneOfScreenshot(const std::filesystem::path& path) {
    const std::string file = engine::readFile(path);
    try {
        return engine::pngText(file, kSceneKeyword);
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
}

}  // namespace benchmarks
