#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hair/groom/groom.h"

// Common parts of text formats: comments, words and numbers, and sentences on left-out data.
namespace hair::groom {

// Returns the comment as lines of a text file, each after `keyword`; nothing for an empty comment.
// Carriage returns, which belong to a line's end, are left out.
std::string commentLines(std::string_view comment, std::string_view keyword);

// Data that strands may have beside their points.
enum class Part {
    widths,
    transparencies,
    colors,
    root_uvs,
    groups,
    guides,
    root_triangles,
    unit,
    comment
};

// Returns a sentence for each part that the strands have and the format does not hold. Strands
// that are opaque everywhere have no transparencies.
std::vector<std::string> leftOut(const StrandSet& strands, std::initializer_list<Part> held);

// Warns if strands were left out: "3 strands with ... are left out".
void warnOfStrands(std::size_t count, const std::string& which, StrandSet& set);

// Some of a file's points, or strands, one after another.
struct PointRange {
    std::size_t first;
    std::size_t count;
};
using StrandRange = PointRange;

// Fill a part of the strands where only some parts of the file have it, and warn of this: the mean
// width of the others, opaque, white, or a group of its own. Do nothing without ranges.
void completeWidths(StrandSet& set, std::span<const PointRange> without);
void completeTransparencies(StrandSet& set, std::span<const PointRange> without);
void completeColors(StrandSet& set, std::span<const PointRange> without);
void completeGroups(StrandSet& set, std::span<const StrandRange> without);

// Lines of text files, word by word. Numbers are in C's notation whatever the locale; a '+' before
// them is allowed.

// The lines of a text without their ends, of Unix or of Windows.
class TextLines {
public:
    explicit TextLines(std::string_view text) : rest_(text) {}

    bool atEnd() const { return rest_.empty(); }
    std::size_t number() const { return number_; }  // of the line taken last
    std::size_t bytesLeft() const { return rest_.size(); }
    std::string_view take();  // empty at the end

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

// Throws engine::Error "line N: reason".
[[noreturn]] void failAtLine(std::size_t line, const std::string& reason);

// Takes the next word, up to white space, off the beginning of `line`; empty at the line's end.
std::string_view takeWord(std::string_view& line);

// Returns the word for a message: in quotes, short, without characters that can't be printed.
std::string inQuotes(std::string_view word);

// Returns the number that the whole word stands for.
std::optional<std::int64_t> integerFrom(std::string_view word);
std::optional<double> doubleFrom(std::string_view word);  // also "nan" and "inf"

// Returns the nearest float; 0 for a number too small for one, infinity for one too large, as long
// as a double holds it.
std::optional<float> floatFrom(std::string_view word);

// Writes text to a stream in large blocks.
class TextWriter {
public:
    explicit TextWriter(std::ostream& out) : out_(out) { text_.reserve(kBlock + kLongestNumber); }

    void add(std::string_view text) {
        text_ += text;
        if (text_.size() > kBlock) flush();
    }

    // Writes `before` and the shortest decimals that read back as the same number.
    template <class Number>
    void addNumber(Number number, std::string_view before = " ") {
        char digits[kLongestNumber];
        const char* end = std::to_chars(digits, digits + kLongestNumber, number).ptr;
        text_ += before;
        add({digits, end});
    }

    void flush() {
        out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
        text_.clear();
    }

private:
    static constexpr std::size_t kBlock = 1 << 16;
    static constexpr std::size_t kLongestNumber = 32;

    std::ostream& out_;
    std::string text_;
};

// Returns the ends of strands of `size` points each.
std::vector<std::uint32_t> uniformEnds(std::uint32_t strands, std::uint32_t size);

// The numbers of points of a strand that a format allows and prefers.
struct NumberOfPoints {
    std::uint32_t least;
    std::uint32_t most;
    std::uint32_t wanted;  // for strands with other numbers
};

// Returns the strands resampled to one number of points, with a warning; absent if all have the
// same number already, from `least` to `most`.
std::optional<StrandSet> makeUniform(
    const StrandSet& strands, const NumberOfPoints& number, std::vector<std::string>& warnings);

// Whether text is UTF-8, without surrogates and needlessly long forms (RFC 3629).
bool isUtf8(std::string_view text);

// Converts Latin-1 to UTF-8. It is the usual meaning of 8-bit text without a stated encoding.
std::string utf8FromLatin1(std::string_view text);

}  // namespace hair::groom
