#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "benchmarks/viewer/player.h"

// Writes pictures of the viewer: recordings of frames, and screenshots with their scene.
namespace benchmarks::viewer {

// Writes every shown frame as a picture, from <folder>/0000.png on.
class Recorder {
public:
    bool records() const { return folder_.has_value(); }
    // Starts a recording and creates its folder. Throws engine::Error if that fails or the folder
    // already has a recording.
    void start(const std::filesystem::path& folder);
    void stop() { folder_.reset(); }
    // Writes the shown frame, once even if called repeatedly. Does nothing without a recording.
    // Stops the recording if it throws engine::Error.
    void frame(const Shown& shown);

    std::uint32_t written() const { return written_; }
    const std::filesystem::path& folder() const { return *folder_; }  // only during a recording
    // "recording 12 frames to <folder>"; empty without a recording.
    std::string message() const;

private:
    std::optional<std::filesystem::path> folder_;
    std::optional<std::uint32_t> last_;  // number of the last written frame
    std::uint32_t written_ = 0;
};

// Writes a PNG of RGBA pixels, [row][column], top row first, with a scene in its metadata: an iTXt
// chunk "hairbench-scene" for sceneOfScreenshot() and loadScene(). `scene` is from sceneText() for
// the picture's folder. Replaces the file atomically. Throws engine::Error.
void writeScreenshot(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const std::uint8_t> rgba, const std::string& scene);

// Returns the first free name in the folder: "hairbench-rest-0001.png" for the stem
// "hairbench-rest".
std::filesystem::path freeName(
    const std::filesystem::path& folder, const std::string& stem, const std::string& extension);

}  // namespace benchmarks::viewer
