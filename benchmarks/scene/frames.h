#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

// Ranges of frames and the names of their files.
namespace benchmarks::scene {

// Names of the files of a sequence: a path with one "%d" or "%04d", in whose place the frame's
// number goes; "%%" is a percent sign.
class FramePaths {
public:
    // Throws engine::Error for a pattern with anything else after a "%", or more than one number.
    explicit FramePaths(const std::filesystem::path& pattern);

    // Whether each frame has a name of its own.
    bool hasNumber() const { return has_number_; }

    std::filesystem::path of(std::uint32_t frame) const;

private:
    std::string before_;
    std::string after_;
    std::size_t digits_ = 0;  // at least
    bool has_number_ = false;
};

// Frames `first`, `first` + `step` ... that are below `end`.
struct FrameRange {
    std::uint32_t first = 0;
    std::uint32_t end = 1;
    std::uint32_t step = 1;

    std::uint32_t count() const { return (end - first + step - 1) / step; }
    bool holds(std::uint32_t frame) const {
        return frame >= first && frame < end && (frame - first) % step == 0;
    }
};

// The range that "A:B" or "A:B:STEP" names. Throws engine::Error for anything else, and where there
// is no frame.
FrameRange parseFrameRange(std::string_view text);

}  // namespace benchmarks::scene
