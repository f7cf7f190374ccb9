#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace re2 {
class RE2;
}

namespace benchmarks::scene {

// A regular expression from a user or a file, in RE2's syntax: like ECMAScript, but without back
// references and look-around. Matching takes time linear in the text and bounded memory, whatever
// the input.
class Pattern {
public:
    // Throws engine::Error, without the expression, for an invalid one.
    explicit Pattern(const std::string& regex);

    // Whether it matches anywhere in the text; an empty one matches every text.
    bool isIn(std::string_view text) const;

private:
    std::shared_ptr<const re2::RE2> expression_;  // shared by copies; std::function needs copies
};

// Ranges of frames and the names of their files.

// File names of a sequence: a path with one "%d" or "%04d" for the frame's number; "%%" is a
// percent sign.
class FramePaths {
public:
    // Throws engine::Error for a pattern with more than one number or anything else after a "%".
    explicit FramePaths(const std::filesystem::path& pattern);

    // Whether each frame has its own name.
    bool hasNumber() const { return has_number_; }

    std::filesystem::path of(std::uint32_t frame) const;

private:
    std::string before_;
    std::string after_;
    std::size_t digits_ = 0;  // minimum number of digits
    bool has_number_ = false;
};

// Whether a path has a place for the name of a case, "{case}".
bool hasCasePlace(const std::filesystem::path& pattern);

// The file of a case: its name without that of the scene stands for "{case}", in letters that every
// system allows: "out/{case}.png" and "thesis/guides:86/msaa:4" -> "out/guides-86_msaa-4.png".
std::filesystem::path
caseFile(const std::filesystem::path& pattern, std::string_view scene, std::string_view name);

// The frames `first`, `first` + `step` ... below `end`.
struct FrameRange {
    std::uint32_t first = 0;
    std::uint32_t end = 1;
    std::uint32_t step = 1;

    std::uint32_t count() const { return (end - first + step - 1) / step; }
    bool holds(std::uint32_t frame) const {
        return frame >= first && frame < end && (frame - first) % step == 0;
    }
};

// Parses "A:B" or "A:B:STEP". Throws engine::Error for other text and for an empty range.
FrameRange parseFrameRange(std::string_view text);

}  // namespace benchmarks::scene
