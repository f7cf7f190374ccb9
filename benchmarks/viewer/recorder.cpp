#include "benchmarks/viewer/recorder.h"

#include <algorithm>
#include <string>

#include "benchmarks/scene/scene.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"
#include "engine/png_text.h"

namespace benchmarks::viewer {
namespace {

// "0012"; larger numbers have more digits.
std::string fourDigits(std::uint32_t number) {
    std::string digits = std::to_string(number);
    return std::string(4 - std::min<std::size_t>(digits.size(), 4), '0') + digits;
}

std::filesystem::path pictureOf(const std::filesystem::path& folder, std::uint32_t number) {
    return folder / (fourDigits(number) + ".png");
}

}  // namespace

// ---- Recordings ---------------------------------------------------------------------------------

void Recorder::start(const std::filesystem::path& folder) {
    const std::filesystem::path first = pictureOf(folder, 0);
    std::error_code error;
    // A shorter recording would leave the end of the old one in place.
    if (std::filesystem::exists(first, error))
        throw engine::Error(folder.string(), "has a recording already");
    engine::checkWritable(first);
    folder_ = folder;
    last_.reset();
    written_ = 0;
}

void Recorder::frame(const Shown& shown) {
    if (!folder_ || last_ == shown.frame || !shown.isThere()) return;
    try {
        engine::writePng(pictureOf(*folder_, written_), shown.width, shown.height, shown.picture);
    } catch (...) {
        stop();
        throw;
    }
    last_ = shown.frame;
    ++written_;
}

std::string Recorder::message() const {
    if (!folder_) return {};
    return "recording " + std::to_string(written_) + (written_ == 1 ? " frame" : " frames") +
           " to " + folder_->string();
}

// ---- Screenshots --------------------------------------------------------------------------------

void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene) {
    std::string file;
    try {
        file = engine::withPngText(
            engine::encodePng(width, height, rgba), scene::kSceneKeyword, scene);
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
        // In an unreadable folder, no free name can be found. Writing will report the error.
        if (error) return path;
    }
}

}  // namespace benchmarks::viewer
