#include "benchmarks/viewer/files/screenshot.h"

#include "benchmarks/screenshot_scene.h"
#include "benchmarks/viewer/files/four_digits.h"
#include "engine/encode_png.h"
#include "engine/error.h"
#include "engine/png_text.h"
#include "engine/write_file.h"

namespace benchmarks {

void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene) {
    std::string file;
    try {
        file = engine::withPngText(engine::encodePng(width, height, rgba), kSceneKeyword, scene);
    } catch (const engine::Error& error) {
        throw engine::Error(path.string(), error.what());
    }
    engine::writeFileAtomically(path, file);
}

std::filesystem::path freeName(
    const std::filesystem::path& folder, const std::string& stem, const std::string& extension) {
    for (std::uint32_t number = 1;; ++number) {
        std::filesystem::path path = folder / (stem + '-' + fourDigits(number) + extension);
        std::error_code error;
        if (std::filesystem::symlink_status(path, error).type() ==
            std::filesystem::file_type::not_found)
            return path;
        // A folder that can't be looked into has no free name to find: writing says why.
        if (error) return path;
    }
}

}  // namespace benchmarks
