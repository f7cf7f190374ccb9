#include "benchmarks/viewer/files/recorder.h"

#include "benchmarks/viewer/files/four_digits.h"
#include "engine/error.h"
#include "engine/image_file.h"
#include "engine/write_file.h"

namespace benchmarks {

namespace {

std::filesystem::path pictureOf(const std::filesystem::path& folder, std::uint32_t number) {
    return folder / (fourDigits(number) + ".png");
}

}  // namespace

void Recorder::start(const std::filesystem::path& folder) {
    const std::filesystem::path first = pictureOf(folder, 0);
    std::error_code error;
    // A shorter recording would leave the end of the old one behind its own.
    if (std::filesystem::exists(first, error))
        throw engine::Error(folder.string(), "has a recording already");
    engine::checkWritable(first);
    folder_ = folder;
    last_.reset();
    written_ = 0;
}

void Recorder::frame(const Player& player) {
    if (!folder_ || last_ == player.frame()) return;
    const hair::RenderSettings& render = player.settings().render;
    try {
        engine::writePng(
            pictureOf(*folder_, written_), render.width, render.height, player.played().picture());
    } catch (...) {
        stop();
        throw;
    }
    last_ = player.frame();
    ++written_;
}

std::string Recorder::message() const {
    if (!folder_) return {};
    return "recording " + std::to_string(written_) + (written_ == 1 ? " frame" : " frames") +
           " to " + folder_->string();
}

}  // namespace benchmarks
