#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace benchmarks {

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

}  // namespace benchmarks
