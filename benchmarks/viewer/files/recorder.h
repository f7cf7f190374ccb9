#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "benchmarks/viewer/play/player.h"

namespace benchmarks {

// Writes every frame that is shown as a picture, <folder>/0000.png and on.
class Recorder {
public:
    bool records() const { return folder_.has_value(); }
    // Makes the folder. Throws engine::Error where that can't be, or where it has a recording.
    void start(const std::filesystem::path& folder);
    void stop() { folder_.reset(); }
    // The frame that is shown: once, however often it is called with it. Does nothing while nothing
    // is recorded. Throws engine::Error, and stops.
    void frame(const Player& player);

    std::uint32_t written() const { return written_; }
    const std::filesystem::path& folder() const { return *folder_; }  // while it records
    // "recording 12 frames to <folder>"; empty while nothing is recorded.
    std::string message() const;

private:
    std::optional<std::filesystem::path> folder_;
    std::optional<std::uint32_t> last_;  // frame that was written
    std::uint32_t written_ = 0;
};

}  // namespace benchmarks
