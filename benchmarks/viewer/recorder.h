#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "benchmarks/viewer/player.h"

// Pictures that the viewer writes: recordings of frames, and screenshots with their scene.
namespace benchmarks::viewer {

// Writes every frame that is shown as a picture, <folder>/0000.png and on.
class Recorder {
public:
    bool records() const { return folder_.has_value(); }
    // Begins a recording and makes its folder. Throws engine::Error where that fails, or where the
    // folder has a recording.
    void start(const std::filesystem::path& folder);
    void stop() { folder_.reset(); }
    // Writes the frame that is shown: once, however often this is called with it. Does nothing
    // while nothing is recorded. Stops where it throws engine::Error.
    void frame(const Shown& shown);

    std::uint32_t written() const { return written_; }
    const std::filesystem::path& folder() const { return *folder_; }  // while it records
    // "recording 12 frames to <folder>"; empty while nothing is recorded.
    std::string message() const;

private:
    std::optional<std::filesystem::path> folder_;
    std::optional<std::uint32_t> last_;  // number of the frame that was written last
    std::uint32_t written_ = 0;
};

// A PNG of RGBA pixels, [row][column], top row first, with a scene in its metadata: an iTXt chunk
// "hairbench-scene", from which sceneOfScreenshot() and loadScene() take it. `scene` is what
// sceneText() makes for the picture's folder. The file is replaced in one step. Throws
// engine::Error.
void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene);

// "hairbench-rest-0001.png" of the stem "hairbench-rest": the first name that is free in the
// folder.
std::filesystem::path freeName(
    const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

}  // namespace benchmarks::viewer
